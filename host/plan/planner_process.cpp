// SPDX-License-Identifier: MIT
#include "host/plan/planner_process.hpp"

#include <fmt/format.h>

#include <vector>

#include "host/errors/machine_error.hpp"
#include "host/guests/command_guests.hpp"
#include "host/guests/exchange/plan_message.hpp"
#include "host/guests/guest_end.hpp"

namespace dmrp::host {

namespace {

constexpr std::int64_t call_grace_ns = 5'000'000'000;    // after should_stop() has returned true
constexpr std::int64_t least_limit_ns = 15'000'000'000;  // for all functions but plan()

// Of its cells, and of those that differ by type of robot.
std::vector<dmrp_grid> grids_of(const StagedProblem& problem) {
  std::vector<dmrp_grid> grids = {problem.grid};
  for (const auto& [type, grid] : problem.grids) grids.push_back(grid);
  return grids;
}

class Question {
 public:
  Question(const Experiment& experiment, const PlanTask& task)
      : experiment_(experiment), task_(task), guests_(experiment.libraries, experiment.limits, DMRP_LOG_INFO) {
    guests_.watch([this]() -> std::string {
      if (watchdog_.look(); watchdog_.elapsed_ns(start_ns_) <= limit_ns_) return "";
      return fmt::format("did not stop when its time of {} s was over, and was killed",
                         experiment_.limits.planner_time_s);
    });
  }

  PlannerAnswer ask() {
    const std::int64_t budget_ns = task_.problem.c.time_budget_ns;
    limit(std::max(budget_ns + call_grace_ns, least_limit_ns));
    guests_.begin_trial(0, -1);
    const GuestInstance& planner = guests_.all().get(experiment_.global_planners[0], DMRP_NO_ROBOT);
    Guest& guest = *planner.guest;
    const SentWorld& world = guest.shared_world(task_.world(), grids_of(task_.problem));
    Arena& arena = guest.begin();
    guest.call({GuestTask::start, planner.number, 0, budget_ns,
                arena.copy(StartInput{&world.world(), guest.scene(world, {}), experiment_.seed, 0, 0})});
    limit(budget_ns + call_grace_ns);
    guest.begin();
    const PlanInput* const input = arena.copy(plan_input(arena, guest.output(), world, task_.problem.c));
    const std::string_view text = guest.call({GuestTask::plan, planner.number, 0, budget_ns, input});
    return planner_answer(text, *input, task_.problem.c.robot_count, planner.site("plan", 0));
  }

  // The most memory that the planner's process had, in MB.
  double end() { return guests_.end(experiment_.global_planners[0].library); }

 private:
  void limit(std::int64_t ns) {
    start_ns_ = monotonic_ns();
    limit_ns_ = ns;
  }

  const Experiment& experiment_;
  const PlanTask& task_;
  Watchdog watchdog_;
  std::int64_t start_ns_ = 0;  // of the call that runs
  std::int64_t limit_ns_ = 0;
  CommandGuests guests_;
};

}  // namespace

PlannerRun run_planner(const Experiment& experiment, const PlanTask& task) {
  PlannerRun run;
  Question question(experiment, task);
  try {
    run.answer = question.ask();
  } catch (const PluginFault& fault) {
    run.fault = fault.kind();
    run.detail = words_of(fault);
  } catch (const std::runtime_error& error) {
    run.fault = fault_kind::abi_breach;
    run.detail = error.what();
  }
  run.peak_rss_mb = question.end();
  return run;
}

}  // namespace dmrp::host
