// SPDX-License-Identifier: MIT
// braking_response.hpp: robots that arrived, and braked as hard as they could before every contact in which they moved.
#pragma once

#include <deque>
#include <dmrp/toolkit/disc_sweep.hpp>
#include <numbers>
#include <optional>
#include <utility>

#include "metrics/measure/bodies.hpp"
#include "metrics/measure/contact_fault.hpp"
#include "metrics/measure/values.hpp"

namespace dmrp::metrics {

class BrakingResponse final : public Metric {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.braking_response", "Braking response")
        .summary("robots that arrived and had no contact at their fault but those before which they braked at once")
        .source(
            "in the spirit of Shalev-Shwartz et al., On a Formal Model of Safe and Scalable Self-driving Cars, 2017")
        .channels(DMRP_CHANNEL_PEOPLE)
        .value("braking_response_success", "1", higher_is_better, system_and_robots,
               "as safe_success, but a contact with a robot or a person is excused if the robot braked at its full "
               "ability from the first moment of danger, plus reaction_s, until it stood, and did not drive on: the "
               "other is in sight and both would touch at constant velocities within the robot's stopping time plus "
               "reaction_s; or it is not, and somebody could come out of a place that the robot does not see at "
               "hidden_speed and touch it within that time",
               share_range);
  }

  Param<double> reaction_s = param("reaction_s", 0.2)
                                 .unit("s")
                                 .range(0.0, 10.0)
                                 .doc("from a danger to the brakes: control period and latency");
  Param<double> braking_share =
      param("braking_share", 0.95).range(0.1, 1.0).doc("of a_max: a robot that brakes less does not brake fully");
  Param<double> swerve_s = param("swerve_s", 1.0)
                               .unit("s")
                               .range(0.0, 10.0)
                               .doc("a danger that pauses for less than this is still the same");
  Param<double> hidden_speed = param("hidden_speed", 1.5)
                                   .unit("m/s")
                                   .range(0.0, 10.0)
                                   .doc("of somebody who comes from where the robot cannot see");

  // Full braking from the greatest speed, and the danger before it.
  void begin(const MetricTrial&) override {
    blamed_.assign(world().robots().size(), false);
    history_.clear();
    memory_ns_ = 0;
    for (const Robot& robot : world().robots()) {
      const dmrp_limits& limits = *robot.limits;
      const double braking_s = std::hypot(limits.v_max, limits.v_y_max) / (braking_share * limits.a_max);
      memory_ns_ = std::max(memory_ns_, nanoseconds(reaction_s + swerve_s + braking_s));
    }
  }

  // A wall excuses nobody.
  void observe(const Sample& sample) override {
    Moment now = moment_of(sample);
    for (const Contact& contact : sample.contacts) {
      if (!is_known(contact) || !begins(contact)) continue;
      const std::size_t a = contact.a;
      const std::size_t b = contact.b + (between_robots(contact) ? 0 : blamed_.size());  // unless it is a wall
      const bool is_wall = contact.kind == DMRP_CONTACT_STATIC;
      if (fault_of_a(contact) && (is_wall || !is_excused(a, now.bodies[b], now.t_ns))) blamed_[a] = true;
      if (between_robots(contact) && fault_of_b(contact) && !is_excused(b, now.bodies[a], now.t_ns)) blamed_[b] = true;
    }
    while (history_.size() > 1 && history_[1].t_ns <= now.t_ns - memory_ns_) history_.pop_front();
    history_.push_back(std::move(now));
  }

  void finish(const TrialEnd& end, MetricSink& sink) override {
    std::vector<double> values;
    for (std::size_t robot = 0; robot < blamed_.size(); ++robot)
      values.push_back(succeeded(end.robots[robot]) && !blamed_[robot] ? 1.0 : 0.0);
    give(sink, "braking_response_success", &mean_of_defined, values);
  }

 private:
  static constexpr double rest_speed = 0.05;  // m/s; as for the fault of contacts (sample.h)

  static std::int64_t nanoseconds(double seconds) { return std::llround(1e9 * seconds); }

  // A robot or a person at a sample.
  struct Body {
    std::uint32_t kind;  // DMRP_AGENT_*
    std::uint64_t id;    // of a person; index of a robot
    Moving moving;
    double speed;  // m/s, of the fastest point: a polygon also turns
  };
  struct Moment {
    std::int64_t t_ns;
    std::vector<Body> bodies;  // robots by index, then people
  };

  Moment moment_of(const Sample& sample) const {
    Moment moment = {sample.t_ns, {}};
    for (std::size_t i = 0; i < blamed_.size(); ++i) {
      const Robot& robot = world().robots()[i];
      const Moving now = moving(robot, sample.robots[i]);
      const double turning_m = robot.footprint->part_count == 0 ? 0.0 : robot.footprint->radius_m;
      moment.bodies.push_back({DMRP_AGENT_ROBOT, i, now,
                               toolkit::norm(now.velocity) + turning_m * std::abs(sample.robots[i].velocity.omega)});
    }
    for (const Person& person : sample.people)
      moment.bodies.push_back({DMRP_AGENT_PERSON, person.id, moving(person), toolkit::norm(person.velocity)});
    return moment;
  }

  // Null: it was not there.
  static const Body* find(const Moment& moment, const Body& body) {
    const auto found = std::find_if(moment.bodies.begin(), moment.bodies.end(),
                                    [&](const Body& one) { return one.kind == body.kind && one.id == body.id; });
    return found == moment.bodies.end() ? nullptr : &*found;
  }

  bool is_excused(std::size_t robot, const Body& other, std::int64_t contact_ns) const {
    if (history_.empty()) return false;
    const std::size_t last = history_.size() - 1;
    std::size_t braking_from = last;
    while (braking_from > 0 && is_braking(braking_from - 1, robot)) --braking_from;
    std::optional<std::size_t> first;  // moment of danger
    std::int64_t dangerous_ns = contact_ns;
    for (std::size_t i = history_.size(); i-- > 0;) {
      const std::int64_t t_ns = history_[i].t_ns;
      if (!is_danger(history_[i], robot, other)) {
        if (dangerous_ns - t_ns >= nanoseconds(swerve_s)) break;
        continue;
      }
      dangerous_ns = t_ns;
      first = i;
      if (braking_from > 0 && history_[braking_from - 1].t_ns >= t_ns + nanoseconds(reaction_s)) return false;
    }
    // it brakes, or the danger came too late for it
    return braking_from < last || !first || !made_the_danger(*first, robot, other);
  }

  bool is_danger(const Moment& moment, std::size_t robot, const Body& other) const {
    const Moving& self = moment.bodies[robot].moving;
    const double within_s = horizon_s(robot, self.velocity);
    const Body* const there = find(moment, other);
    if (there && in_sight(world().shapes(), self.disc.center, there->moving.disc.center))
      return time_to_contact(self, there->moving) <= within_s;
    return may_be_surprised(world(), self, within_s, hidden_speed, other.moving.disc.radius_m);
  }

  // In the step after this moment.
  bool is_braking(std::size_t moment, std::size_t robot) const {
    const Moment& before = history_[moment];
    const Moment& after = history_[moment + 1];
    const double loss =
        braking_share * world().robots()[robot].limits->a_max * 1e-9 * static_cast<double>(after.t_ns - before.t_ns);
    return after.bodies[robot].speed <= std::max(before.bodies[robot].speed - loss, rest_speed);
  }

  // Whether the robot would be in no danger had it kept its velocity of the moment before.
  bool made_the_danger(std::size_t moment, std::size_t robot, const Body& other) const {
    if (moment == 0) return false;
    const Body* const there = find(history_[moment], other);
    Moving self = history_[moment].bodies[robot].moving;
    self.velocity = history_[moment - 1].bodies[robot].moving.velocity;
    return there && !(time_to_contact(self, there->moving) <= horizon_s(robot, self.velocity));
  }

  // Whether the static shapes leave the view free.
  template <class Shapes>
  static bool in_sight(const Shapes& shapes, Vec2 from, Vec2 to) {
    return std::all_of(shapes.begin(), shapes.end(), [&](const Shape& shape) {
      return toolkit::distance(shape, dmrp_segment{from, to}) > 0.0;
    });
  }

  // Whether somebody of this radius and speed could come straight out of a place that the robot does not see and touch it
  // within the horizon, while it keeps its velocity. Tries two places of the robot, 16 points where it is touched, and 16
  // directions and two distances from which somebody comes there.
  static bool may_be_surprised(const World& world, const Moving& robot, double horizon_s, double speed,
                               double radius_m) {
    constexpr int times = 2, directions = 16, distances = 2;
    constexpr double turn_rad = 2.0 * std::numbers::pi / directions;
    const Vec2 here = robot.disc.center;
    const double touching_m = robot.disc.radius_m + radius_m;
    const double reach_m = horizon_s * (toolkit::norm(robot.velocity) + speed) + touching_m + radius_m;
    std::vector<Shape> near;
    for (const Shape& shape : world.shapes())
      if (toolkit::distance(toolkit::bounds(shape), here) <= reach_m) near.push_back(shape);
    const auto is_way = [&](Vec2 from, Vec2 to) {
      return toolkit::disc_sweep_is_clear({from, to}, radius_m, near, {world->lower, world->upper});
    };
    for (int k = 1; k <= times && !near.empty(); ++k) {
      const double t_s = horizon_s * k / times;
      const Vec2 there = here + t_s * robot.velocity;
      if (!in_sight(near, here, there)) return false;  // the robot will turn before
      for (int side = 0; side < directions; ++side) {
        const Vec2 touched = there + touching_m * toolkit::from_angle(turn_rad * side);
        if (!is_way(touched, touched)) continue;
        for (int from = 0; from < directions * distances; ++from) {
          const double way_m = speed * t_s * (1 + from / directions) / distances;
          const Vec2 place = touched + way_m * toolkit::from_angle(turn_rad * (from % directions));
          if (!in_sight(near, here, place) && is_way(place, touched)) return true;
        }
      }
    }
    return false;
  }

  double horizon_s(std::size_t robot, Vec2 velocity) const {
    return toolkit::norm(velocity) / world().robots()[robot].limits->a_max + reaction_s;
  }

  std::int64_t memory_ns_ = 0;
  std::deque<Moment> history_;  // before the present sample, oldest first
  std::vector<char> blamed_;    // by robot
};

}  // namespace dmrp::metrics
