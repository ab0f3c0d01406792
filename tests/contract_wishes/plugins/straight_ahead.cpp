// SPDX-License-Identifier: MIT
// A windowed planner of any angles: straight to the goal at half the speed limit, with waypoints as close in time as it is
// told. It gives the whole way, whatever the window: the host cuts it.
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

namespace {

using dmrp::toolkit::distance;

class StraightAhead final : public dmrp::GlobalPlanner {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("org.example.straight_ahead", "Straight ahead", "0.1.0")
        .connectivity(DMRP_CONNECTIVITY_ANY)
        .flags(DMRP_FLAG_WINDOWED)
        .uncoordinated();
  }
  dmrp::Param<std::int64_t> waypoint_ms =
      param("waypoint_ms", 1000).unit("ms").range(1, 60'000).doc("from one waypoint to the next");

  dmrp::Status plan(const dmrp::PlanningProblem& problem, dmrp::PlanSink& sink) override {
    for (std::uint32_t i = 0; i < problem.robots.size(); ++i) sink.path(i, way_of(problem.robots[i], problem));
    return dmrp::Status::ok;
  }

 private:
  std::vector<dmrp::Waypoint> way_of(const dmrp::PlanningRobot& robot, const dmrp::PlanningProblem& problem) const {
    const auto at = [&](dmrp::Vec2 place, std::int64_t t_ns) {
      return dmrp::waypoint(place.x, place.y, problem.effective_from_ns + t_ns, robot.first_goal_index);
    };
    std::vector<dmrp::Waypoint> way = {at(robot.start, 0)};
    if (robot.state != DMRP_ROBOT_ACTIVE) return way;
    const dmrp::Pose& pose = robot.goals()[0].pose;
    const dmrp::Vec2 goal = {pose.x, pose.y};
    const double duration_s = distance(robot.start, goal) / (0.5 * robot.robot->limits->v_max);
    const auto duration_ns = static_cast<std::int64_t>(duration_s * 1e9);
    const std::int64_t period_ns = *waypoint_ms * 1'000'000;
    for (std::int64_t t_ns = period_ns; t_ns < duration_ns; t_ns += period_ns)
      way.push_back(at(
          dmrp::toolkit::lerp(robot.start, goal, static_cast<double>(t_ns) / static_cast<double>(duration_ns)), t_ns));
    if (duration_ns > 0) way.push_back(at(goal, duration_ns));
    return way;
  }
};

}  // namespace

DMRP_PLUGINS(StraightAhead)
