// SPDX-License-Identifier: MIT
// report_delay.hpp: the delay of pedestrians by robots, from pairs of trials with and without robots.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "host/report/data/report_frame.hpp"
#include "host/results/summary_layout.hpp"

namespace dmrp::host {

// As people_delays() has it (host/ranking/measures.hpp): of people who met robots, against the same people without.
struct PedestrianDelay {
  std::size_t combination;  // with robots
  std::uint32_t pairs;
  core::MeanOfTasks over_tasks;  // s
};

// For each combination with robots that has a counterpart without robots; empty if the metrics were not measured.
std::vector<PedestrianDelay> pedestrian_delays(const ReportFrame& frame, const SummaryLayout& layout);

}  // namespace dmrp::host
