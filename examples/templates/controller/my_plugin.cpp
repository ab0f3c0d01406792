// SPDX-License-Identifier: MIT
// A complete local controller: it steers towards a point ahead on its path, the carrot, slows down for people in its way
// and stops at the end. Copy it, rename it, replace step().
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/polyline.hpp>
#include <vector>

namespace {

namespace toolkit = dmrp::toolkit;

class CarrotFollower final : public dmrp::LocalController {
 public:
  // The id must stay the same in all versions. Begin it with a domain that you own; `dmrp.` is reserved.
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("org.example.my_plugin", "Carrot follower", "0.1.0")
        .vendor("Example")
        .license("MIT")
        .summary("steers at a point ahead on the path, gives way to people");
  }

  // The keys that an experiment file may set under `params`. The host checks names, types and ranges before it creates
  // an instance. The robot's limits are not parameters: every observation contains them.
  dmrp::Param<double> look_ahead = param("look_ahead", 0.8).unit("m").range(0.1, 5.0).doc("distance of the carrot");
  dmrp::Param<double> gain =
      param("gain", 2.0).unit("1/s").range(0.0, 10.0).doc("turn rate per radian of heading error");
  dmrp::Param<double> headway = param("headway", 1.0).unit("s").range(0.1, 5.0).doc("time kept to a person ahead");

  // A trial begins: reset all state of the previous one.
  dmrp::Status start(const dmrp::Start&) override {
    path_.clear();
    arcs_.clear();
    return dmrp::Status::ok;
  }

  // The path ends where the robot must stop: at its goal, or, if it is partial, where it has to wait for others. It is
  // valid until the call returns, so keep a copy. The host calls this again, with the next revision, whenever the plan
  // changes or the robot may drive on.
  void set_path(dmrp::Path path, std::uint64_t /*revision*/) override {
    path_.assign(path.begin(), path.end());
    ends_at_goal_ = !path.is_partial();
    toolkit::arc_lengths(path_, arcs_);
  }

  // Called ten times a second. Use no clock, and no random numbers except from the seed of start(): the same
  // observations must give the same commands.
  dmrp::Status step(const dmrp::Observation& now, dmrp::Command& command) override {
    if (path_.empty()) return dmrp::Status::no_solution;  // the host brakes

    // The carrot lies ahead of the robot's progress on the path, but not beyond its end.
    const double end_m = arcs_.back();
    const double carrot_m = std::min(now.progress_m + look_ahead, end_m);
    const dmrp::Vec2 carrot = toolkit::point_at(path_, arcs_, carrot_m);
    const double to_carrot_m = toolkit::distance(toolkit::position(now.pose), carrot);
    const double remaining_m = to_carrot_m + (end_m - carrot_m);

    // At the end: turn to the goal's heading if it has one (NaN: any), else command zero. The host decides whether the
    // robot has arrived.
    if (remaining_m < 0.5 * now.goal.tolerance_m) {
      if (ends_at_goal_ && !std::isnan(now.goal.pose.theta))
        command.omega = gain * toolkit::difference(now.pose.theta, now.goal.pose.theta);
      return dmrp::Status::ok;
    }

    // Turn towards the carrot; drive if the robot faces it, and slowly enough to stop in time.
    const double error = toolkit::difference(now.pose.theta, toolkit::bearing(now.pose, carrot));
    const double can_stop = std::sqrt(now.limits.a_max * remaining_m);  // braking with half of a_max
    command.omega = gain * error;
    command.v_x = std::min(now.limits.v_max, can_stop) * std::max(0.0, std::cos(error));
    command.v_x = std::min(command.v_x, speed_behind_people(now));
    return dmrp::Status::ok;  // the host clips the command to the robot's limits
  }

 private:
  // The largest speed that reaches no person ahead within the headway. The plan keeps robots apart.
  double speed_behind_people(const dmrp::Observation& now) const {
    double speed = now.limits.v_max;
    for (const dmrp::Agent& other : now.agents) {
      const double aside = toolkit::difference(now.pose.theta, toolkit::bearing(now.pose, other.pose));
      if (other.kind == DMRP_AGENT_ROBOT || std::abs(aside) > toolkit::pi / 3.0) continue;
      const double gap_m = toolkit::distance(toolkit::position(now.pose), toolkit::position(other.pose)) -
                           now.footprint.radius_m - other.radius_m;
      if (gap_m < speed * headway) speed = std::max(0.0, gap_m) / headway;
    }
    return speed;
  }

  std::vector<dmrp::Waypoint> path_;
  std::vector<double> arcs_;  // arc length of each waypoint, m
  bool ends_at_goal_ = false;
};

}  // namespace

// All plugin classes of the library; once per library.
DMRP_PLUGINS(CarrotFollower)
