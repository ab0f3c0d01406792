// SPDX-License-Identifier: MIT
#include "host/scenario/scenario_variant.hpp"

#include <algorithm>

namespace dmrp::host {

core::TaskRequest task_request(const ScenarioVariant& variant) {
  return {variant.most_drawn, variant.drawn_types, variant.scenario.inside, variant.wishes};
}

std::vector<std::string> types_in_use(const ScenarioVariant& variant) {
  std::vector<std::string> types;
  for (const core::RobotTask& task : variant.scenario.robots) types.push_back(task.type);
  if (variant.drawn_robots > 0 && variant.drawn_types.empty()) types.emplace_back();
  for (const core::TypeShare& share : variant.drawn_types) types.push_back(share.type);
  std::sort(types.begin(), types.end());
  types.erase(std::unique(types.begin(), types.end()), types.end());
  return types;
}

}  // namespace dmrp::host
