// SPDX-License-Identifier: MIT
// smoothness.hpp: turning, acceleration and jerk of robots.
#pragma once

#include <dmrp/toolkit/angle.hpp>

#include "metrics/measure/bases.hpp"

namespace dmrp::metrics {

// Sums over the active steps of one robot.
struct RobotMotion {
  CompensatedSum turned_rad, driven_m, velocity_change, acceleration_change;
  std::int64_t moved_ns = 0;  // the time over which velocity_change sums
  std::int64_t jerk_ns = 0;   // the time over which acceleration_change sums

  Pose last_pose;
  Vec2 last_velocity;           // in the robot's frame, m/s
  Vec2 last_acceleration;       // mean of the previous step, m/s^2
  std::int64_t last_dt_ns = 0;  // of the previous step; 0: there was none

  double turning_rad() const { return moved_ns > 0 ? turned_rad.value() : undefined; }
  double acceleration() const { return moved_ns > 0 ? velocity_change.value() / seconds(moved_ns) : undefined; }
  double jerk() const { return jerk_ns > 0 ? acceleration_change.value() / seconds(jerk_ns) : undefined; }
};

class Smoothness final : public ActiveTimeMetric<RobotMotion> {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.smoothness", "Smoothness")
        .summary("turning, and mean acceleration and jerk, until the robot arrives")
        .source(
            "Guzzi et al., Human-friendly robot navigation in dynamic environments, ICRA 2013: path irregularity; "
            "acceleration and jerk as in HuNavSim, Perez-Higueras et al., RA-L 2023")
        .value("heading_change", "rad", lower_is_better, system_and_robots,
               "sum over the steps of active time of |wrap(theta - previous theta)|; undefined if planning failed",
               never_negative)
        .value("path_irregularity", "rad/m", lower_is_better, system_and_robots,
               "max(0, heading_change - least turning) / length driven while active; least turning: from the start's "
               "heading over the directions of the goals to the last goal's heading if it has one; undefined if the "
               "robot did not move",
               never_negative)
        .value("acceleration", "m/s^2", lower_is_better, system_and_robots,
               "mean over active time of |dv/dt|, v = (v_x, v_y) in the robot's frame, from sample to sample; "
               "undefined if planning failed",
               never_negative)
        .value("jerk", "m/s^3", lower_is_better, system_and_robots,
               "mean over active time of |da/dt|, a = dv/dt of one step, from the middle of one step to the middle of "
               "the next; undefined without two steps",
               never_negative);
  }

  void observe(const Sample& sample) override {
    ActiveTimeMetric::observe(sample);
    for (std::size_t robot = 0; robot < states_.size(); ++robot) {
      const RobotSample& now = sample.robots[robot];
      states_[robot].last_pose = now.pose;
      states_[robot].last_velocity = {now.velocity.v_x, now.velocity.v_y};
    }
  }

  void finish(const TrialEnd&, MetricSink& sink) override {
    std::vector<double> irregularities;
    for (std::size_t robot = 0; robot < states_.size(); ++robot) irregularities.push_back(irregularity(robot));
    give_mean(sink, "heading_change", &RobotMotion::turning_rad);
    give(sink, "path_irregularity", &mean_of_defined, irregularities);
    give_mean(sink, "acceleration", &RobotMotion::acceleration);
    give_mean(sink, "jerk", &RobotMotion::jerk);
  }

 private:
  // The least turning that the task needs: toward the first goal, at every goal toward the next, and to the last goal's
  // heading.
  static double least_turning(const Robot& robot) {
    double sum_rad = 0.0;
    double heading = robot.start.theta;
    Vec2 at = toolkit::position(robot.start);
    double goal_heading = undefined;
    for (const Goal& goal : robot.goals()) {
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

  void add_step(RobotMotion& motion, std::size_t robot, const Sample& sample) override {
    const RobotSample& now = sample.robots[robot];
    motion.turned_rad.add(std::fabs(toolkit::difference(motion.last_pose.theta, now.pose.theta)));
    motion.driven_m.add(toolkit::distance(toolkit::position(motion.last_pose), toolkit::position(now.pose)));

    const Vec2 change = Vec2{now.velocity.v_x, now.velocity.v_y} - motion.last_velocity;
    motion.velocity_change.add(toolkit::norm(change));
    motion.moved_ns += sample.dt_ns;

    const Vec2 acceleration = change / seconds(sample.dt_ns);
    if (motion.last_dt_ns > 0) {
      motion.acceleration_change.add(toolkit::norm(acceleration - motion.last_acceleration));
      motion.jerk_ns += (motion.last_dt_ns + sample.dt_ns) / 2;
    }
    motion.last_acceleration = acceleration;
    motion.last_dt_ns = sample.dt_ns;
  }

  double irregularity(std::size_t robot) const {
    const RobotMotion& motion = states_[robot];
    if (!(motion.driven_m.value() > 0.0)) return undefined;
    return std::max(0.0, motion.turned_rad.value() - least_turning(world().robots()[robot])) / motion.driven_m.value();
  }
};

}  // namespace dmrp::metrics
