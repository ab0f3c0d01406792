// SPDX-License-Identifier: MIT
#include "homotopy_signature.hpp"

namespace dmrp::controllers::teb {

namespace {

// Of everything that stands. Along no axis: walls often are, and ways along them.
constexpr Vec2 standing_ray = {0.6, 0.8};

Signature times(int crossings, std::size_t obstacle) {
  return static_cast<Signature>(static_cast<std::int64_t>(crossings)) * signature_weight(obstacle);
}

}  // namespace

Signature step_signature(Vec2 from, Vec2 to, const std::vector<Vec2>& places) {
  Signature signature = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const int crossing = ray_crossing(from - places[k], to - places[k], standing_ray);
    if (crossing != 0) signature += times(crossing, k);
  }
  return signature;
}

Signature band_signature(const TimedElasticBand& band, const std::vector<Obstacle>& obstacles) {
  Signature signature = 0;
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    const Obstacle& obstacle = obstacles[k];
    const bool moves = obstacle.velocity != Vec2{0.0, 0.0};
    const Vec2 ray = moves ? obstacle.velocity : standing_ray;
    int crossings = 0;
    double time_s = 0.0;
    Vec2 from = band.position(0) - obstacle.center;
    for (std::size_t i = 1; i < band.size(); ++i) {
      time_s += band.dt[i - 1];
      const Vec2 to = band.position(i) - obstacle.center - time_s * obstacle.velocity;
      crossings += ray_crossing(from, to, ray);
      from = to;
    }
    if (crossings != 0) signature += times(crossings, k);
  }
  return signature;
}

}  // namespace dmrp::controllers::teb
