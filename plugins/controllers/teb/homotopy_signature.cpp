// SPDX-License-Identifier: MIT
#include "controllers/teb/homotopy_signature.hpp"

#include <algorithm>

namespace dmrp::controllers::teb {

namespace {

// The ray of standing marks. Not parallel to an axis, because walls and the paths along them often are.
constexpr Vec2 standing_ray = {0.6, 0.8};

// The distance of a disc's marks from its centre, in radii: a band through the rim counts as passing on that side, to
// which the optimisation pushes it.
constexpr double disc_mark = 0.5;

Signature times(int crossings, std::size_t mark) {
  return static_cast<Signature>(static_cast<std::int64_t>(crossings)) * signature_weight(mark);
}

}  // namespace

void set_marks(const std::vector<Obstacle>& obstacles, Vec2 along, std::vector<Mark>& marks) {
  marks.clear();
  for (std::uint32_t k = 0; k < obstacles.size(); ++k) {
    const Obstacle& obstacle = obstacles[k];
    const auto is_right_of = [along](Vec2 a, Vec2 b) { return toolkit::cross(along, a) < toolkit::cross(along, b); };
    const Vec2* const end = obstacle.vertices + obstacle.vertex_count;
    const auto [right, left] = std::minmax_element(obstacle.vertices, end, is_right_of);
    const Vec2 aside = disc_mark * obstacle.radius_m * toolkit::perpendicular(toolkit::normalized(along));
    marks.push_back({*left + aside, obstacle.velocity, k});
    if (left != right || obstacle.radius_m > 0.0) marks.push_back({*right - aside, obstacle.velocity, k});
  }
}

Signature step_signature(Vec2 from, Vec2 to, const std::vector<Vec2>& marks) {
  Signature signature = 0;
  for (std::size_t k = 0; k < marks.size(); ++k) {
    const int crossing = ray_crossing(from - marks[k], to - marks[k], standing_ray);
    if (crossing != 0) signature += times(crossing, k);
  }
  return signature;
}

Signature band_signature(const TimedElasticBand& band, const std::vector<Mark>& marks) {
  Signature signature = 0;
  for (std::size_t k = 0; k < marks.size(); ++k) {
    const Mark& mark = marks[k];
    const bool moves = mark.velocity != Vec2{0.0, 0.0};
    const Vec2 ray = moves ? mark.velocity : standing_ray;
    int crossings = 0;
    double time_s = 0.0;
    Vec2 from = band.position(0) - mark.at;
    for (std::size_t i = 1; i < band.size(); ++i) {
      time_s += band.dt[i - 1];
      const Vec2 to = band.position(i) - mark.at - time_s * mark.velocity;
      crossings += ray_crossing(from, to, ray);
      from = to;
    }
    if (crossings != 0) signature += times(crossings, k);
  }
  return signature;
}

}  // namespace dmrp::controllers::teb
