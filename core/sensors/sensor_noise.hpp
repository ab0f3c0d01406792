// SPDX-License-Identifier: MIT
// sensor_noise.hpp: noise of the robots' sensors.
//
// Each kind of noise of each robot has its own random stream, named by the trial's seed, the robot and the time. The
// noise of a reading therefore depends neither on the number of calls nor on other noise settings.
#pragma once

#include <dmrp/observation.h>

#include <cstdint>
#include <span>

#include "core/scene/settings.hpp"

namespace dmrp::core {

// Identifies one reading of one robot's sensors.
struct Reading {
  std::uint64_t seed = 0;  // of the trial
  std::uint32_t robot = 0;
  std::int64_t t_ns = 0;
};

// Adds normal noise to the ranges of hits, clamped to the lidar's range; then single beams drop out and report no hit.
void disturb_scan(const LidarSettings& settings, const Reading& reading, std::span<float> ranges);

// Adds normal noise to both components of the agents' velocities. An agent's noise does not depend on other agents.
void disturb_agents(double velocity_noise_sd, const Reading& reading, std::span<dmrp_agent> agents);

}  // namespace dmrp::core
