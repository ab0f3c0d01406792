// SPDX-License-Identifier: MIT
// arrivals_by_type.hpp: how many robots of each type arrived, where an experiment has several types.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/results/manifest.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

struct TypeArrivals {
  std::string type;  // "default" for [robot]
  std::uint64_t robots = 0;
  std::uint64_t arrived = 0;
};

// Counts the robots of a trial, by the types of its scenario. Types get their places in `counts` in the order in which
// they first occur. `arrived` is the metric that is 1 for a robot that arrived.
void count_arrivals(const std::string& arrived, std::span<const ScenarioFacts> scenarios, const TrialRecord& trial,
                    std::vector<TypeArrivals>& counts);

// "default 20 of 20 · transporter 19 of 20"; empty if all robots are of one type, or if arrivals are not measured.
std::string arrivals_line(const std::string& arrived, std::span<const ScenarioFacts> scenarios,
                          std::span<const TrialRecord> trials);

}  // namespace dmrp::host
