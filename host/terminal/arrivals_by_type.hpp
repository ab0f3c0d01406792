// SPDX-License-Identifier: MIT
// arrivals_by_type.hpp: how many robots of each type arrived, where an experiment has several types.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "host/results/summary_layout.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

// The type of each robot, by scenario and number of robots; "" is the default type.
using TypesOfRobots = std::map<std::pair<std::string, std::uint32_t>, std::vector<std::string>>;

// "default 20 of 20 · transporter 19 of 20", in the order in which the types first occur; empty if all robots are of one
// type, or if arrivals are not measured.
std::string arrivals_by_type(const SummaryLayout& layout, const TypesOfRobots& types,
                             std::span<const TrialRecord> trials);

}  // namespace dmrp::host
