// SPDX-License-Identifier: MIT
// encounters.hpp: how often robots meet people and other robots, by the kind of the meeting.
#pragma once

#include <array>
#include <map>
#include <tuple>

#include "metrics/measure/bases.hpp"
#include "metrics/measure/bodies.hpp"

namespace dmrp::metrics {

class Encounters final : public Metric {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.encounters", "Encounters")
        .summary("how often robots meet people and other robots: head-on, overtaking, crossing")
        .source(
            "kinds: the scenario cards Frontal Approach, Robot and Pedestrian Overtaking, Intersection of Francis et "
            "al., Principles and Guidelines for Evaluating Social Robot Navigation Algorithms, THRI 2025; when one "
            "begins: own definition")
        .channels(DMRP_CHANNEL_PEOPLE)
        .value("encounters_head_on_person", "1/min", Direction::none, system_and_robots,
               "number of encounters of active robots with people that are head-on, divided by the robots' active "
               "time. One begins when both move at min_speed or faster and their surfaces are farther apart than "
               "distance_m but would not be within horizon_s if both kept their velocities; walls between them are not "
               "looked at. It is over once they have been apart_m or more apart, and on no such course, for horizon_s. "
               "Head-on: at its beginning the directions of motion differ by 180 degrees less cone or more; undefined "
               "without people or active time",
               never_negative)
        .value("encounters_overtaking_person", "1/min", Direction::none, system_and_robots,
               "the same where the directions differ by cone or less: one comes up from behind", never_negative)
        .value("encounters_crossing_person", "1/min", Direction::none, system_and_robots,
               "the same with directions between these", never_negative)
        .value("encounters_head_on_robot", "1/min", Direction::none, system_and_robots,
               "head-on encounters of two active robots, counted for both, divided by the robots' active time; "
               "undefined without another robot or active time",
               never_negative)
        .value("encounters_overtaking_robot", "1/min", Direction::none, system_and_robots, "the same, overtaking",
               never_negative)
        .value("encounters_crossing_robot", "1/min", Direction::none, system_and_robots, "the same, crossing",
               never_negative);
  }

  Param<double> distance_m = param("distance_m", 0.5)
                                 .unit("m")
                                 .range(0.0, 100.0)
                                 .doc("surfaces that would be nearer than this make an encounter");
  Param<double> horizon_s =
      param("horizon_s", 5.0).unit("s").range(0.0, 100.0).doc("how far ahead velocities are extended");
  Param<double> apart_m =
      param("apart_m", 2.0).unit("m").range(0.0, 100.0).doc("an encounter lasts while surfaces are nearer than this");
  Param<double> cone = param("cone", 0.7853981633974483)
                           .unit("rad")
                           .range(0.0, 1.5707963267948966)
                           .doc("directions that differ by at most this are the same");
  Param<double> min_speed =
      param("min_speed", 0.1).unit("m/s").range(0.0, 10.0).doc("who is slower begins no encounter");

  void begin(const MetricTrial&) override {
    const std::size_t robots = world().robots().size();
    active_.begin(robots);
    active_ns_.assign(robots, 0);
    counts_.assign(robots, {});
    last_ns_.clear();
    people_ = false;
  }

  void observe(const Sample& sample) override {
    active_.observe(sample);
    for (std::size_t robot = 0; robot < active_ns_.size(); ++robot)
      if (active_.in_step(robot)) active_ns_[robot] += sample.dt_ns;
    if (!sample.control_tick) return;
    bodies_.clear();
    for (std::size_t robot = 0; robot < active_ns_.size(); ++robot)
      if (active_.at_instant(robot))
        bodies_.push_back(body(moving(world().robots()[robot], sample.robots[robot]), robot));
    const std::size_t robots = bodies_.size();
    for (const Person& person : sample.people) bodies_.push_back(body(moving(person), person.id));
    people_ = people_ || !sample.people.empty();
    for (std::size_t a = 0; a < robots; ++a)
      for (std::size_t b = a + 1; b < bodies_.size(); ++b) {
        const double reach_m = bodies_[a].reach_m + bodies_[b].reach_m;
        const Vec2 apart = bodies_[b].moving.disc.center - bodies_[a].moving.disc.center;
        if (toolkit::squared_norm(apart) <= reach_m * reach_m)
          meet(bodies_[a], bodies_[b], b < robots ? with_robot : with_person, sample.t_ns);
      }
  }

  void finish(const TrialEnd&, MetricSink& sink) override {
    const std::array<const char*, kinds> names = {"encounters_head_on_person",   "encounters_overtaking_person",
                                                  "encounters_crossing_person",  "encounters_head_on_robot",
                                                  "encounters_overtaking_robot", "encounters_crossing_robot"};
    for (std::size_t kind = 0; kind < kinds; ++kind) {
      const bool met = kind < with_robot ? people_ : counts_.size() > 1;
      std::int64_t all = 0;
      std::int64_t all_ns = 0;
      for (std::size_t i = 0; i < counts_.size(); ++i) {
        all += counts_[i][kind];
        all_ns += active_ns_[i];
        sink.robot(names[kind], i, per_minute(counts_[i][kind], met ? active_ns_[i] : 0));
      }
      sink.system(names[kind], per_minute(all, met ? all_ns : 0));
    }
  }

 private:
  enum : std::size_t { head_on, overtaking, crossing, with_person = 0, with_robot = 3, kinds = 6 };
  struct Body {
    Moving moving;
    double speed;    // m/s
    double reach_m;  // two bodies farther apart than both reaches neither are near nor would be
    std::uint64_t id;
  };

  Body body(const Moving& moving, std::uint64_t id) const {
    const double speed = std::sqrt(toolkit::squared_norm(moving.velocity));
    const double margin_m = std::max<double>(apart_m, distance_m + speed * horizon_s);
    return {moving, speed, moving.disc.radius_m + margin_m, id};
  }

  static double per_minute(std::int64_t count, std::int64_t ns) {
    return ns > 0 ? static_cast<double>(count) / (in_seconds(ns) / 60.0) : undefined;
  }

  // Counts an encounter that begins now. `a` is a robot, `b` another one or a person.
  void meet(const Body& a, const Body& b, std::size_t with, std::int64_t now_ns) {
    Moving wider = b.moving;
    wider.disc.radius_m += distance_m;
    const double ahead_s = time_to_contact(a.moving, wider);  // 0: nearer already
    const bool on_course = ahead_s <= horizon_s;
    if (!on_course && !(surface_distance(a.moving.disc, b.moving.disc) < apart_m)) return;
    const auto last = last_ns_.find({with, a.id, b.id});
    if (last != last_ns_.end() && now_ns - last->second < std::llround(horizon_s * 1e9)) {
      last->second = now_ns;
    } else if (on_course && ahead_s > 0.0 && std::min(a.speed, b.speed) >= min_speed) {
      last_ns_[{with, a.id, b.id}] = now_ns;
      const std::size_t kind = with + kind_of(a, b);
      ++counts_[a.id][kind];
      if (with == with_robot) ++counts_[b.id][kind];
    }
  }

  std::size_t kind_of(const Body& a, const Body& b) const {
    const double along = toolkit::dot(a.moving.velocity, b.moving.velocity);
    const double least = std::cos(cone) * a.speed * b.speed;
    return along >= least ? overtaking : -along >= least ? head_on : crossing;
  }

  ActiveSteps active_;
  std::vector<std::int64_t> active_ns_;
  std::vector<std::array<std::int64_t, kinds>> counts_;                                    // by robot, then kind
  std::map<std::tuple<std::size_t, std::uint64_t, std::uint64_t>, std::int64_t> last_ns_;  // of each pair that met
  std::vector<Body> bodies_;  // at the sample: active robots, then people
  bool people_ = false;       // there were some
};

}  // namespace dmrp::metrics
