// SPDX-License-Identifier: MIT
// A controller that drives all robots: of robots that come near each other, the one with the lowest index goes on and
// the others stand. No robot could decide this from its own observation: it does not know whom the others wait for.
#include <algorithm>
#include <cmath>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/polyline.hpp>
#include <map>
#include <vector>

namespace {

namespace toolkit = dmrp::toolkit;

class OneAtATime final : public dmrp::CentralController {
 public:
  static dmrp::Descriptor describe() { return dmrp::Descriptor("org.example.one_at_a_time", "One at a time", "0.1.0"); }
  dmrp::Param<double> near_m = param("near", 1.5).unit("m").range(0.0, 100.0).doc("robots this close take turns");

  dmrp::Status start(const dmrp::Start&) override {
    courses_.clear();
    return dmrp::Status::ok;
  }

  void set_path(std::uint32_t robot, dmrp::Path path, std::uint64_t) override {
    Course& course = courses_[robot];
    course.path.assign(path.begin(), path.end());
    toolkit::arc_lengths(course.path, course.arcs);
  }

  dmrp::Status step(dmrp::Fleet& fleet) override {
    std::vector<dmrp::Vec2> moving;  // where the robots are that go on
    for (std::size_t i = 0; i < fleet.size(); ++i) {
      const dmrp::Observation now = fleet[i];
      const auto course = courses_.find(now.robot);
      if (course == courses_.end()) {
        fleet.brake(i);
        continue;
      }
      const dmrp::Vec2 here = toolkit::position(now.pose);
      const bool waits = std::any_of(moving.begin(), moving.end(),
                                     [&](dmrp::Vec2 other) { return toolkit::distance(here, other) < near_m; });
      if (waits) {
        fleet.command(i, {});
        continue;
      }
      moving.push_back(here);
      fleet.command(i, follow(course->second, now));
    }
    return dmrp::Status::ok;
  }

 private:
  struct Course {
    std::vector<dmrp::Waypoint> path;
    std::vector<double> arcs;
  };

  static dmrp::Command follow(const Course& course, const dmrp::Observation& now) {
    const double end_m = course.arcs.back();
    const dmrp::Vec2 ahead = toolkit::point_at(course.path, course.arcs, std::min(now.progress_m + 0.5, end_m));
    const double error = toolkit::difference(now.pose.theta, toolkit::bearing(now.pose, ahead));
    const double left_m = toolkit::distance(toolkit::position(now.pose), ahead);
    if (left_m < 0.5 * now.goal.tolerance_m) return {};
    return {std::min(now.limits.v_max, std::sqrt(now.limits.a_max * left_m)) * std::max(0.0, std::cos(error)), 0.0,
            2.0 * error};
  }

  std::map<std::uint32_t, Course> courses_;
};

}  // namespace

DMRP_PLUGINS(OneAtATime)
