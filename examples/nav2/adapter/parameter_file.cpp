// SPDX-License-Identifier: MIT
#include <yaml-cpp/yaml.h>

#include <adapter/parameter_file.hpp>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace nav2_adapter {

namespace {

constexpr const char* ros_parameters = "ros__parameters";

std::string place(const std::string& path, const YAML::Mark& mark) {
  return path + ":" + std::to_string(mark.line + 1) + ":" + std::to_string(mark.column + 1);
}

// The parameters of the first node in the file that has the section, whatever its name and namespace.
std::optional<YAML::Node> find_parameters(const YAML::Node& node) {
  if (!node.IsMap()) return std::nullopt;
  if (const YAML::Node parameters = node[ros_parameters];
      parameters && parameters.IsMap() && parameters[section] && parameters[section].IsMap())
    return parameters;
  for (const auto& entry : node)
    if (const auto found = find_parameters(entry.second)) return found;
  return std::nullopt;
}

template <class T>
std::optional<rclcpp::ParameterValue> as(const YAML::Node& node) {
  T value{};
  if (!YAML::convert<T>::decode(node, value)) return std::nullopt;
  return rclcpp::ParameterValue(value);
}

// Quoted scalars are texts; others are what they look like.
rclcpp::ParameterValue scalar(const YAML::Node& node) {
  if (node.Tag() != "!") {
    if (const auto value = as<std::int64_t>(node)) return *value;
    if (const auto value = as<double>(node)) return *value;
    if (const auto value = as<bool>(node)) return *value;
  }
  return rclcpp::ParameterValue(node.as<std::string>());
}

template <class T>
rclcpp::ParameterValue array_of(const std::vector<rclcpp::ParameterValue>& elements) {
  std::vector<T> values;
  for (const rclcpp::ParameterValue& element : elements) values.push_back(element.get<T>());
  return rclcpp::ParameterValue(values);
}

class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path) {}

  ParameterFile read() {
    YAML::Node document;
    try {
      document = YAML::LoadFile(path_);
    } catch (const YAML::ParserException& error) {
      throw std::runtime_error(place(path_, error.mark) + ": expected YAML: " + error.msg);
    } catch (const YAML::BadFile&) {
      throw std::runtime_error(path_ + ": the file cannot be read");
    }
    const auto parameters = find_parameters(document);
    if (!parameters)
      throw std::runtime_error(path_ + ":1:1: expected a node with " + ros_parameters + " that has a section " +
                               section + ", as nav2's controller_server has");
    add("", *parameters);
    return std::move(file_);
  }

 private:
  void add(const std::string& name, const YAML::Node& node) {
    if (node.IsMap()) {
      for (const auto& entry : node) {
        const auto key = entry.first.as<std::string>();
        add(name.empty() ? key : name + "." + key, entry.second);
      }
    } else if (name == section + ".plugin") {
      file_.plugin = node.as<std::string>();
    } else if (!node.IsNull()) {
      file_.parameters.emplace_back(name, node.IsSequence() ? array(node) : scalar(node));
      file_.places[name] = place(path_, node.Mark());
    }
  }

  rclcpp::ParameterValue array(const YAML::Node& node) const {
    std::vector<rclcpp::ParameterValue> elements;
    for (const YAML::Node& element : node) {
      if (!element.IsScalar()) throw std::runtime_error(place(path_, element.Mark()) + ": expected a single value");
      elements.push_back(scalar(element));
      if (elements.back().get_type() != elements.front().get_type())
        throw std::runtime_error(place(path_, element.Mark()) +
                                 ": expected a value of the same type as the first one, " +
                                 rclcpp::to_string(elements.front().get_type()));
    }
    if (elements.empty()) return rclcpp::ParameterValue(std::vector<std::string>());
    switch (elements.front().get_type()) {
      case rclcpp::PARAMETER_BOOL:
        return array_of<bool>(elements);
      case rclcpp::PARAMETER_INTEGER:
        return array_of<std::int64_t>(elements);
      case rclcpp::PARAMETER_DOUBLE:
        return array_of<double>(elements);
      default:
        return array_of<std::string>(elements);
    }
  }

  std::string path_;
  ParameterFile file_;
};

}  // namespace

ParameterFile read_parameter_file(const std::string& path) {
  return Reader(path).read();
}

}  // namespace nav2_adapter
