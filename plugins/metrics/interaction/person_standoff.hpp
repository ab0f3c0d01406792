// SPDX-License-Identifier: MIT
// person_standoff.hpp: robots that fail after a person and they stood before each other.
#pragma once

#include "metrics/measure/bases.hpp"

namespace dmrp::metrics {

// A robot and a person who have not moved since.
struct StandingWithPerson {
  std::uint64_t person;
  Spell time;
  Vec2 robot_at;
  Vec2 person_at;
};

struct RobotStandoffs {
  bool measured = false;                   // was active
  std::vector<StandingWithPerson> open;    // at the last sample
  std::vector<StandingWithPerson> lasted;  // long enough
};

class PersonStandoff final : public RobotMetric<RobotStandoffs> {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.person_standoff", "Person stand-off")
        .summary("share of failed robots that stood before a person who stood before them")
        .source("own definition")
        .channels(DMRP_CHANNEL_PEOPLE)
        .value("person_standoff", "1", lower_is_better, system_and_robots,
               "of a robot that failed: 1 if it and a person who wants to walk were within distance_m of each other "
               "for lasting_s without moving by more than moved_m, else 0; undefined if it succeeded or planning "
               "failed; system: mean over failed robots");
  }

  Param<double> lasting_s =
      param("lasting_s", 10.0).unit("s").range(0.0, 10000.0).doc("they stand before each other at least this long");
  Param<double> distance_m =
      param("distance_m", 1.3).unit("m").range(0.0, 100.0).doc("at most this far apart, centre to centre");
  Param<double> moved_m =
      param("moved_m", 0.3).unit("m").range(0.0, 100.0).doc("who moves farther than this no longer stands");

  void begin(const MetricTrial& trial) override {
    RobotMetric::begin(trial);
    active_.begin(states_.size());
  }

  void observe(const Sample& sample) override {
    active_.observe(sample);
    for (std::size_t robot = 0; robot < states_.size(); ++robot) {
      RobotStandoffs& own = states_[robot];
      if (active_.in_step(robot)) own.measured = true;
      std::vector<StandingWithPerson> now;
      if (active_.at_instant(robot)) now = standing(own, toolkit::position(sample.robots[robot].pose), sample);
      for (const StandingWithPerson& before : own.open)
        if (std::none_of(now.begin(), now.end(), [&](const StandingWithPerson& one) {
              return one.person == before.person && one.time.from_ns == before.time.from_ns;
            }))
          close(own, before);
      own.open = std::move(now);
    }
  }

  void finish(const TrialEnd& end, MetricSink& sink) override {
    std::vector<double> values;
    for (std::uint32_t robot = 0; robot < states_.size(); ++robot) {
      RobotStandoffs& own = states_[robot];
      for (const StandingWithPerson& standing : own.open) close(own, standing);
      for (const StandingWithPerson& standoff : own.lasted)
        give_event(sink, "person_standoff", standoff.time, {robot},
                   "robot " + std::to_string(robot) + " and person " + std::to_string(standoff.person) +
                       " stand before each other");
      const bool counts = own.measured && !succeeded(end.robots[robot]);
      values.push_back(!counts ? undefined : own.lasted.empty() ? 0.0 : 1.0);
    }
    give(sink, "person_standoff", &mean_of_defined, values);
  }

 private:
  // With whom the robot stands at the sample, and since when.
  std::vector<StandingWithPerson> standing(const RobotStandoffs& own, Vec2 place, const Sample& sample) const {
    std::vector<StandingWithPerson> now;
    for (const Person& person : sample.people) {
      if (person.desired_speed <= 0.0 || toolkit::distance(place, person.position) > distance_m) continue;
      const auto before = std::find_if(own.open.begin(), own.open.end(), [&](const StandingWithPerson& one) {
        return one.person == person.id && toolkit::distance(one.robot_at, place) <= moved_m &&
               toolkit::distance(one.person_at, person.position) <= moved_m;
      });
      now.push_back(before != own.open.end()
                        ? *before
                        : StandingWithPerson{person.id, {sample.t_ns, sample.t_ns}, place, person.position});
      now.back().time.to_ns = sample.t_ns;
    }
    return now;
  }

  void close(RobotStandoffs& own, const StandingWithPerson& standing) const {
    if (standing.time.to_ns - standing.time.from_ns >= std::llround(lasting_s * 1e9)) own.lasted.push_back(standing);
  }

  ActiveSteps active_;
};

}  // namespace dmrp::metrics
