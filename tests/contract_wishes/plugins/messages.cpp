// SPDX-License-Identifier: MIT
// Robots that tell each other how far they still have to go: near each other, the one with the longer way goes first.
// Without messages the others' ways are unknown, and the robot with the lower id goes first.
#include "tests/contract_wishes/plugins/messages.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/polyline.hpp>
#include <map>
#include <vector>

template <>
struct dmrp::ExtensionId<draft_messages> {
  static constexpr const char* value = DRAFT_MESSAGES;
};

namespace {

namespace toolkit = dmrp::toolkit;

class Messages final : public dmrp::LocalController {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("org.example.messages", "Messages", "0.1.0").uses(DRAFT_MESSAGES);
  }
  dmrp::Param<double> near_m = param("near", 1.5).unit("m").range(0.0, 100.0).doc("robots this close take turns");

  dmrp::Status start(const dmrp::Start&) override {
    path_.clear();
    left_of_.clear();
    messages_ = find_extension<draft_messages>();
    return dmrp::Status::ok;
  }

  void set_path(dmrp::Path path, std::uint64_t) override {
    path_.assign(path.begin(), path.end());
    toolkit::arc_lengths(path_, arcs_);
  }

  dmrp::Status step(const dmrp::Observation& now, dmrp::Command& command) override {
    if (path_.empty()) return dmrp::Status::no_solution;
    const double left_m = arcs_.back() - now.progress_m;
    if (messages_) talk(now.robot, left_m);
    const bool waits = std::any_of(now.agents.begin(), now.agents.end(), [&](const dmrp::Agent& other) {
      return other.kind == DMRP_AGENT_ROBOT && other.state == DMRP_ROBOT_ACTIVE && goes_first(other.id, now, left_m) &&
             toolkit::distance(toolkit::position(now.pose), toolkit::position(other.pose)) < near_m;
    });
    if (waits) return dmrp::Status::ok;  // stands

    const double end_m = arcs_.back();
    const dmrp::Vec2 ahead = toolkit::point_at(path_, arcs_, std::min(now.progress_m + 0.5, end_m));
    const double error = toolkit::difference(now.pose.theta, toolkit::bearing(now.pose, ahead));
    const double to_m = toolkit::distance(toolkit::position(now.pose), ahead);
    command.v_x = std::min(now.limits.v_max, std::sqrt(now.limits.a_max * to_m)) * std::max(0.0, std::cos(error));
    command.omega = 2.0 * error;
    return dmrp::Status::ok;
  }

 private:
  void talk(std::uint32_t robot, double left_m) {
    if (messages_->send(messages_, robot, &left_m, sizeof(left_m)) != DMRP_OK) throw std::runtime_error("not sent");
    const draft_inbox& inbox = *messages_->receive(messages_, robot);
    for (const draft_message& message : dmrp::Span<draft_message>(inbox.messages, inbox.count, inbox.stride))
      if (message.size == sizeof(double)) std::memcpy(&left_of_[message.from], message.data, sizeof(double));
  }

  // Whether the other robot, whose id as an agent is its index, goes before this one.
  bool goes_first(std::uint64_t other, const dmrp::Observation& now, double left_m) const {
    const auto found = left_of_.find(static_cast<std::uint32_t>(other));
    if (found == left_of_.end() || found->second == left_m) return other < now.robot;
    return found->second > left_m;
  }

  const draft_messages* messages_ = nullptr;
  std::map<std::uint32_t, double> left_of_;  // m, by robot
  std::vector<dmrp::Waypoint> path_;
  std::vector<double> arcs_;
};

}  // namespace

DMRP_PLUGINS(Messages)
