// SPDX-License-Identifier: MIT
// sampled_clearance.hpp: clearances by a check of every shape, as a reference for the broad phase.
#pragma once

#include <algorithm>
#include <dmrp/toolkit/shape_distance.hpp>

#include "core/scene/static_geometry.hpp"

namespace dmrp::core::test {

inline double clearance_by_looking(const StaticGeometry& geometry, dmrp_vec2 point) {
  double least = std::max(0.0, toolkit::depth(geometry.rectangle(), point));
  for (const dmrp_shape& shape : geometry.sdk_shapes()) least = std::min(least, toolkit::distance(shape, point));
  return least;
}

// The least clearance along a line, at samples.
inline double clearance_along(const StaticGeometry& geometry, dmrp_vec2 from, dmrp_vec2 to) {
  double least = clearance_by_looking(geometry, from);
  const int samples = 200;
  for (int i = 1; i <= samples; ++i)
    least = std::min(least, clearance_by_looking(geometry, toolkit::lerp(from, to, i / double{samples})));
  return least;
}

}  // namespace dmrp::core::test
