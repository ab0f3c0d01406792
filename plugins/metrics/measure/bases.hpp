// SPDX-License-Identifier: MIT
// bases.hpp: the shapes that metrics share: of the first plan alone, with a state for each robot, over active time,
// counts of robots' events.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <string>
#include <vector>

#include "metrics/measure/values.hpp"

namespace dmrp::metrics {

// Looks at the first plan and at the robots' ends alone, not at what the robots do.
class FirstPlanMetric : public Metric {
 public:
  void begin(const MetricTrial& trial) final { first_plan_ = trial.plan; }
  void observe(const Sample&) final {}

 protected:
  bool has_paths() const { return first_plan_.size() > 0; }

  Plan first_plan_;  // none if planning failed
};

// Has a state for each robot, from which its values are computed at the end.
template <class State>
class RobotMetric : public Metric {
 public:
  void begin(const MetricTrial&) override { states_.assign(world().robots().size(), {}); }

 protected:
  // Reports value_of(state), or this member of the state, of each robot.
  template <class ValueOf>
  void give_of_states(MetricSink& sink, const char* name, OfSystem of_system, ValueOf&& value_of) const {
    give(sink, name, of_system, values_of(states_, value_of));
  }
  template <class ValueOf>
  void give_mean(MetricSink& sink, const char* name, ValueOf&& value_of) const {
    give_of_states(sink, name, &mean_of_defined, value_of);
  }

  std::vector<State> states_;  // by robot
};

// The steps in which a robot was active: on its way, neither arrived nor given up.
//
// In all metrics, a sample represents the step that ended with it: the interval (t - dt, t]. So the first sample
// represents no time, and the last one counts in full.
class ActiveSteps {
 public:
  void begin(std::size_t robot_count) {
    before_.assign(robot_count, false);
    now_.assign(robot_count, false);
  }

  void observe(const Sample& sample) {
    before_.swap(now_);
    for (std::size_t robot = 0; robot < now_.size(); ++robot)
      now_[robot] = sample.robots[robot].state == DMRP_ROBOT_ACTIVE;
  }

  // In the step that ended with the sample. The step of the arrival is the last active one; the first sample ends none.
  bool in_step(std::size_t robot) const { return before_[robot]; }

  // At the instant of the sample.
  bool at_instant(std::size_t robot) const { return now_[robot]; }

 private:
  std::vector<char> before_;
  std::vector<char> now_;
};

// Adds each step in which a robot is active to the robot's state.
template <class State>
class ActiveTimeMetric : public RobotMetric<State> {
 public:
  void begin(const MetricTrial& trial) override {
    RobotMetric<State>::begin(trial);
    active_.begin(this->states_.size());
  }

  void observe(const Sample& sample) override {
    active_.observe(sample);
    for (std::size_t robot = 0; robot < this->states_.size(); ++robot)
      if (active_.in_step(robot)) add_step(this->states_[robot], robot, sample);
  }

 protected:
  virtual void add_step(State& state, std::size_t robot, const Sample& sample) = 0;

  ActiveSteps active_;
};

// Counts what happened to each robot; the system's value is the sum; undefined if planning failed. What lasts is a spell
// of the robot's, and an event of the time line.
class CountOfEvents : public Metric {
 public:
  void begin(const MetricTrial& trial) override {
    const std::size_t robot_count = world().robots().size();
    counts_.assign(robot_count, trial.plan ? 0.0 : undefined);
    spells_.clear();
    open_.assign(robot_count, nothing);
  }

 protected:
  struct RobotSpell {
    std::uint32_t robot;
    Spell time;
    Vec2 place;  // where it began
    std::string text;
  };

  // Of this kind, and of a robot that there is.
  bool is(const RobotEvent& event, std::uint32_t kind) const {
    return event.kind == kind && event.robot < counts_.size();
  }

  // Null: the robot has none.
  RobotSpell* open_spell(std::size_t robot) { return open_[robot] == nothing ? nullptr : &spells_[open_[robot]]; }
  void begin_spell(const RobotEvent& event, const Sample& sample, const std::string& text) {
    open_[event.robot] = spells_.size();
    const Vec2 place = toolkit::position(sample.robots[event.robot].pose);
    spells_.push_back({event.robot, {event.t_ns, event.t_ns}, place, text});
    counts_[event.robot] += 1.0;
  }
  void end_spell(std::size_t robot) { open_[robot] = nothing; }

  void give_counts(MetricSink& sink, const char* name, Severity severity) const {
    for (const RobotSpell& spell : spells_)
      give_event(sink, name, spell.time, {spell.robot}, spell.text, spell.place, severity);
    give(sink, name, &sum_of_defined, counts_);
  }

  std::vector<double> counts_;      // by robot
  std::vector<RobotSpell> spells_;  // in order of their beginnings

 private:
  static constexpr std::size_t nothing = SIZE_MAX;

  std::vector<std::size_t> open_;  // by robot, in spells_
};

}  // namespace dmrp::metrics
