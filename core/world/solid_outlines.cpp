// SPDX-License-Identifier: MIT
#include "core/world/solid_outlines.hpp"

#include <algorithm>
#include <cassert>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/shape_distance.hpp>
#include <utility>

#include "core/scene/convex_separation.hpp"
#include "core/world/solid_motion.hpp"

namespace dmrp::core {

void SolidOutlines::place(std::span<const SolidBody> bodies, std::span<const SolidOutline> outlines) {
  assert(outlines.size() <= bodies.size());
  placed_.resize(outlines.size());
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    const SolidOutline& outline = outlines[i];
    const dmrp_vec2 at = bodies[i].position;
    placed_[i].resize(outline.parts.size());
    for (std::size_t k = 0; k < outline.parts.size(); ++k) {
      placed_[i][k].now = toolkit::to_world({at.x, at.y, outline.theta}, outline.parts[k]);
      placed_[i][k].turned = outline.turn_rad == 0.0
                                 ? placed_[i][k].now
                                 : toolkit::to_world({at.x, at.y, outline.theta + outline.turn_rad}, outline.parts[k]);
    }
  }
}

double SolidOutlines::growth(const Part& part, dmrp_vec2 position, dmrp_vec2 direction) {
  return extent(part.turned, position, direction) - extent(part.now, position, direction);
}

std::span<const Gap> SolidOutlines::to_shape(std::span<const SolidBody> bodies, std::uint32_t a,
                                             const dmrp_shape& shape) {
  assert(!is_disc(a));
  gaps_.clear();
  const bool is_circle = shape.kind == DMRP_SHAPE_CIRCLE;
  for (const Part& part : placed_[a]) {
    const Separation apart = is_circle ? separation(part.now, shape.center, shape.radius_m)
                                       : separation(part.now, toolkit::polygon_of(shape));
    gaps_.push_back({apart.normal, apart.distance_m, growth(part, bodies[a].position, -apart.normal), 0.0});
  }
  return gaps_;
}

std::span<const Gap> SolidOutlines::to_border(std::span<const SolidBody> bodies, std::uint32_t a,
                                              const StaticGeometry& geometry) {
  assert(!is_disc(a));
  gaps_.clear();
  for (const Part& part : placed_[a])
    for (const Wall& wall : walls_around(geometry, bodies[a].position)) {
      const double gap_m = wall.distance_m - extent(part.now, bodies[a].position, -wall.inward);
      gaps_.push_back({wall.inward, gap_m, growth(part, bodies[a].position, -wall.inward), 0.0});
    }
  return gaps_;
}

std::span<const Gap> SolidOutlines::between(std::span<const SolidBody> bodies, std::uint32_t a, std::uint32_t b) {
  assert(a != b && !(is_disc(a) && is_disc(b)));
  gaps_.clear();
  if (is_disc(a)) {
    between(bodies, b, a);
    for (Gap& gap : gaps_) {
      gap.normal = -gap.normal;
      std::swap(gap.a_growth_m, gap.b_growth_m);
    }
    return gaps_;
  }
  const SolidBody& other = bodies[b];
  for (const Part& part : placed_[a]) {
    const auto a_growth_m = [&](dmrp_vec2 normal) { return growth(part, bodies[a].position, -normal); };
    if (is_disc(b)) {
      const Separation apart = separation(part.now, other.position, other.radius_m);
      gaps_.push_back({apart.normal, apart.distance_m, a_growth_m(apart.normal), 0.0});
      continue;
    }
    for (const Part& other_part : placed_[b]) {
      const Separation apart = separation(part.now, other_part.now);
      gaps_.push_back(
          {apart.normal, apart.distance_m, a_growth_m(apart.normal), growth(other_part, other.position, apart.normal)});
    }
  }
  return gaps_;
}

}  // namespace dmrp::core
