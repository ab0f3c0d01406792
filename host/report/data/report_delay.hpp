// SPDX-License-Identifier: MIT
// report_delay.hpp: what the robots cost the people, from pairs of trials with and without robots.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/statistics/bootstrap.hpp"
#include "host/report/data/report_frame.hpp"
#include "host/report/data/report_layout.hpp"

namespace dmrp::host {

// Both trials of a pair have the same scenario, pedestrian model and seed, hence the same people. With P(t) the mean
// distance that a person has gained towards its goals by t, P0(t) the same without robots, v the mean desired speed and
// T the last second that both trials have (the mission's end, as long as people are about without robots):
//   delay = (P0(T) - P(T)) / v,
// the time that a person would need to make up what it has lost. Negative where people got ahead.
struct PedestrianDelay {
  std::size_t combination;  // with robots
  std::uint32_t pairs;
  double mean_s;
  core::Interval interval;  // 95 %, over seeds
};

// Combinations with robots that have a partner without; empty where the metrics were not measured.
std::vector<PedestrianDelay> pedestrian_delays(const ReportFrame& frame, const PedestrianDelayMetrics& metrics);

}  // namespace dmrp::host
