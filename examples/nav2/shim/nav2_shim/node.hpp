// SPDX-License-Identifier: MIT
// rclcpp's nodes: a name, a clock, parameters with callbacks, and topics. Nothing runs by itself: there is no executor.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <nav2_shim/logging.hpp>
#include <nav2_shim/parameters.hpp>
#include <nav2_shim/time.hpp>
#include <nav2_shim/topics.hpp>
#include <optional>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

namespace rclcpp {

class NodeOptions {
 public:
  NodeOptions& parameter_overrides(std::vector<Parameter> overrides) {
    return overrides_ = std::move(overrides), *this;
  }
  const std::vector<Parameter>& parameter_overrides() const { return overrides_; }

 private:
  std::vector<Parameter> overrides_;
};

struct CallbackGroup {
  using SharedPtr = std::shared_ptr<CallbackGroup>;
};
struct TimerBase {
  using SharedPtr = std::shared_ptr<TimerBase>;
};

namespace node_interfaces {

using OnSetParameters = std::function<rcl_interfaces::msg::SetParametersResult(std::vector<Parameter>)>;
struct OnSetParametersCallbackHandle {
  using SharedPtr = std::shared_ptr<OnSetParametersCallbackHandle>;
  OnSetParameters callback;
};
struct PostSetParametersCallbackHandle {
  using SharedPtr = std::shared_ptr<PostSetParametersCallbackHandle>;
  std::function<void(std::vector<Parameter>)> callback;
};

// One object is all of a node's interfaces.
class NodeParametersInterface {
 public:
  using SharedPtr = std::shared_ptr<NodeParametersInterface>;

  virtual ~NodeParametersInterface() = default;
  bool has_parameter(const std::string& name) const { return parameters_.count(name) != 0; }
  const std::map<std::string, ParameterValue>& get_parameter_overrides() const { return overrides_; }
  const std::map<std::string, ParameterValue>& declared_parameters() const { return parameters_; }

  const ParameterValue& declare_parameter(const std::string& name, const ParameterValue& fallback,
                                          const rcl_interfaces::msg::ParameterDescriptor& descriptor = {}) {
    const auto found = overrides_.find(name);
    const ParameterValue& value = found == overrides_.end() ? fallback : found->second;
    if (!descriptor.dynamic_typing) check_type(name, value, fallback.get_type());
    check_range(name, value, descriptor);
    return parameters_[name] = value;
  }
  const ParameterValue& declare_parameter(const std::string& name, ParameterType type,
                                          const rcl_interfaces::msg::ParameterDescriptor& descriptor = {}) {
    const auto found = overrides_.find(name);
    const ParameterValue value = found == overrides_.end() ? ParameterValue() : found->second;
    check_type(name, value, type);
    check_range(name, value, descriptor);
    return parameters_[name] = value;
  }
  template <class T, class = std::enable_if_t<!std::is_same_v<T, ParameterValue> && !std::is_enum_v<T>>>
  T declare_parameter(const std::string& name, const T& fallback,
                      const rcl_interfaces::msg::ParameterDescriptor& descriptor = {}) {
    return declare_parameter(name, ParameterValue(fallback), descriptor).template get<T>();
  }

  Parameter get_parameter(const std::string& name) const {
    const auto found = parameters_.find(name);
    if (found == parameters_.end()) throw exceptions::ParameterNotDeclaredException(name);
    if (found->second.get_type() == PARAMETER_NOT_SET) throw exceptions::ParameterUninitializedException(name);
    return Parameter(name, found->second);
  }
  template <class T>
  bool get_parameter(const std::string& name, T& out) const {
    const auto found = parameters_.find(name);
    if (found == parameters_.end() || found->second.get_type() == PARAMETER_NOT_SET) return false;
    if constexpr (std::is_same_v<T, Parameter>) {
      out = Parameter(name, found->second);
    } else {
      out = Parameter(name, found->second).get_value<T>();
    }
    return true;
  }
  template <class T>
  bool get_parameter_or(const std::string& name, T& out, const T& fallback) const {
    if (get_parameter(name, out)) return true;
    out = fallback;
    return false;
  }

  rcl_interfaces::msg::SetParametersResult set_parameters_atomically(const std::vector<Parameter>& changes) {
    rcl_interfaces::msg::SetParametersResult result;
    for (const Parameter& change : changes) {
      if (has_parameter(change.get_name())) continue;
      result.reason = "One or more parameters were not declared before setting";
      return result;
    }
    result.successful = true;
    for (const auto& handle : on_set_) {
      result = handle->callback(changes);
      if (!result.successful) return result;
    }
    for (const Parameter& change : changes) parameters_[change.get_name()] = change.get_parameter_value();
    for (const auto& handle : post_set_) handle->callback(changes);
    return result;
  }
  rcl_interfaces::msg::SetParametersResult set_parameter(const Parameter& change) {
    return set_parameters_atomically({change});
  }

  OnSetParametersCallbackHandle::SharedPtr add_on_set_parameters_callback(OnSetParameters callback) {
    on_set_.push_back(
        std::make_shared<OnSetParametersCallbackHandle>(OnSetParametersCallbackHandle{std::move(callback)}));
    return on_set_.back();
  }
  PostSetParametersCallbackHandle::SharedPtr add_post_set_parameters_callback(
      std::function<void(std::vector<Parameter>)> callback) {
    post_set_.push_back(
        std::make_shared<PostSetParametersCallbackHandle>(PostSetParametersCallbackHandle{std::move(callback)}));
    return post_set_.back();
  }
  void remove_on_set_parameters_callback(const OnSetParametersCallbackHandle* handle) { remove(on_set_, handle); }
  void remove_post_set_parameters_callback(const PostSetParametersCallbackHandle* handle) { remove(post_set_, handle); }

 protected:
  void override_parameters(const std::vector<Parameter>& overrides) {
    for (const Parameter& parameter : overrides) overrides_[parameter.get_name()] = parameter.get_parameter_value();
  }

 private:
  template <class Handle>
  static void remove(std::vector<std::shared_ptr<Handle>>& handles, const Handle* handle) {
    const auto is_it = [&](const std::shared_ptr<Handle>& candidate) { return candidate.get() == handle; };
    handles.erase(std::remove_if(handles.begin(), handles.end(), is_it), handles.end());
  }
  static void check_type(const std::string& name, const ParameterValue& value, ParameterType expected) {
    const ParameterType type = value.get_type();
    if (type == expected || type == PARAMETER_NOT_SET || expected == PARAMETER_NOT_SET) return;
    throw exceptions::InvalidParameterTypeException("parameter '" + name + "' has invalid type: expected [" +
                                                    rclcpp::to_string(expected) + "] got [" + rclcpp::to_string(type) +
                                                    "]");
  }
  static void check_range(const std::string& name, const ParameterValue& value,
                          const rcl_interfaces::msg::ParameterDescriptor& descriptor) {
    bool inside = true;
    if (value.get_type() == PARAMETER_DOUBLE)
      for (const auto& range : descriptor.floating_point_range)
        inside = value.get<double>() >= range.from_value && value.get<double>() <= range.to_value;
    if (value.get_type() == PARAMETER_INTEGER)
      for (const auto& range : descriptor.integer_range)
        inside = value.get<std::int64_t>() >= range.from_value && value.get<std::int64_t>() <= range.to_value;
    if (!inside)
      throw exceptions::InvalidParameterValueException("parameter '" + name +
                                                       "' is out of its range: " + rclcpp::to_string(value));
  }

  std::map<std::string, ParameterValue> overrides_, parameters_;
  std::vector<OnSetParametersCallbackHandle::SharedPtr> on_set_;
  std::vector<PostSetParametersCallbackHandle::SharedPtr> post_set_;
};

}  // namespace node_interfaces

class Node : public node_interfaces::NodeParametersInterface, public std::enable_shared_from_this<Node> {
 public:
  using SharedPtr = std::shared_ptr<Node>;
  using WeakPtr = std::weak_ptr<Node>;
  using OnSetParametersCallbackHandle = node_interfaces::OnSetParametersCallbackHandle;

  explicit Node(std::string name, const NodeOptions& options = {}) : name_(std::move(name)) {
    override_parameters(options.parameter_overrides());
  }
  template <class... Arguments>
  static SharedPtr make_shared(Arguments&&... arguments) {
    return std::make_shared<Node>(std::forward<Arguments>(arguments)...);
  }

  const char* get_name() const { return name_.c_str(); }
  const char* get_namespace() const { return "/"; }
  Logger get_logger() const { return Logger(name_); }
  Clock::SharedPtr get_clock() const { return clock_; }
  Time now() const { return clock_->now(); }
  SharedPtr get_node_base_interface() { return shared_from_this(); }
  SharedPtr get_node_topics_interface() { return shared_from_this(); }
  SharedPtr get_node_graph_interface() { return shared_from_this(); }
  SharedPtr get_node_services_interface() { return shared_from_this(); }
  SharedPtr get_node_parameters_interface() { return shared_from_this(); }

  template <class Message, class Callback>
  typename Subscription<Message>::SharedPtr create_subscription(const std::string& topic, const QoS&,
                                                                Callback callback) {
    topics_.of<Message>(topic)->push_back([callback](std::shared_ptr<Message> message) {
      if constexpr (std::is_invocable_v<Callback, std::shared_ptr<Message>>) {
        callback(message);
      } else {
        callback(*message);
      }
    });
    return std::make_shared<Subscription<Message>>();
  }

 protected:
  template <class Publisher, class Message>
  std::shared_ptr<Publisher> make_publisher(const std::string& topic) {
    return std::make_shared<Publisher>(topics_.of<Message>(topic));
  }

 private:
  std::string name_;
  Clock::SharedPtr clock_ = std::make_shared<Clock>();
  nav2_shim::Topics topics_;
};

enum class FutureReturnCode { SUCCESS, INTERRUPTED, TIMEOUT };

// Sets parameters at once instead of by a service.
class AsyncParametersClient {
 public:
  AsyncParametersClient(Node::SharedPtr node, const Node::SharedPtr&, const Node::SharedPtr&, const Node::SharedPtr&)
      : node_(std::move(node)) {}
  std::shared_future<rcl_interfaces::msg::SetParametersResult> set_parameters_atomically(
      const std::vector<Parameter>& changes) {
    std::promise<rcl_interfaces::msg::SetParametersResult> promise;
    promise.set_value(node_->set_parameters_atomically(changes));
    return promise.get_future();
  }

 private:
  Node::SharedPtr node_;
};

inline void init(int, char**) {}
inline void shutdown() {}
inline bool ok() {
  return true;
}
inline void spin_some(const Node::SharedPtr&) {}
template <class Future>
FutureReturnCode spin_until_future_complete(const Node::SharedPtr&, const Future&) {
  return FutureReturnCode::SUCCESS;
}

}  // namespace rclcpp

namespace rclcpp_lifecycle {

class State {};

namespace node_interfaces {

struct LifecycleNodeInterface {
  enum class CallbackReturn { SUCCESS, FAILURE, ERROR };
};

}  // namespace node_interfaces

class LifecycleNode : public rclcpp::Node {
 public:
  using SharedPtr = std::shared_ptr<LifecycleNode>;
  using WeakPtr = std::weak_ptr<LifecycleNode>;
  using rclcpp::Node::Node;

  template <class... Arguments>
  static SharedPtr make_shared(Arguments&&... arguments) {
    return std::make_shared<LifecycleNode>(std::forward<Arguments>(arguments)...);
  }
  template <class Message>
  typename LifecyclePublisher<Message>::SharedPtr create_publisher(const std::string& topic, const rclcpp::QoS&) {
    return make_publisher<LifecyclePublisher<Message>, Message>(topic);
  }
};

}  // namespace rclcpp_lifecycle

namespace nav2_util {

using CallbackReturn = rclcpp_lifecycle::node_interfaces::LifecycleNodeInterface::CallbackReturn;
class LifecycleNode : public rclcpp_lifecycle::LifecycleNode {
 public:
  using rclcpp_lifecycle::LifecycleNode::LifecycleNode;
};

}  // namespace nav2_util
