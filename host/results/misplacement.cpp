// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "host/results/trial_record.hpp"

namespace dmrp::host {

std::string misplacement(const TrialRecord& row, const TrialRecord& place) {
  const auto differ = [](const char* what, const auto& is, const auto& should) {
    return fmt::format("its {} is '{}', in this experiment '{}'", what, is, should);
  };
  if (row.scenario != place.scenario) return differ("scenario", row.scenario, place.scenario);
  if (row.robots != place.robots) return differ("number of robots", row.robots, place.robots);
  if (row.global_planner != place.global_planner) return differ("planner", row.global_planner, place.global_planner);
  if (row.local_controller != place.local_controller)
    return differ("controller", row.local_controller, place.local_controller);
  if (row.pedestrian_model != place.pedestrian_model)
    return differ("pedestrian model", row.pedestrian_model, place.pedestrian_model);
  if (row.repetition != place.repetition) return differ("repetition", row.repetition, place.repetition);
  if (row.seed != place.seed) return differ("seed", row.seed, place.seed);
  return row.swept == place.swept ? "" : "its swept values are others than in this experiment";
}

}  // namespace dmrp::host
