// SPDX-License-Identifier: MIT
#include "host/scenario/scenario_variant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dmrp::host {

std::string census_text(const MapCensus& census) {
  const auto share = [&](std::size_t cells) {
    const double percent = 100.0 * static_cast<double>(cells) / static_cast<double>(census.cells);
    if (cells > 0 && percent < 0.5) return std::string("under 1 %");
    return fmt::format("{:.0f} %", cells < census.cells ? std::min(std::round(percent), 99.0) : percent);
  };
  std::string text = fmt::format("{} cell{}: {} free, {} walls", census.cells, census.cells == 1 ? "" : "s",
                                 share(census.free), share(census.cells - census.free - census.unknown));
  if (census.unknown > 0)
    text += fmt::format(", {} unknown (count as {})", share(census.unknown), census.unknown_is_free ? "free" : "walls");
  return text;
}

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
