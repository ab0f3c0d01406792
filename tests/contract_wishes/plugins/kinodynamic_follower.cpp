// SPDX-License-Identifier: MIT
// A controller that drives by the velocities at the waypoints; where the host's waypoints have none, by their times.
#include <algorithm>
#include <cmath>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

#include "tests/contract_wishes/plugins/waypoint_with_velocity.h"

namespace {

namespace toolkit = dmrp::toolkit;

class KinodynamicFollower final : public dmrp::LocalController {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("org.example.kinodynamic_follower", "Kinodynamic follower", "0.1.0");
  }

  void set_path(dmrp::Path path, std::uint64_t) override {
    path_.clear();
    for (std::size_t i = 0; i < path.size(); ++i)
      path_.push_back({path[i], has_velocity(path) ? velocity(path, i) : mean_speed(path, i)});
    path_.back().v = 0.0;  // also where the plan goes on
  }

  dmrp::Status step(const dmrp::Observation& now, dmrp::Command& command) override {
    if (path_.empty()) return dmrp::Status::no_solution;
    const waypoint_with_velocity& next = path_[std::min<std::size_t>(now.progress_waypoint + 1, path_.size() - 1)];
    const double left_m = toolkit::distance(toolkit::position(now.pose), toolkit::position(path_.back().known));
    const double error =
        left_m < 0.1 ? 0.0 : toolkit::difference(now.pose.theta, toolkit::bearing(now.pose, next.known));
    // a robot that stands before its end creeps on, whatever the plan's velocity there
    const double speed = std::max(next.v, std::min(0.1, left_m));
    command.v_x = std::min(speed, now.limits.v_max) * std::max(0.0, std::cos(error));
    command.omega = 2.0 * error;
    return dmrp::Status::ok;
  }

 private:
  static bool has_velocity(dmrp::Path path) { return DMRP_STRIDE_HAS(waypoint_with_velocity, path.stride(), v); }
  static double velocity(dmrp::Path path, std::size_t i) { return DMRP_AT(waypoint_with_velocity, &path[i], 0, 0)->v; }
  // On the way to this waypoint.
  static double mean_speed(dmrp::Path path, std::size_t i) {
    if (i == 0) return 0.0;
    const double length_m = toolkit::distance(toolkit::position(path[i - 1]), toolkit::position(path[i]));
    return length_m / dmrp::seconds(std::max<std::int64_t>(path[i].t_ns - path[i - 1].t_ns, 1));
  }

  std::vector<waypoint_with_velocity> path_;
};

}  // namespace

DMRP_PLUGINS(KinodynamicFollower)
