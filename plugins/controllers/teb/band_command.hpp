// SPDX-License-Identifier: MIT
// band_command.hpp: from a band to the command of one control period, and to a trajectory of equal steps.
#ifndef DMRP_CONTROLLERS_TEB_BAND_COMMAND_HPP
#define DMRP_CONTROLLERS_TEB_BAND_COMMAND_HPP

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "controllers/motion/unicycle.hpp"
#include "controllers/teb/timed_elastic_band.hpp"

namespace dmrp::controllers::teb {

// The mean velocity from the first pose to the one `poses` on, within what the robot can do and can reach by then.
inline Command first_command(const TimedElasticBand& band, std::size_t poses, const Observation& now) {
  const std::size_t last = std::min(poses, band.size() - 1);
  double duration_s = 0.0;
  for (std::size_t i = 0; i < last; ++i) duration_s += band.dt[i];
  const Vec2 way = band.position(last) - band.position(0);
  const double distance_m = toolkit::norm(way);
  const double ahead = toolkit::dot(way, toolkit::from_angle(band.theta[0]));
  const double v = std::copysign(distance_m, ahead) / duration_s;
  const double omega = toolkit::difference(band.theta[0], band.theta[last]) / duration_s;

  const Limits& limits = now.limits;
  const double period_s = seconds(now.dt_ns);
  Command command;
  command.v_x = toward(now.velocity.v_x, std::clamp(v, limits.v_min, limits.v_max), limits.a_max * period_s);
  command.omega =
      toward(now.velocity.omega, std::clamp(omega, -limits.omega_max, limits.omega_max), limits.alpha_max * period_s);
  command.v_x = std::clamp(command.v_x, limits.v_min, limits.v_max);
  command.omega = std::clamp(command.omega, -limits.omega_max, limits.omega_max);
  return command;
}

// Where the band is at a time: between two poses by shares. The last pose from then on.
inline Pose pose_at(const TimedElasticBand& band, double time_s) {
  for (std::size_t i = 0; i < band.dt.size(); ++i) {
    if (time_s < band.dt[i]) {
      const double share = time_s / band.dt[i];
      const Vec2 at = toolkit::lerp(band.position(i), band.position(i + 1), share);
      return {at.x, at.y, toolkit::wrap(band.theta[i] + share * toolkit::difference(band.theta[i], band.theta[i + 1]))};
    }
    time_s -= band.dt[i];
  }
  return band.pose(band.size() - 1);
}

}  // namespace dmrp::controllers::teb

#endif
