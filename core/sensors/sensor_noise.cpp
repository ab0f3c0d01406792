// SPDX-License-Identifier: MIT
#include "core/sensors/sensor_noise.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <limits>

namespace dmrp::core {

using toolkit::Stream;

void disturb_scan(const LidarSettings& settings, const Reading& reading, std::span<float> ranges) {
  if (settings.noise_sd_m > 0.0) {
    Stream noise(reading.seed, "lidar.noise", reading.robot, reading.t_ns);
    for (float& range : ranges) {
      const double error_m = noise.normal(0.0, settings.noise_sd_m);  // drawn for every beam, so each keeps its numbers
      if (!std::isfinite(range)) continue;
      range = static_cast<float>(
          std::clamp(static_cast<double>(range) + error_m, settings.range_min_m, settings.range_max_m));
    }
  }
  if (settings.dropout_share > 0.0) {
    Stream dropouts(reading.seed, "lidar.dropout", reading.robot, reading.t_ns);
    for (float& range : ranges)
      if (dropouts.chance(settings.dropout_share)) range = std::numeric_limits<float>::infinity();
  }
}

void disturb_agents(double velocity_noise_sd, const Reading& reading, std::span<dmrp_agent> agents) {
  if (velocity_noise_sd == 0.0) return;
  for (dmrp_agent& agent : agents) {
    Stream noise(reading.seed, "tracking.velocity", reading.robot, reading.t_ns, agent.kind, agent.id);
    agent.velocity.x += noise.normal(0.0, velocity_noise_sd);
    agent.velocity.y += noise.normal(0.0, velocity_noise_sd);
  }
}

}  // namespace dmrp::core
