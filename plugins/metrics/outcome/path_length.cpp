// SPDX-License-Identifier: MIT
#include "metrics/outcome/path_length.hpp"

#include <cmath>
#include <dmrp/toolkit/polyline.hpp>

#include "metrics/measure/describe_metric.hpp"

namespace dmrp::metrics {
namespace {

// Two moves whose directions differ by less (sine of the angle) run straight on: waypoints are rounded.
constexpr double straight_on = 1e-6;

bool turns(Vec2 from, Vec2 to) {
  const double product = toolkit::norm(from) * toolkit::norm(to);
  return toolkit::dot(from, to) < 0.0 || std::fabs(toolkit::cross(from, to)) > straight_on * product;
}

// Changes of direction from one move to the next; a wait is no move. The heading at the start is no move either.
int count_turns(const Path& path) {
  int count = 0;
  Vec2 direction = {0.0, 0.0};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec2 move = toolkit::position(path[i]) - toolkit::position(path[i - 1]);
    if (move == Vec2{0.0, 0.0}) continue;
    if (direction != Vec2{0.0, 0.0} && turns(direction, move)) ++count;
    direction = move;
  }
  return count;
}

}  // namespace

Descriptor PathLength::describe() {
  return describe_metric("dmrp.metric.path_length", "Path length")
      .summary("length driven, length planned, turns planned")
      .source("Hu et al., DMRP-Bench, ICRA 2026: total path length")
      .value("path_length", "m", Direction::lower_is_better, Subjects::system_and_robots,
             "length driven: sum of |dp| over all samples; system: sum over robots; undefined if planning failed")
      .value("planned_length", "m", Direction::lower_is_better, Subjects::system_and_robots,
             "length of the first plan; system: sum over robots; undefined if planning failed")
      .value("plan_turns", "1", Direction::lower_is_better, Subjects::system_and_robots,
             "changes of direction between moves of the first plan; system: sum over robots; undefined if planning "
             "failed");
}

void PathLength::begin(const dmrp_plan* plan) {
  first_plan_ = plan;
  driven_m_.assign(world().robots().size(), {});
  last_position_.clear();
}

void PathLength::observe(const Sample& sample) {
  if (last_position_.empty())
    for (const RobotSample& robot : sample.robots) last_position_.push_back(toolkit::position(robot.pose));
  for (std::size_t robot = 0; robot < driven_m_.size(); ++robot) {
    const Vec2 position = toolkit::position(sample.robots[robot].pose);
    driven_m_[robot].add(toolkit::distance(last_position_[robot], position));
    last_position_[robot] = position;
  }
}

void PathLength::finish(const TrialEnd&, MetricSink& sink) {
  CompensatedSum driven_m, planned_m;
  double turns = 0.0;
  for (std::size_t robot = 0; robot < driven_m_.size(); ++robot) {
    if (!first_plan_) continue;
    sink.robot("path_length", robot, driven_m_[robot].value());
    driven_m.add(driven_m_[robot].value());
    const Path path = Plan(*first_plan_).path(robot);
    const double length_m = toolkit::length(path);
    const double turns_of_robot = count_turns(path);
    sink.robot("planned_length", robot, length_m);
    sink.robot("plan_turns", robot, turns_of_robot);
    planned_m.add(length_m);
    turns += turns_of_robot;
  }
  const bool measured = first_plan_ && !driven_m_.empty();
  sink.system("path_length", measured ? driven_m.value() : undefined);
  sink.system("planned_length", measured ? planned_m.value() : undefined);
  sink.system("plan_turns", measured ? turns : undefined);
}

}  // namespace dmrp::metrics
