// SPDX-License-Identifier: MIT
#include <numeric>

#include "host/experiment/experiment.hpp"

namespace dmrp::host {

namespace {

// Indices of all uses, or just -1 where none is needed.
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
    const core::Scenario& world = experiment.scenarios[scenario].scenario;
    const bool robots = !world.robots.empty();
    const bool people = core::person_count(world) > 0;
    for (const std::int32_t planner : choices(experiment.global_planners, robots))
      for (const std::int32_t controller : choices(experiment.local_controllers, robots))
        for (const std::int32_t model : choices(experiment.pedestrian_models, people))
          out.push_back({scenario, planner, controller, model});
  }
  return out;
}

TrialId trial_id(std::uint64_t number, std::size_t combination_count) {
  return {number, static_cast<std::uint32_t>(number % combination_count),
          static_cast<std::uint32_t>(number / combination_count)};
}

}  // namespace dmrp::host
