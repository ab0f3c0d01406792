// SPDX-License-Identifier: MIT
#include "host/trial/run_trial.hpp"

#include <algorithm>

#include "core/ending.hpp"
#include "core/progress.hpp"
#include "core/world.hpp"
#include "host/trial/cast.hpp"

namespace dmrp::host {

namespace {

class Run {
 public:
  Run(const Trial& trial, InstancePool& pool, core::TraceEncoder& trace)
      : settings_(trial.variant.simulation),
        world_(trial.variant.scenario, trial.experiment.robot, settings_, trial.variant.geometry, trial.variant.routes,
               trial.seed),
        cast_(pool, trial.experiment, trial.combination, trial.variant, world_, trial.seed, trace),
        trace_(trace),
        monitor_(static_cast<std::uint32_t>(world_.robots().size()), settings_.time_limit_ns),
        paths_(world_.robots().size()),
        progress_(world_.robots().size()),
        gained_m_(world_.robots().size()) {}

  dmrp_trial_end run() {
    plan_ = cast_.plan(1, 0);
    trace_.plan(plan_.view(), plan_.conflicts);
    if (!plan_.exists()) return end_without_plan();
    take_up_plan();
    record({});

    std::uint32_t ending = monitor_.update(0, world_.robots(), gained_m_);
    while (ending == 0) {
      if (control_due()) control();  // sees the state that was recorded last
      const auto contacts = world_.step(cast_.walk(step_));
      ++step_;
      follow_progress();
      record(contacts);
      ending = monitor_.update(world_.t_ns(), world_.robots(), gained_m_);
    }
    ends_ = monitor_.robot_ends(ending, world_.robots());
    return end(ending);
  }

  // All arrived, and none of them oscillated on the way.
  bool succeeded() const {
    return std::all_of(ends_.begin(), ends_.end(), [](const dmrp_robot_end& end) {
      return end.state == DMRP_ROBOT_FINISHED && end.failure == DMRP_FAILURE_NONE;
    });
  }

 private:
  bool control_due() const { return world_.t_ns() % settings_.control_period_ns == 0; }

  void take_up_plan() {
    for (std::uint32_t i = 0; i < progress_.size(); ++i) {
      const core::RobotState& robot = world_.robots()[i];
      if (robot.state != DMRP_ROBOT_ACTIVE) continue;
      paths_[i] = path_to_drive(plan_.paths[i], world_.goals(i), plan_.step_duration_ns);
      progress_[i].set_path(paths_[i], {robot.pose.x, robot.pose.y});
      cast_.set_path(i, paths_[i], plan_.revision, step_);
    }
  }

  void control() {
    cast_.sense();
    for (std::uint32_t i = 0; i < world_.robots().size(); ++i) {
      if (world_.robots()[i].state != DMRP_ROBOT_ACTIVE) continue;
      const auto last_waypoint = static_cast<std::uint32_t>(paths_[i].size() - 1);
      if (const auto command = cast_.drive(i, progress_[i], last_waypoint, step_)) {
        world_.set_command(i, *command);
        monitor_.command_given(i, world_.t_ns());
      } else {
        world_.set_command(i, {0.0, 0.0, 0.0});
      }
      if (monitor_.failure(i) == DMRP_FAILURE_CONTROLLER) world_.fail(i);
    }
  }

  void follow_progress() {
    for (std::size_t i = 0; i < progress_.size(); ++i) {
      const core::RobotState& robot = world_.robots()[i];
      progress_[i].update({robot.pose.x, robot.pose.y}, robot.goal_index);
      gained_m_[i] = progress_[i].gained_m();
    }
  }

  void record(std::span<const dmrp_contact> contacts) {
    robots_.clear();
    for (std::size_t i = 0; i < progress_.size(); ++i) {
      const core::RobotState& robot = world_.robots()[i];
      robots_.push_back(
          {robot.pose, robot.velocity, robot.command, robot.state, robot.goal_index, progress_[i].progress_m()});
    }
    const auto people = world_.people();
    const auto calls = cast_.take_calls();
    dmrp_sample sample{};
    sample.struct_size = sizeof(sample);
    sample.control_tick = control_due();
    sample.t_ns = world_.t_ns();
    sample.dt_ns = step_ == 0 ? 0 : settings_.step_ns;
    sample.plan = &plan_.view();
    sample.robots = robots_.data();
    sample.robot_count = static_cast<std::uint32_t>(robots_.size());
    sample.robot_stride = sizeof(dmrp_robot_sample);
    sample.people = people.data();
    sample.person_count = static_cast<std::uint32_t>(people.size());
    sample.person_stride = sizeof(dmrp_person);
    sample.contacts = contacts.data();
    sample.contact_count = static_cast<std::uint32_t>(contacts.size());
    sample.contact_stride = sizeof(dmrp_contact);
    sample.calls = calls.data();
    sample.call_count = static_cast<std::uint32_t>(calls.size());
    sample.call_stride = sizeof(dmrp_call);
    trace_.sample(sample);
  }

  dmrp_trial_end end_without_plan() {
    for (const core::RobotState& robot : world_.robots()) ends_.push_back({robot.state, DMRP_FAILURE_NO_PLAN, -1});
    return end(DMRP_ENDING_NO_PLAN);
  }

  dmrp_trial_end end(std::uint32_t ending) {
    const dmrp_trial_end c = {sizeof(c),
                              ending,
                              world_.t_ns(),
                              ends_.data(),
                              static_cast<std::uint32_t>(ends_.size()),
                              sizeof(dmrp_robot_end)};
    static constexpr const char* const reasons[] = {"", "all robots arrived", "time limit", "deadlock",
                                                    "the planner found no plan"};
    trace_.end(c, reasons[ending]);
    return c;
  }

  const core::SimulationSettings& settings_;
  core::World world_;
  Cast cast_;
  core::TraceEncoder& trace_;
  core::EndingMonitor monitor_;
  PlannedPaths paths_;  // as the controllers have them: progress is counted along these
  std::vector<core::PathProgress> progress_;
  std::vector<double> gained_m_;
  Plan plan_;
  std::int64_t step_ = 0;
  std::vector<dmrp_robot_sample> robots_;
  std::vector<dmrp_robot_end> ends_;
};

}  // namespace

TrialEnding run_trial(const Trial& trial, InstancePool& pool, core::TraceEncoder& trace) {
  Run run(trial, pool, trace);
  const dmrp_trial_end end = run.run();
  TrialEnding ending;
  ending.succeeded = run.succeeded();
  ending.sim_time_s = static_cast<double>(end.t_ns) / 1e9;  // rounded once: 39.72 s are 39.72
  return ending;
}

}  // namespace dmrp::host
