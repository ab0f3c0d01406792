// SPDX-License-Identifier: MIT
#include "controllers/e3mop/velocity_profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmrp::controllers::e3mop {

namespace {

constexpr double never_s = std::numeric_limits<double>::infinity();

// The acceleration limit at a speed, reduced by alpha_max; `side` is 1 for accelerating, -1 for braking.
double acceleration(const Limits& limits, double curvature, double curvature_change, double speed, double side) {
  const double bend = std::abs(curvature);
  if (bend < 1e-6) return limits.a_max;
  const double sign = curvature < 0.0 ? -side : side;
  const double left = (limits.alpha_max - sign * curvature_change * speed * speed) / bend;
  return std::clamp(left, 0.0, limits.a_max);
}

double change_of_curvature(const std::vector<PathPoint>& path, std::size_t i) {
  const double step_m = path[i + 1].arc_m - path[i].arc_m;
  return (path[i + 1].curvature - path[i].curvature) / std::max(step_m, 1e-9);
}

}  // namespace

void plan_speeds(std::vector<PathPoint>& path, double start_speed, double end_speed, const Limits& limits) {
  const std::size_t count = path.size();
  // the maximum-velocity curve
  for (std::size_t i = 0; i < count; ++i) {
    double fastest = std::min(limits.v_max, limits.omega_max / std::max(std::abs(path[i].curvature), 1e-9));
    if (i > 0)
      fastest =
          std::min(fastest, std::sqrt(limits.alpha_max / std::max(std::abs(change_of_curvature(path, i - 1)), 1e-9)));
    if (i + 1 < count)
      fastest = std::min(fastest, std::sqrt(limits.alpha_max / std::max(std::abs(change_of_curvature(path, i)), 1e-9)));
    path[i].speed = fastest;
  }
  path.front().speed = start_speed;
  path.back().speed = std::min(path.back().speed, end_speed);
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double step_m = path[i + 1].arc_m - path[i].arc_m;
    const double v = path[i].speed;
    const double a = acceleration(limits, path[i].curvature, change_of_curvature(path, i), v, 1.0);
    path[i + 1].speed = std::min(path[i + 1].speed, std::sqrt(v * v + 2.0 * a * step_m));
  }
  for (std::size_t i = count - 1; i-- > 1;) {
    const double step_m = path[i + 1].arc_m - path[i].arc_m;
    const double v = path[i + 1].speed;
    const double a = acceleration(limits, path[i + 1].curvature, change_of_curvature(path, i), v, -1.0);
    path[i].speed = std::min(path[i].speed, std::sqrt(v * v + 2.0 * a * step_m));
  }
  path.front().time_s = 0.0;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double sum = path[i].speed + path[i + 1].speed;
    path[i + 1].time_s = sum > 1e-9 ? path[i].time_s + 2.0 * (path[i + 1].arc_m - path[i].arc_m) / sum : never_s;
  }
}

double speed_after(const std::vector<PathPoint>& path, double ahead_s) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (path[i + 1].time_s < ahead_s) continue;
    const double span_s = path[i + 1].time_s - path[i].time_s;
    const double share = span_s > 1e-9 && std::isfinite(span_s) ? (ahead_s - path[i].time_s) / span_s : 0.0;
    return path[i].speed + std::clamp(share, 0.0, 1.0) * (path[i + 1].speed - path[i].speed);
  }
  return path.back().speed;
}

}  // namespace dmrp::controllers::e3mop
