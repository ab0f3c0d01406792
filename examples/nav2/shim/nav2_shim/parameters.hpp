// SPDX-License-Identifier: MIT
// rclcpp's parameters: a typed value, a value with its name, and the errors of declaring and reading them.
#pragma once

#include <cstdint>
#include <nav2_shim/messages.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace rclcpp {

enum ParameterType : std::uint8_t {
  PARAMETER_NOT_SET,
  PARAMETER_BOOL,
  PARAMETER_INTEGER,
  PARAMETER_DOUBLE,
  PARAMETER_STRING,
  PARAMETER_BYTE_ARRAY,
  PARAMETER_BOOL_ARRAY,
  PARAMETER_INTEGER_ARRAY,
  PARAMETER_DOUBLE_ARRAY,
  PARAMETER_STRING_ARRAY
};

inline const char* to_string(ParameterType type) {
  static constexpr const char* names[] = {"not set",    "bool",       "integer",       "double",       "string",
                                          "byte_array", "bool_array", "integer_array", "double_array", "string_array"};
  return names[type];
}

namespace exceptions {

struct ParameterNotDeclaredException : std::runtime_error {
  using std::runtime_error::runtime_error;
};
struct ParameterUninitializedException : std::runtime_error {
  using std::runtime_error::runtime_error;
};
struct InvalidParameterTypeException : std::runtime_error {
  using std::runtime_error::runtime_error;
};
struct InvalidParameterValueException : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace exceptions

class ParameterValue {
 public:
  ParameterValue() = default;
  template <class T, class = std::enable_if_t<!std::is_same_v<std::decay_t<T>, ParameterValue>>>
  explicit ParameterValue(const T& value) : value_(stored(value)) {}

  ParameterType get_type() const { return static_cast<ParameterType>(value_.index()); }

  template <class T>
  T get() const {
    if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::string>) {
      return need<T>();
    } else if constexpr (std::is_integral_v<T>) {
      return static_cast<T>(need<std::int64_t>());
    } else if constexpr (std::is_floating_point_v<T>) {
      return static_cast<T>(need<double>());
    } else {
      using Element = typename T::value_type;
      const auto& values = need<std::vector<Stored<Element>>>();
      return T(values.begin(), values.end());
    }
  }

 private:
  template <class T>
  using Stored =
      std::conditional_t<std::is_same_v<T, bool>, bool,
                         std::conditional_t<std::is_integral_v<T>, std::int64_t,
                                            std::conditional_t<std::is_floating_point_v<T>, double, std::string>>>;
  // in the order of ParameterType
  using Variant =
      std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<std::uint8_t>,
                   std::vector<bool>, std::vector<std::int64_t>, std::vector<double>, std::vector<std::string>>;

  template <class T>
  static Variant stored(const T& value) {
    return static_cast<Stored<T>>(value);
  }
  static Variant stored(const char* value) { return std::string(value); }
  template <class T>
  static Variant stored(const std::vector<T>& values) {
    return std::vector<Stored<T>>(values.begin(), values.end());
  }

  template <class T>
  const T& need() const {
    if (const T* value = std::get_if<T>(&value_)) return *value;
    throw exceptions::InvalidParameterTypeException(std::string("expected [") +
                                                    rclcpp::to_string(ParameterValue(T()).get_type()) + "] got [" +
                                                    rclcpp::to_string(get_type()) + "]");
  }

  Variant value_;
};

inline std::string to_string(const ParameterValue& value) {
  std::ostringstream text;
  text << std::boolalpha;
  switch (value.get_type()) {
    case PARAMETER_BOOL:
      text << value.get<bool>();
      break;
    case PARAMETER_INTEGER:
      text << value.get<std::int64_t>();
      break;
    case PARAMETER_DOUBLE:
      text << value.get<double>();
      break;
    case PARAMETER_STRING:
      text << value.get<std::string>();
      break;
    default:
      text << to_string(value.get_type());
  }
  return text.str();
}

class Parameter {
 public:
  Parameter() = default;
  explicit Parameter(std::string name, ParameterValue value = ParameterValue())
      : name_(std::move(name)), value_(std::move(value)) {}
  template <class T, class = std::enable_if_t<!std::is_same_v<T, ParameterValue>>>
  Parameter(std::string name, const T& value) : Parameter(std::move(name), ParameterValue(value)) {}

  const std::string& get_name() const { return name_; }
  ParameterType get_type() const { return value_.get_type(); }
  std::string get_type_name() const { return to_string(get_type()); }
  const ParameterValue& get_parameter_value() const { return value_; }
  template <class T>
  T get_value() const {
    try {
      return value_.get<T>();
    } catch (const exceptions::InvalidParameterTypeException& error) {
      throw exceptions::InvalidParameterTypeException("parameter '" + name_ + "' has invalid type: " + error.what());
    }
  }
  template <class T>
  T get() const {
    return get_value<T>();
  }
  bool as_bool() const { return get_value<bool>(); }
  std::int64_t as_int() const { return get_value<std::int64_t>(); }
  double as_double() const { return get_value<double>(); }
  std::string as_string() const { return get_value<std::string>(); }
  std::vector<bool> as_bool_array() const { return get_value<std::vector<bool>>(); }
  std::vector<std::int64_t> as_integer_array() const { return get_value<std::vector<std::int64_t>>(); }
  std::vector<double> as_double_array() const { return get_value<std::vector<double>>(); }
  std::vector<std::string> as_string_array() const { return get_value<std::vector<std::string>>(); }

 private:
  std::string name_;
  ParameterValue value_;
};

}  // namespace rclcpp

namespace std {

inline string to_string(const rclcpp::Parameter& parameter) {
  return "{\"name\": \"" + parameter.get_name() + "\", \"type\": \"" + parameter.get_type_name() + "\", \"value\": \"" +
         rclcpp::to_string(parameter.get_parameter_value()) + "\"}";
}

}  // namespace std
