// SPDX-License-Identifier: MIT
#include "host/experiment/experiment.hpp"

namespace dmrp::host {

std::vector<Combination> combinations(const Experiment& experiment) {
  std::vector<Combination> out;
  for (std::uint32_t scenario = 0; scenario < experiment.scenarios.size(); ++scenario) {
    const bool people = core::person_count(experiment.scenarios[scenario].scenario) > 0;
    const std::int32_t first = people ? 0 : -1;
    const std::int32_t last = people ? static_cast<std::int32_t>(experiment.pedestrian_models.size()) - 1 : -1;
    for (std::uint32_t planner = 0; planner < experiment.global_planners.size(); ++planner)
      for (std::uint32_t controller = 0; controller < experiment.local_controllers.size(); ++controller)
        for (std::int32_t model = first; model <= last; ++model) out.push_back({scenario, planner, controller, model});
  }
  return out;
}

TrialId trial_id(std::uint64_t number, std::size_t combination_count) {
  return {number, static_cast<std::uint32_t>(number % combination_count),
          static_cast<std::uint32_t>(number / combination_count)};
}

}  // namespace dmrp::host
