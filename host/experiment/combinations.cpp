// SPDX-License-Identifier: MIT
#include <dmrp/toolkit/random.hpp>
#include <numeric>

#include "host/experiment/experiment.hpp"

namespace dmrp::host {

namespace {

// The indices of all uses, or -1 alone if none is needed.
std::vector<std::int32_t> choices(const std::vector<PluginUse>& uses, bool needed) {
  if (!needed) return {-1};
  std::vector<std::int32_t> out(uses.size());
  std::iota(out.begin(), out.end(), 0);
  return out;
}

}  // namespace

std::vector<Combination> combinations(const Experiment& experiment) {
  std::vector<Combination> out;
  for (std::uint32_t scenario = 0; scenario < experiment.scenarios.size(); ++scenario) {
    const bool robots = robot_count(experiment.scenarios[scenario]) > 0;
    const bool people = core::walker_count(experiment.scenarios[scenario].scenario) > 0;
    for (const std::int32_t planner : choices(experiment.global_planners, robots))
      for (const std::int32_t controller : choices(experiment.local_controllers, robots))
        for (const std::int32_t model : choices(experiment.pedestrian_models, people))
          out.push_back({scenario, planner, controller, model});
  }
  return out;
}

std::set<std::string> plugins_watched_for_memory(const Experiment& experiment) {
  std::set<std::string> ids;
  if (experiment.limits.memory_mb == 0) return ids;
  for (const auto* uses : plugin_lists(experiment))
    for (const PluginUse& use : *uses)
      if (use.info.has_flag(DMRP_FLAG_RESIDENT_MEMORY | DMRP_FLAG_PROCESSES)) ids.insert(use.info.id);
  return ids;
}

TrialId trial_id(std::uint64_t number, std::size_t combination_count) {
  return {number, static_cast<std::uint32_t>(number % combination_count),
          static_cast<std::uint32_t>(number / combination_count)};
}

std::uint64_t world_seed(const Experiment& experiment, const std::string& scenario, std::uint32_t repetition) {
  // 63 bits, so that it is a positive integer in every database.
  return toolkit::Stream(experiment.seed, "trial", scenario, repetition).next_u64() >> 1;
}

std::uint64_t task_seed(const Experiment& experiment, const std::string& scenario, const core::TaskWishes& wishes,
                        std::uint32_t repetition) {
  return world_seed(experiment, scenario, wishes.drawn > 0 ? repetition % wishes.drawn : repetition);
}

std::uint64_t trial_seed(const Experiment& experiment, std::uint64_t trial) {
  const auto all = combinations(experiment);
  const TrialId id = trial_id(trial, all.size());
  return world_seed(experiment, experiment.scenarios[all[id.combination].scenario].scenario.name, id.repetition);
}

}  // namespace dmrp::host
