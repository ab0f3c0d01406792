// SPDX-License-Identifier: MIT
// A metric measures a trial in which robots and people go straight on.

#include <cmath>
#include <limits>
#include <memory>

#include "host/check/rehearsal/rehearsal.hpp"
#include "host/check/rehearsal/stage_extensions.hpp"
#include "host/guests/inside/measure.hpp"

namespace dmrp::host {

namespace {

class MetricCalls {
 public:
  MetricCalls(Instance& instance, const PluginInfo& info, Stage& stage)
      : info_(info),
        stage_(stage),
        robot_count_(static_cast<std::uint32_t>(stage.world.robots().size())),
        extensions_(instance, info, stage, 0),
        inputs_(stage.settings.grown_bytes),
        plans_(stage.settings.grown_bytes),
        measurement_(instance, info, 0, robot_count_, stage_budget_ns) {
    if (!stage.settings.fails_to_plan && robot_count_ > 0) plan_ = stage.straight_plan();
    for (std::uint32_t i = 0; i < robot_count_; ++i) stage.world.set_command(i, {0.5, 0.0, 0.0});
  }

  bool next(Outputs& outputs) {
    if (step_ == 0) begin();
    const bool shown = !stage_.settings.fails_to_plan || (info_.channels & DMRP_CHANNEL_CALLS) != 0;
    const std::int64_t samples = stage_.settings.fails_to_plan ? 1 : stage_.settings.ticks;
    if (!shown || step_ >= samples) return finish(outputs);
    observe(step_ == 0 ? std::span<const dmrp_contact>() : stage_.step());
    ++step_;
    return true;
  }

 private:
  static constexpr std::uint32_t unknown_kind = 1000;

  void begin() {
    if (plan_.exists()) c_plan_ = &grown_plan(plan_.view());
    const dmrp_metric_trial* const trial = plans_.one(dmrp_metric_trial{0, 0, c_plan_});
    plans_.seal();
    measurement_.begin(*trial);
  }

  const dmrp_plan& grown_plan(const dmrp_plan& plan) {
    dmrp_plan& grown = *plans_.one(plan);
    grown.paths = plans_.paths(plan.paths, plan.path_count);
    grown.path_stride = plans_.stride<dmrp_path>();
    return grown;
  }

  void observe(std::span<const dmrp_contact> seen) {
    inputs_.clear();
    std::vector<dmrp_contact> contacts(seen.begin(), seen.end());
    const core::World& world = stage_.world;
    std::vector<dmrp_robot_sample> robots;
    std::vector<dmrp_call> calls;
    const std::int32_t planned = stage_.settings.fails_to_plan ? DMRP_NO_SOLUTION : DMRP_OK;
    if (step_ == 0 && robot_count_ > 0) calls.push_back({DMRP_CALL_PLAN, DMRP_ALL_ROBOTS, planned, 0, 5'000'000});
    if (step_ == 1) calls.push_back({DMRP_CALL_CONTROL, DMRP_ALL_ROBOTS, DMRP_OK, 0, 1'000'000});
    for (std::uint32_t i = 0; i < robot_count_; ++i) {
      const core::RobotState& robot = world.robots()[i];
      const double progress_m = std::abs(robot.pose.x - stage_.variant.scenario.robots[i].start.x);
      robots.push_back({robot.pose, robot.velocity, robot.command, robot.state, robot.goal_index, progress_m, 0.0,
                        robot.command, DMRP_OK, 0});
      if (!stage_.settings.fails_to_plan) calls.push_back({DMRP_CALL_CONTROL, i, DMRP_OK, 0, 1'000'000});
    }
    if (stage_.settings.unknown_kinds && robot_count_ > 0) {
      calls.push_back({unknown_kind, 0, DMRP_OK, 0, 7'000'000'000});
      contacts.push_back({unknown_kind, DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_A, 0, 0, 0.1, {0.0, 0.0}, 1.0});
    }
    const auto people = world.people();
    dmrp_sample sample{};
    sample.control_tick = world.t_ns() % stage_.variant.simulation.control_period_ns == 0;
    sample.t_ns = world.t_ns();
    sample.dt_ns = step_ == 0 ? 0 : stage_.variant.simulation.step_ns;
    sample.plan = c_plan_;
    sample.robots = inputs_.array(robots.data(), robots.size());
    sample.robot_count = robot_count_;
    sample.robot_stride = inputs_.stride<dmrp_robot_sample>();
    sample.people = inputs_.array(people.data(), people.size());
    sample.person_count = static_cast<std::uint32_t>(people.size());
    sample.person_stride = inputs_.stride<dmrp_person>();
    sample.contacts = inputs_.array(contacts.data(), contacts.size());
    sample.contact_count = static_cast<std::uint32_t>(contacts.size());
    sample.contact_stride = inputs_.stride<dmrp_contact>();
    sample.calls = inputs_.array(calls.data(), calls.size());
    sample.call_count = static_cast<std::uint32_t>(calls.size());
    sample.call_stride = inputs_.stride<dmrp_call>();
    const std::vector<dmrp_robot_event> events = events_of(world);
    sample.events = inputs_.array(events.data(), events.size());
    sample.event_count = static_cast<std::uint32_t>(events.size());
    sample.event_stride = inputs_.stride<dmrp_robot_event>();
    sample.route_stride = inputs_.stride<dmrp_route>();
    const dmrp_sample* const grown = inputs_.one(sample);
    inputs_.seal();
    measurement_.observe(*grown);
  }

  // Each robot begins as moving; then one event of each kind.
  std::vector<dmrp_robot_event> events_of(const core::World& world) const {
    std::vector<dmrp_robot_event> events;
    if (stage_.settings.fails_to_plan) return events;
    for (std::uint32_t i = 0; step_ == 0 && i < robot_count_; ++i)
      events.push_back({DMRP_ROBOT_EVENT_CLASS, i, world.t_ns(), DMRP_CLASS_MOVING, DMRP_NOBODY});
    const std::int64_t before_ns = world.t_ns() - stage_.variant.simulation.step_ns;
    if (step_ > 0 && step_ <= DMRP_ROBOT_EVENT_RUNS_ON && robot_count_ > 0)
      events.push_back({static_cast<std::uint32_t>(step_), 0, before_ns, 0, DMRP_NOBODY});
    if (stage_.settings.unknown_kinds) events.push_back({unknown_kind, 0, world.t_ns(), 7, 0});
    return events;
  }

  bool finish(Outputs& outputs) {
    inputs_.clear();
    const bool failed = stage_.settings.fails_to_plan;
    const std::vector<dmrp_robot_end> ends(
        robot_count_,
        {DMRP_ROBOT_ACTIVE, failed ? std::uint32_t{DMRP_FAILURE_NO_PLAN} : DMRP_FAILURE_TIMEOUT, -1, 0, DMRP_NOBODY});
    const dmrp_trial_end* const end = inputs_.one(
        dmrp_trial_end{0, failed ? std::uint32_t{DMRP_ENDING_NO_PLAN} : DMRP_ENDING_TIME_LIMIT, stage_.world.t_ns(),
                       inputs_.array(ends.data(), ends.size()), robot_count_, inputs_.stride<dmrp_robot_end>()});
    inputs_.seal();
    const MetricResult result = measurement_.finish(*end);
    const double none = std::numeric_limits<double>::quiet_NaN();
    for (const MetricValue& value : result.values)
      outputs.insert(outputs.end(), {static_cast<double>(value.subject.value_or(0)), value.coordinate.value_or(none),
                                     value.value.value_or(none)});
    for (const MetricEvent& event : result.events)
      outputs.insert(outputs.end(), {static_cast<double>(event.from_ns), static_cast<double>(event.to_ns)});
    return false;
  }

  const PluginInfo& info_;
  Stage& stage_;
  std::uint32_t robot_count_;
  StageExtensions extensions_;
  Inputs inputs_;  // of the call that runs
  Inputs plans_;   // valid until finish() returns
  Plan plan_;
  const dmrp_plan* c_plan_ = nullptr;
  Measurement measurement_;
  std::int64_t step_ = 0;
};

}  // namespace

Calls metric_calls(Instance& instance, const PluginInfo& info, Stage& stage) {
  return
      [calls = std::make_shared<MetricCalls>(instance, info, stage)](Outputs& outputs) { return calls->next(outputs); };
}

}  // namespace dmrp::host
