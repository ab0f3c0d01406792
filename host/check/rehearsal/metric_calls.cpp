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
        declared_(info),
        measurement_(instance, declared_, 0, robot_count_, stage_budget_ns) {
    if (stage.settings.shows_all) declared_.channels = ~0u;
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
    const core::World& world = stage_.world;
    const std::vector<dmrp_person> people = stage_.people();
    const std::vector<dmrp_robot_sample> robots = robots_of(world);
    const std::vector<dmrp_contact> contacts = contacts_of(seen, static_cast<std::uint32_t>(people.size()));
    const std::vector<dmrp_call> calls = calls_made();
    const std::vector<dmrp_robot_event> events = events_of(world);
    const std::vector<dmrp_route> routes = routes_handed();
    dmrp_sample sample{};
    sample.control_tick = world.t_ns() % stage_.variant.simulation.control_period_ns == 0;
    sample.t_ns = world.t_ns();
    sample.dt_ns = step_ == 0 ? 0 : stage_.variant.simulation.step_ns;
    sample.plan = c_plan_;
    show(robots, sample.robots, sample.robot_count, sample.robot_stride);
    show(people, sample.people, sample.person_count, sample.person_stride);
    show(contacts, sample.contacts, sample.contact_count, sample.contact_stride);
    show(calls, sample.calls, sample.call_count, sample.call_stride);
    show(events, sample.events, sample.event_count, sample.event_stride);
    show(routes, sample.routes, sample.route_count, sample.route_stride);
    const dmrp_sample* const grown = inputs_.one(sample);
    inputs_.seal();
    measurement_.observe(*grown);
  }

  template <class Element>
  void show(const std::vector<Element>& elements, const Element*& first, std::uint32_t& count, std::uint32_t& stride) {
    first = inputs_.array(elements.data(), elements.size());
    count = static_cast<std::uint32_t>(elements.size());
    stride = inputs_.stride<Element>();
  }

  std::vector<dmrp_robot_sample> robots_of(const core::World& world) const {
    std::vector<dmrp_robot_sample> robots;
    const double factor = stage_.settings.is_fast ? 5.0 : 1.0;
    for (std::uint32_t i = 0; i < robot_count_; ++i) {
      const core::RobotState& robot = world.robots()[i];
      const double progress_m = std::abs(robot.pose.x - stage_.variant.scenario.robots[i].start.x);
      const dmrp_twist velocity = {factor * robot.velocity.v_x, robot.velocity.v_y, factor * robot.velocity.omega};
      robots.push_back({robot.pose, velocity, robot.command, robot.state, stage_.settings.first_goal + robot.goal_index,
                        progress_m, 0.0, robot.command, DMRP_OK, 0});
    }
    return robots;
  }

  std::vector<dmrp_call> calls_made() const {
    std::vector<dmrp_call> calls;
    const bool fails = stage_.settings.fails_to_plan;
    const std::int32_t planned = fails ? DMRP_NO_SOLUTION : DMRP_OK;
    if (step_ == 0 && robot_count_ > 0) calls.push_back({DMRP_CALL_PLAN, DMRP_ALL_ROBOTS, planned, 0, 5'000'000});
    if (step_ == 1) calls.push_back({DMRP_CALL_CONTROL, DMRP_ALL_ROBOTS, DMRP_OK, 0, 1'000'000});
    if (step_ == 2) calls.push_back({DMRP_CALL_PEOPLE, DMRP_ALL_ROBOTS, DMRP_OK, 0, 1'000'000});
    for (std::uint32_t i = 0; !fails && i < robot_count_; ++i)
      calls.push_back({DMRP_CALL_CONTROL, i, DMRP_OK, 0, 1'000'000});
    if (stage_.settings.unknown_kinds && robot_count_ > 0)
      calls.push_back({unknown_kind, 0, DMRP_OK, 0, 7'000'000'000});
    return calls;
  }

  // Those of the stage, and at two steps a wall, another robot and a person that the first robot touches.
  std::vector<dmrp_contact> contacts_of(std::span<const dmrp_contact> seen, std::uint32_t people) const {
    if (stage_.settings.fails_to_plan || robot_count_ == 0) return {};
    std::vector<dmrp_contact> contacts(seen.begin(), seen.end());
    if (step_ == 3 || step_ == 4) {
      const std::uint32_t flags = (step_ == 3 ? DMRP_CONTACT_BEGINS : 0) | DMRP_CONTACT_FAULT_A;
      const double impact = step_ == 3 ? 0.4 : std::numeric_limits<double>::quiet_NaN();
      const auto border = static_cast<std::uint32_t>(stage_.variant.scenario.shapes.size());
      contacts = {{DMRP_CONTACT_STATIC, flags, 0, border, 0.01, {}, impact}};
      if (robot_count_ > 1) contacts.push_back({DMRP_CONTACT_ROBOT, flags, 0, 1, 0.01, {}, impact});
      if (people > 0) contacts.push_back({DMRP_CONTACT_PERSON, flags, 0, people - 1, 0.01, {}, impact});
    }
    if (stage_.settings.unknown_kinds)
      contacts.push_back({unknown_kind, DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_A, 0, 0, 0.1, {0.0, 0.0}, 1.0});
    return contacts;
  }

  // Each robot begins as moving; then come one event of each kind, each step of a recovery, and each class, with another
  // robot where it has one.
  std::vector<dmrp_robot_event> events_of(const core::World& world) const {
    std::vector<dmrp_robot_event> events;
    if (stage_.settings.fails_to_plan) return events;
    const std::int64_t before_ns = world.t_ns() - stage_.variant.simulation.step_ns;
    const auto step = static_cast<std::uint32_t>(step_);
    for (std::uint32_t i = 0; i < robot_count_; ++i) {
      if (step == 0) events.push_back({DMRP_ROBOT_EVENT_CLASS, i, world.t_ns(), DMRP_CLASS_MOVING, DMRP_NOBODY});
      if (step == 0) continue;
      if (i == 0 && step <= DMRP_ROBOT_EVENT_RUNS_ON && step != DMRP_ROBOT_EVENT_CLASS)
        events.push_back({step, i, before_ns, 0, DMRP_NOBODY});
      if (i == 0 && step > DMRP_ROBOT_EVENT_RUNS_ON && step - DMRP_ROBOT_EVENT_RUNS_ON <= DMRP_RECOVERY_REPLAN)
        events.push_back({DMRP_ROBOT_EVENT_RECOVERY, i, before_ns, step - DMRP_ROBOT_EVENT_RUNS_ON, DMRP_NOBODY});
      if (step % robot_count_ != i) continue;
      const std::uint32_t whole = step / robot_count_ % (DMRP_CLASS_STUCK + 1);
      const bool has_other = whole == DMRP_CLASS_HELD || whole == DMRP_CLASS_BLOCKED_ROBOT;
      const std::uint32_t bits = whole != DMRP_CLASS_MOVING && step % 2 == 0 ? DMRP_CLASS_CIRCLING : 0;
      events.push_back({DMRP_ROBOT_EVENT_CLASS, i, before_ns, whole | bits,
                        has_other && robot_count_ > 1 ? (i + 1) % robot_count_ : DMRP_NOBODY});
    }
    if (stage_.settings.unknown_kinds) events.push_back({unknown_kind, 0, world.t_ns(), 7, 0});
    return events;
  }

  // One robot gets a part of its path at every third step.
  std::vector<dmrp_route> routes_handed() {
    if (!plan_.exists() || step_ % 3 != 0) return {};
    const auto robot = static_cast<std::uint32_t>(step_ / 3 % robot_count_);
    const auto& whole = plan_.paths[robot];
    const auto count = static_cast<std::uint32_t>((whole.size() + 1) / 2);
    const dmrp_path part = {0, count, sizeof(dmrp_waypoint), count < whole.size() ? DMRP_PATH_PARTIAL : 0u,
                            whole.data()};
    return {{robot, step_ < 9 ? 0u : DMRP_PATH_CONTINUES, inputs_.paths(&part, 1)}};
  }

  bool finish(Outputs& outputs) {
    inputs_.clear();
    const bool failed = stage_.settings.fails_to_plan;
    const std::uint32_t unknown_failure = stage_.settings.unknown_kinds ? unknown_kind : DMRP_FAILURE_TIMEOUT;
    const dmrp_robot_end without_plan = {DMRP_ROBOT_ACTIVE, DMRP_FAILURE_NO_PLAN, -1, 0, DMRP_NOBODY};
    const dmrp_robot_end others[] = {{DMRP_ROBOT_ACTIVE, unknown_failure, -1, 0, DMRP_NOBODY},
                                     {DMRP_ROBOT_FINISHED, DMRP_FAILURE_NONE, stage_.world.t_ns(), 1, DMRP_NOBODY},
                                     {DMRP_ROBOT_FAILED, DMRP_FAILURE_BLOCKED_ROBOT, -1, 0, 0}};
    std::vector<dmrp_robot_end> ends;
    for (std::uint32_t i = 0; i < robot_count_; ++i) ends.push_back(failed ? without_plan : others[i % 3]);
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
  PluginInfo declared_;
  Measurement measurement_;
  std::int64_t step_ = 0;
};

}  // namespace

Calls metric_calls(Instance& instance, const PluginInfo& info, Stage& stage) {
  return
      [calls = std::make_shared<MetricCalls>(instance, info, stage)](Outputs& outputs) { return calls->next(outputs); };
}

}  // namespace dmrp::host
