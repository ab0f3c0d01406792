// SPDX-License-Identifier: MIT
// sensor_noise.hpp: what keeps a robot's sensors from being exact.
//
// Every robot has streams of random numbers of its own, one for each kind of noise, named by the trial's seed, the
// robot and the time: what is disturbed how depends neither on who asks how often, nor on whether other noise is on.
#pragma once

#include <dmrp/observation.h>

#include <cstdint>
#include <span>

#include "core/scene/settings.hpp"

namespace dmrp::core {

// Of one reading of one robot's sensors.
struct Reading {
  std::uint64_t seed = 0;  // of the trial
  std::uint32_t robot = 0;
  std::int64_t t_ns = 0;
};

// Normal noise on the ranges of hits, which stay hits within the lidar's range; then single beams drop out: they read
// as if nothing had been hit.
void disturb_scan(const LidarSettings& settings, const Reading& reading, std::span<float> ranges);

// Normal noise on either component of the agents' velocities. An agent's noise does not depend on the other agents.
void disturb_agents(double velocity_noise_sd, const Reading& reading, std::span<dmrp_agent> agents);

}  // namespace dmrp::core
