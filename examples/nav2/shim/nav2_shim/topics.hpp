// SPDX-License-Identifier: MIT
// Publishers and subscriptions of one node. A message is handed to the node's own subscriptions in publish(); there are
// no other nodes. Without a subscription nothing is stored, and nav2 does not even make most messages.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace nav2_shim {

template <class Message>
using Callbacks = std::vector<std::function<void(std::shared_ptr<Message>)>>;

// The callbacks of each topic. A topic has one type of message.
class Topics {
 public:
  template <class Message>
  std::shared_ptr<Callbacks<Message>> of(const std::string& name) {
    std::shared_ptr<void>& topic = topics_[name];
    if (!topic) topic = std::make_shared<Callbacks<Message>>();
    return std::static_pointer_cast<Callbacks<Message>>(topic);
  }

 private:
  std::map<std::string, std::shared_ptr<void>> topics_;
};

}  // namespace nav2_shim

namespace rclcpp {

struct QoS {
  QoS(std::size_t /*depth*/ = 10) {}
  QoS& transient_local() { return *this; }
  QoS& reliable() { return *this; }
};
struct SystemDefaultsQoS : QoS {};

template <class Message>
class Publisher {
 public:
  using SharedPtr = std::shared_ptr<Publisher>;

  explicit Publisher(std::shared_ptr<nav2_shim::Callbacks<Message>> callbacks) : callbacks_(std::move(callbacks)) {}
  virtual ~Publisher() = default;

  std::size_t get_subscription_count() const { return callbacks_->size(); }
  void publish(const Message& message) { hand_over(message); }
  void publish(std::unique_ptr<Message> message) { hand_over(*message); }

 private:
  void hand_over(const Message& message) {
    for (const auto& callback : *callbacks_) callback(std::make_shared<Message>(message));
  }

  std::shared_ptr<nav2_shim::Callbacks<Message>> callbacks_;
};

// Lasts as long as its node.
template <class Message>
struct Subscription {
  using SharedPtr = std::shared_ptr<Subscription>;
};

}  // namespace rclcpp

namespace rclcpp_lifecycle {

template <class Message>
class LifecyclePublisher : public rclcpp::Publisher<Message> {
 public:
  using SharedPtr = std::shared_ptr<LifecyclePublisher>;
  using rclcpp::Publisher<Message>::Publisher;

  void on_activate() { active_ = true; }
  void on_deactivate() { active_ = false; }
  bool is_activated() const { return active_; }

 private:
  bool active_ = false;
};

}  // namespace rclcpp_lifecycle
