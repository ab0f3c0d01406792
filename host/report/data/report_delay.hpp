// SPDX-License-Identifier: MIT
// report_delay.hpp: the delay of pedestrians by robots, from pairs of trials with and without robots.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/statistics/bootstrap.hpp"
#include "host/report/data/report_frame.hpp"
#include "host/report/data/report_layout.hpp"

namespace dmrp::host {

// Both trials of a pair have the same scenario, pedestrian model and seed, hence the same people. Let P(t) be the mean
// progress of a person towards its goals by time t, P0(t) the progress without robots, v the mean desired speed and T
// the last second that both trials have (the end of the mission if people are still present without robots). Then
//   delay = (P0(T) - P(T)) / v
// is the time that a person needs to walk the lost distance. It is negative if people progress faster with robots.
struct PedestrianDelay {
  std::size_t combination;  // with robots
  std::uint32_t pairs;
  double mean_s;
  core::Interval interval;  // 95 %, over seeds
};

// For each combination with robots that has a counterpart without robots; empty if the metrics were not measured.
std::vector<PedestrianDelay> pedestrian_delays(const ReportFrame& frame, const PedestrianDelayMetrics& metrics);

}  // namespace dmrp::host
