// SPDX-License-Identifier: MIT
#include "host/terminal/arrivals_by_type.hpp"

#include <dmrp/descriptor.h>

#include <algorithm>
#include <cstdint>

namespace dmrp::host {
namespace {

struct Arrivals {
  std::string type;
  std::uint64_t robots = 0;
  std::uint64_t arrived = 0;
};

Arrivals& of_type(std::vector<Arrivals>& all, const std::string& type) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Arrivals& one) { return one.type == type; });
  return found == all.end() ? all.emplace_back(Arrivals{type}) : *found;
}

}  // namespace

std::string arrivals_by_type(const SummaryLayout& layout, const TypesOfRobots& types,
                             std::span<const TrialRecord> trials) {
  std::vector<Arrivals> all;
  for (const TrialRecord& trial : trials) {
    const auto robots = types.find({trial.scenario, trial.robots});
    if (robots == types.end()) continue;
    for (const MetricValue& value : trial.values) {
      if (value.metric != layout.arrived || value.subject_kind != DMRP_SUBJECT_ROBOT || value.coordinate) continue;
      if (!value.subject || *value.subject >= robots->second.size()) continue;
      Arrivals& arrivals = of_type(all, robots->second[*value.subject]);
      ++arrivals.robots;
      if (value.value && *value.value == 1.0) ++arrivals.arrived;
    }
  }
  if (all.size() < 2) return "";
  std::string line;
  for (const Arrivals& one : all) {
    if (!line.empty()) line += " · ";
    line += (one.type.empty() ? "default" : one.type) + " " + std::to_string(one.arrived) + " of " +
            std::to_string(one.robots);
  }
  return line;
}

}  // namespace dmrp::host
