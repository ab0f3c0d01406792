// SPDX-License-Identifier: MIT
// band_command.hpp: the command of one control period from a band, and the band's pose at a given time.
#pragma once

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "controllers/motion/drive_ability.hpp"
#include "controllers/teb/timed_elastic_band.hpp"

namespace dmrp::controllers::teb {

// The mean velocity from the first pose to pose `poses`, bounded by the limits and by what the robot can reach within
// one control period.
inline Command first_command(const TimedElasticBand& band, std::size_t poses, const Observation& now) {
  const std::size_t last = std::min(poses, band.size() - 1);
  double duration_s = 0.0;
  for (std::size_t i = 0; i < last; ++i) duration_s += band.dt[i];
  const Vec2 chord = band.position(last) - band.position(0);
  const double distance_m = toolkit::norm(chord);
  const double ahead = toolkit::dot(chord, toolkit::from_angle(band.theta[0]));
  const double v = std::copysign(distance_m, ahead) / duration_s;
  const double omega = toolkit::difference(band.theta[0], band.theta[last]) / duration_s;

  const Limits& limits = now.limits;
  const double period_s = seconds(now.dt_ns);
  if (is_car_like(limits)) {
    const double reached = toward(now.velocity.v_x, std::clamp(v, limits.v_min, limits.v_max), limits.a_max * period_s);
    return steered(std::clamp(reached, limits.v_min, limits.v_max), v == 0.0 ? 0.0 : omega / v, limits);
  }
  Command command;
  if (is_holonomic(limits)) {
    const Vec2 wanted = toolkit::rotate(chord, -band.theta[0]) / duration_s;
    const Vec2 bounded = {std::clamp(wanted.x, limits.v_min, limits.v_max),
                          std::clamp(wanted.y, -limits.v_y_max, limits.v_y_max)};
    const Vec2 reached = toward(Vec2{now.velocity.v_x, now.velocity.v_y}, bounded, limits.a_max * period_s);
    command.v_x = std::clamp(reached.x, limits.v_min, limits.v_max);
    command.v_y = std::clamp(reached.y, -limits.v_y_max, limits.v_y_max);
  } else {
    command.v_x = toward(now.velocity.v_x, std::clamp(v, limits.v_min, limits.v_max), limits.a_max * period_s);
    command.v_x = std::clamp(command.v_x, limits.v_min, limits.v_max);
  }
  command.omega =
      toward(now.velocity.omega, std::clamp(omega, -limits.omega_max, limits.omega_max), limits.alpha_max * period_s);
  command.omega = std::clamp(command.omega, -limits.omega_max, limits.omega_max);
  return command;
}

// The pose at a time, interpolated linearly between two poses; the last pose after the end.
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
