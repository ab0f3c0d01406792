// SPDX-License-Identifier: MIT
// people_counts.hpp: how many people there are in a trial.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "host/results/manifest.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

using PeopleCounts = std::map<std::pair<std::string, std::uint32_t>, std::uint32_t>;  // by scenario and robots

inline PeopleCounts people_counts(std::span<const ScenarioFacts> scenarios) {
  PeopleCounts counts;
  for (const ScenarioFacts& facts : scenarios) counts[{facts.name, facts.robots}] = facts.people;
  return counts;
}

// 0 without a pedestrian model.
inline std::uint32_t people_in(const PeopleCounts& counts, const TrialRecord& trial) {
  const auto found = counts.find({trial.scenario, trial.robots});
  return trial.pedestrian_model.empty() || found == counts.end() ? 0 : found->second;
}

}  // namespace dmrp::host
