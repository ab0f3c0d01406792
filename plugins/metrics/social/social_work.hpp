// SPDX-License-Identifier: MIT
// social_work.hpp: the social forces between robots and people, integrated over time.
#pragma once

#include <dmrp/toolkit/angle.hpp>

#include "metrics/measure/bases.hpp"
#include "metrics/measure/bodies.hpp"
#include "metrics/measure/nearest_wall.hpp"

namespace dmrp::metrics {

struct WorkOfRobot {
  std::int64_t active_ns = 0;   // the time that the sums cover
  std::int64_t pending_ns = 0;  // the time after that
  NearestWall wall;
  CompensatedSum on_robot;  // m/s: the integral of forces per mass
  CompensatedSum on_people;
};

class SocialWork final : public ActiveTimeMetric<WorkOfRobot> {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.social_work", "Social work")
        .summary("social forces between robots and people, and of walls on robots, integrated over time")
        .source(
            "HuNavSim, Perez-Higueras et al., RA-L 2023: social work; forces: Moussaid et al., Proc. R. Soc. B 276, "
            "2009")
        .channels(DMRP_CHANNEL_PEOPLE)
        .value("social_work", "m/s", lower_is_better, system_and_robots,
               "integral over active time, with forces sampled at control steps and on arrival, of |sum of people's "
               "social forces on the robot| + |force of the nearest static surface on it| + sum over people of |its "
               "social force on them|; with e toward the other, D = 2 (v - v') + e, B = 0.35 |D|, theta from D to e: "
               "social force 2.1 exp(-d / B) (exp(-(3 B theta)^2) against D + exp(-(2 B theta)^2) perpendicular to "
               "it), per mass, d between centres; static force 10 exp(-d / 0.2 m), d between surfaces; system: sum "
               "over robots; undefined without people",
               never_negative)
        .value("social_work_robot", "m/s", lower_is_better, system_and_robots,
               "the first two of these terms: forces on the robot; system: sum over robots; undefined without people",
               never_negative)
        .value("social_work_people", "m/s", lower_is_better, system_and_robots,
               "the last of these terms: forces of the robot on people; system: sum over robots; undefined without "
               "people",
               never_negative);
  }

  void begin(const MetricTrial& trial) override {
    ActiveTimeMetric::begin(trial);
    people_ = false;
    for (WorkOfRobot& work : states_) work.wall.begin(world());
  }

  void observe(const Sample& sample) override {
    people_ = people_ || !sample.people.empty();
    ActiveTimeMetric::observe(sample);
  }

  void finish(const TrialEnd&, MetricSink& sink) override {
    const auto give_work = [&](const char* name, auto value_of) {
      give_of_states(sink, name, &sum_of_defined, [&](const WorkOfRobot& work) {
        return people_ && work.active_ns > 0 ? value_of(work) : undefined;
      });
    };
    give_work("social_work", [](const WorkOfRobot& work) { return work.on_robot.value() + work.on_people.value(); });
    give_work("social_work_robot", [](const WorkOfRobot& work) { return work.on_robot.value(); });
    give_work("social_work_people", [](const WorkOfRobot& work) { return work.on_people.value(); });
  }

 private:
  // Moussaid et al. 2009, Experimental study of the behavioural mechanisms underlying self-organization in human crowds;
  // weights as in HuNavSim's lightsfm.
  static constexpr double lambda = 2.0;
  static constexpr double gamma = 0.35;
  static constexpr double n = 2.0;
  static constexpr double n_prime = 3.0;
  static constexpr double social_weight = 2.1;
  static constexpr double obstacle_weight = 10.0;
  static constexpr double obstacle_range_m = 0.2;

  // Forces with a first factor of exp(-20) or less, 5 nm/s^2, count as 0.
  static constexpr double farthest_in_ranges = 20.0;

  // The force of the other body on the first, m/s^2. The reverse force is its exact negative: all vectors change their
  // sign, and the angle keeps it.
  static Vec2 social_force(Vec2 position, Vec2 velocity, Vec2 other_position, Vec2 other_velocity) {
    const Vec2 apart = other_position - position;
    const double distance_m = toolkit::norm(apart);
    const Vec2 toward = toolkit::normalized(apart);
    const Vec2 interaction = lambda * (velocity - other_velocity) + toward;
    const double strength = toolkit::norm(interaction);
    const double range_m = gamma * strength;
    if (!(distance_m < farthest_in_ranges * range_m)) return {0.0, 0.0};
    const Vec2 along = interaction / strength;
    const double theta = std::atan2(toolkit::cross(along, toward), toolkit::dot(along, toward));
    const auto decay = [&](double sharpness) {
      const double bend = sharpness * range_m * theta;
      return std::exp(-distance_m / range_m - bend * bend);
    };
    const double sign = theta > 0.0 ? 1.0 : theta < 0.0 ? -1.0 : 0.0;
    return -social_weight * (decay(n_prime) * along + sign * decay(n) * toolkit::perpendicular(along));
  }

  void add_step(WorkOfRobot& work, std::size_t robot, const Sample& sample) override {
    work.pending_ns += sample.dt_ns;
    if (!sample.control_tick && active_.at_instant(robot)) return;
    const double duration_s = seconds(work.pending_ns);
    work.active_ns += work.pending_ns;
    work.pending_ns = 0;
    const Disc own = disc_of(world().robots()[robot], sample.robots[robot]);
    const Vec2 velocity = world_velocity(sample.robots[robot]);
    Vec2 on_robot = {0.0, 0.0};
    double on_people = 0.0;
    for (const Person& person : sample.people) {
      const Vec2 force = social_force(own.center, velocity, person.position, person.velocity);
      on_robot += force;
      on_people += toolkit::norm(force);
    }
    const double to_wall_m = work.wall.find(own.center).distance_m - own.radius_m;
    const double of_wall = obstacle_weight * std::exp(-to_wall_m / obstacle_range_m);
    work.on_robot.add((toolkit::norm(on_robot) + of_wall) * duration_s);
    work.on_people.add(on_people * duration_s);
  }

  bool people_ = false;  // whether any sample had people
};

}  // namespace dmrp::metrics
