// SPDX-License-Identifier: MIT
#include "host/plan/check_plan_files.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/errors/mistakes.hpp"
#include "host/plans/plan_file.hpp"
#include "host/world/variant_world.hpp"

namespace dmrp::host {

namespace {

// Repetitions from 0 on in which all tasks and files occur.
std::uint32_t different_repetitions(const Experiment& experiment, const ScenarioVariant& variant,
                                    const PlanFiles& plans) {
  if (plans.is_one_each()) return experiment.trials;
  if (!is_drawn(variant)) return 1;
  return variant.wishes.drawn > 0 ? std::min(variant.wishes.drawn, experiment.trials) : experiment.trials;
}

// The plans of one use for the trials of one scenario.
class PlansOfScenario {
 public:
  PlansOfScenario(const Experiment& experiment, const PluginUse& use, const ScenarioVariant& scenario)
      : experiment_(experiment), use_(use), scenario_(scenario), shared_(experiment, scenario), plans_(use.plans) {}

  // Why there is no plan in this repetition; "" if there is one. Throws InputError if no planner may give it.
  std::string check(std::uint32_t repetition) {
    if (!is_drawn(scenario_)) return check(repetition, shared_);
    const std::uint64_t seed = task_seed(experiment_, scenario_.scenario.name, scenario_.wishes, repetition);
    return check(repetition, VariantWorld(experiment_, scenario_, shared_, seed));
  }

 private:
  std::string check(std::uint32_t repetition, const VariantWorld& world) {
    StagedProblem problem;
    stage_first_problem(experiment_, world, problem);
    const std::string task = task_hash(world.scenario);
    const PlannerAnswer answer = plans_.answer(repetition, task, problem.c);
    if (answer.status != DMRP_OK) return answer.text;
    const PlanVerdict verdict =
        validate_plan(problem.c, answer.paths, use_.info.connectivity,
                      [&](auto from, auto to, double radius_m) { return world.sweep_is_free(from, to, radius_m); });
    if (const std::string breach = breach_of(verdict, use_.info); !breach.empty())
      plans_.file().fail(task, verdict.robot, verdict.waypoint,
                         fmt::format("{} (scenario '{}', repetition {})", breach, scenario_.label, repetition));
    return "";
  }

  const Experiment& experiment_;
  const PluginUse& use_;
  const ScenarioVariant& scenario_;
  const VariantWorld shared_;
  PlansOfFiles plans_;
};

void check_use(const Experiment& experiment, const PluginUse& use, std::vector<std::string>& warnings) {
  for (const ScenarioVariant& scenario : experiment.scenarios) {
    if (robot_count(scenario) == 0) continue;
    PlansOfScenario plans(experiment, use, scenario);
    const std::uint32_t repetitions = different_repetitions(experiment, scenario, use.plans);
    std::uint32_t without_plan = 0;
    std::string first;
    for (std::uint32_t repetition = 0; repetition < repetitions; ++repetition) {
      const std::string why = plans.check(repetition);
      if (!why.empty() && without_plan++ == 0) first = why;
    }
    if (without_plan > 0)
      warnings.push_back(fmt::format("{}: no plan for {} of {} tasks of scenario '{}': {}", use.label, without_plan,
                                     repetitions, scenario.label, first));
  }
}

}  // namespace

std::vector<std::string> check_plan_files(const Experiment& experiment) {
  std::vector<std::string> warnings;
  Mistakes mistakes;
  for (const PluginUse& use : experiment.global_planners)
    if (use.plans.is_given()) mistakes.attempt([&] { check_use(experiment, use, warnings); });
  mistakes.end();
  return warnings;
}

}  // namespace dmrp::host
