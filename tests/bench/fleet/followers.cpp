// SPDX-License-Identifier: MIT
// followers.cpp: one law of path following as a controller of one robot, and as a controller of all. A robot waits for
// those of lower index near it, which the one looks up among the agents that it perceives and the other in the fleet.
#include <algorithm>
#include <cmath>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/polyline.hpp>
#include <vector>

namespace {

namespace toolkit = dmrp::toolkit;

constexpr double near_m = 1.0;
constexpr double look_ahead_m = 0.6;

struct Course {
  std::vector<dmrp::Waypoint> path;
  std::vector<double> arcs;

  void set(dmrp::Path waypoints) {
    path.assign(waypoints.begin(), waypoints.end());
    toolkit::arc_lengths(path, arcs);
  }

  dmrp::Command follow(const dmrp::Observation& now) const {
    if (path.empty()) return {};
    const dmrp::Vec2 ahead = toolkit::point_at(path, arcs, std::min(now.progress_m + look_ahead_m, arcs.back()));
    const double left_m = toolkit::distance(toolkit::position(now.pose), ahead);
    if (left_m < 0.5 * now.goal.tolerance_m) return {};
    const double error = toolkit::difference(now.pose.theta, toolkit::bearing(now.pose, ahead));
    dmrp::Command command;
    command.v_x = std::min(now.limits.v_max, left_m) * std::max(0.0, std::cos(error));
    command.omega = std::clamp(2.0 * error, -now.limits.omega_max, now.limits.omega_max);
    return command;
  }
};

class FollowEach final : public dmrp::LocalController {
 public:
  static dmrp::Descriptor describe() { return dmrp::Descriptor("bench.follow_each", "Follow, each", "1.0.0"); }

  dmrp::Status start(const dmrp::Start&) override {
    course_ = {};
    return dmrp::Status::ok;
  }
  void set_path(dmrp::Path path, std::uint64_t) override { course_.set(path); }
  dmrp::Status step(const dmrp::Observation& now, dmrp::Command& command) override {
    const dmrp::Vec2 here = toolkit::position(now.pose);
    for (const dmrp::Agent& agent : now.agents)
      if (agent.kind == DMRP_AGENT_ROBOT && agent.id < now.robot &&
          toolkit::distance(here, toolkit::position(agent.pose)) < near_m)
        return dmrp::Status::ok;
    command = course_.follow(now);
    return dmrp::Status::ok;
  }

 private:
  Course course_;
};

class FollowAll final : public dmrp::CentralController {
 public:
  static dmrp::Descriptor describe() { return dmrp::Descriptor("bench.follow_all", "Follow, all", "1.0.0"); }

  dmrp::Status start(const dmrp::Start& start) override {
    courses_.assign(start.world.robots().size(), {});
    return dmrp::Status::ok;
  }
  void set_path(std::uint32_t robot, dmrp::Path path, std::uint64_t) override { courses_[robot].set(path); }
  dmrp::Status step(dmrp::Fleet& fleet) override {
    places_.clear();
    for (std::size_t i = 0; i < fleet.size(); ++i) {
      const dmrp::Observation now = fleet[i];
      const dmrp::Vec2 here = toolkit::position(now.pose);
      const bool waits = std::any_of(places_.begin(), places_.end(),
                                     [here](dmrp::Vec2 other) { return toolkit::distance(here, other) < near_m; });
      places_.push_back(here);
      if (!waits) fleet.command(i, courses_[now.robot].follow(now));
    }
    return dmrp::Status::ok;
  }

 private:
  std::vector<Course> courses_;
  std::vector<dmrp::Vec2> places_;
};

}  // namespace

DMRP_PLUGINS(FollowEach, FollowAll)
