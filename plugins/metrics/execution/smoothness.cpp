// SPDX-License-Identifier: MIT
#include "metrics/execution/smoothness.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"

namespace dmrp::metrics {
namespace {

// The least turning that the task needs: toward the first goal, at every goal toward the next, and to the last goal's
// heading.
double least_turning(const Robot& robot) {
  double sum_rad = 0.0;
  double heading = robot.start.theta;
  Vec2 at = toolkit::position(robot.start);
  double goal_heading = undefined;
  for (const Goal& goal : Span<Goal>(robot.goals, robot.goal_count, robot.goal_stride)) {
    const Vec2 next = toolkit::position(goal.pose);
    goal_heading = goal.pose.theta;
    if (next == at) continue;
    const double bearing = toolkit::bearing(at, next);
    sum_rad += std::fabs(toolkit::difference(heading, bearing));
    heading = bearing;
    at = next;
  }
  return std::isnan(goal_heading) ? sum_rad : sum_rad + std::fabs(toolkit::difference(heading, goal_heading));
}

}  // namespace

Descriptor Smoothness::describe() {
  const auto lower = Direction::lower_is_better;
  const auto robots = Subjects::system_and_robots;
  return describe_metric("dmrp.metric.smoothness", "Smoothness")
      .summary("turning, and mean acceleration and jerk, until the robot arrives")
      .source(
          "Guzzi et al., Human-friendly robot navigation in dynamic environments, ICRA 2013: path irregularity; "
          "acceleration and jerk as in HuNavSim, Perez-Higueras et al., RA-L 2023")
      .value("heading_change", "rad", lower, robots,
             "sum over the steps of active time of |wrap(theta - previous theta)|; undefined if planning failed")
      .value("path_irregularity", "rad/m", lower, robots,
             "max(0, heading_change - least turning) / length driven while active; least turning: from the start's "
             "heading over the directions of the goals to the last goal's heading if it has one; undefined if the "
             "robot did not move")
      .value("acceleration", "m/s^2", lower, robots,
             "mean over active time of |dv/dt|, v = (v_x, v_y) in the robot's frame, from sample to sample; undefined "
             "if planning failed")
      .value("jerk", "m/s^3", lower, robots,
             "mean over active time of |da/dt|, a = dv/dt of one step, from the middle of one step to the middle of "
             "the next; undefined without two steps");
}

void Smoothness::begin(const dmrp_plan*) {
  active_.begin(world().robots().size());
  begun_ = false;
  motions_.assign(world().robots().size(), {});
}

void Smoothness::observe(const Sample& sample) {
  active_.observe(sample);
  for (std::size_t robot = 0; robot < motions_.size(); ++robot) {
    Motion& motion = motions_[robot];
    const RobotSample& now = sample.robots[robot];
    if (begun_ && active_.in_step(robot)) motion.add_step(now, sample.dt_ns);
    motion.last_pose = now.pose;
    motion.last_velocity = {now.velocity.v_x, now.velocity.v_y};
  }
  begun_ = true;
}

void Smoothness::Motion::add_step(const RobotSample& robot, std::int64_t dt_ns) {
  turned_rad.add(std::fabs(toolkit::difference(last_pose.theta, robot.pose.theta)));
  driven_m.add(toolkit::distance(toolkit::position(last_pose), toolkit::position(robot.pose)));

  const Vec2 change = Vec2{robot.velocity.v_x, robot.velocity.v_y} - last_velocity;
  velocity_change.add(toolkit::norm(change));
  moved_ns += dt_ns;

  const Vec2 acceleration = change / seconds(dt_ns);
  if (last_dt_ns > 0) {
    acceleration_change.add(toolkit::norm(acceleration - last_acceleration));
    jerk_ns += (last_dt_ns + dt_ns) / 2;
  }
  last_acceleration = acceleration;
  last_dt_ns = dt_ns;
}

double Smoothness::irregularity(std::size_t robot) const {
  const Motion& motion = motions_[robot];
  if (!(motion.driven_m.value() > 0.0)) return undefined;
  return std::max(0.0, motion.turned_rad.value() - least_turning(world().robots()[robot])) / motion.driven_m.value();
}

void Smoothness::finish(const TrialEnd&, MetricSink& sink) {
  const auto mean = [](const CompensatedSum& sum, std::int64_t time_ns) {
    return time_ns > 0 ? sum.value() / seconds(time_ns) : undefined;
  };
  std::vector<double> irregularities;
  for (std::size_t robot = 0; robot < motions_.size(); ++robot) irregularities.push_back(irregularity(robot));
  give_mean(sink, "heading_change", values_of(motions_, [](const Motion& motion) {
              return motion.moved_ns > 0 ? motion.turned_rad.value() : undefined;
            }));
  give_mean(sink, "path_irregularity", irregularities);
  give_mean(sink, "acceleration",
            values_of(motions_, [&](const Motion& motion) { return mean(motion.velocity_change, motion.moved_ns); }));
  give_mean(sink, "jerk", values_of(motions_, [&](const Motion& motion) {
              return mean(motion.acceleration_change, motion.jerk_ns);
            }));
}

}  // namespace dmrp::metrics
