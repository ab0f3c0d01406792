// SPDX-License-Identifier: MIT
// A controller for lifelong tasks: goals come while it drives, and a robot that has arrived may be sent on. It drives
// through a goal after which it knows another, stops at the last so far, and keeps nothing that says "done".
#include <algorithm>
#include <cmath>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/polyline.hpp>
#include <vector>

namespace {

namespace toolkit = dmrp::toolkit;

class LifelongController final : public dmrp::LocalController {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("org.example.lifelong", "Lifelong controller", "0.1.0");
  }

  dmrp::Status start(const dmrp::Start&) override {
    path_.clear();
    return dmrp::Status::ok;
  }

  void set_path(dmrp::Path path, std::uint64_t) override {
    path_.assign(path.begin(), path.end());
    toolkit::arc_lengths(path_, arcs_);
  }

  dmrp::Status step(const dmrp::Observation& now, dmrp::Command& command) override {
    if (path_.empty()) return dmrp::Status::no_solution;
    // a goal without a way to it yet: a new path will come
    if (path_.back().goal_index < now.goal_index) return dmrp::Status::ok;

    const double end_m = arcs_.back();
    const double ahead_m = std::min(now.progress_m + 0.6, end_m);
    const double error =
        toolkit::difference(now.pose.theta, toolkit::bearing(now.pose, toolkit::point_at(path_, arcs_, ahead_m)));
    const double to_stop_m =
        now.goal_index + 1 < now.goal_count
            ? std::max(0.0, end_m - now.progress_m)  // there is another goal behind this one
            : toolkit::distance(toolkit::position(now.pose), toolkit::point_at(path_, arcs_, end_m));
    command.omega = 2.0 * error;
    command.v_x = std::min(now.limits.v_max, std::sqrt(now.limits.a_max * to_stop_m)) * std::max(0.0, std::cos(error));
    return dmrp::Status::ok;
  }

 private:
  std::vector<dmrp::Waypoint> path_;
  std::vector<double> arcs_;
};

}  // namespace

DMRP_PLUGINS(LifelongController)
