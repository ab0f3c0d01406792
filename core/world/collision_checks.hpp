// SPDX-License-Identifier: MIT
// collision_checks.hpp: which bodies overlap, and how deep. FCL decides; how its queries are used is told in
// core/world/collision_shapes.hpp.
#pragma once

#include <dmrp/values.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/scene/static_geometry.hpp"
#include "core/world/solid_motion.hpp"

namespace dmrp::core {

// Two bodies, or a body and a shape, that overlap.
struct Overlap {
  std::uint32_t a = 0;  // body
  std::uint32_t b = 0;  // body, shape, or StaticGeometry::border()
  double depth_m = 0.0;
  dmrp_vec2 point{};   // in the middle of the overlap
  dmrp_vec2 normal{};  // unit, from b toward a
};

struct ConvexPart;

class CollisionChecks {
 public:
  explicit CollisionChecks(std::shared_ptr<const StaticGeometry> geometry);
  ~CollisionChecks();

  // Says where the bodies are. `outlines` are those of the first bodies; their parts must be the same at each call.
  void place(std::span<const SolidBody> bodies, std::span<const SolidOutline> outlines);

  // Find overlaps deeper than `depth_m` of the first `count` bodies with shapes and the border, and with other bodies,
  // ordered by a, then b; overwrite `found`. The pairs (body, shape; body, later body) contain all that can overlap, in
  // ascending order.
  void with_shapes(IndexPairs pairs, std::uint32_t count, double depth_m, std::vector<Overlap>& found);
  void between(IndexPairs pairs, std::uint32_t count, double depth_m, std::vector<Overlap>& found);

 private:
  using Parts = std::vector<ConvexPart>;

  const Parts& shape(std::uint32_t index);

  std::shared_ptr<const StaticGeometry> geometry_;
  std::vector<Parts> shapes_;  // one part each; prisms are made when a body comes close
  std::vector<Parts> bodies_;
};

}  // namespace dmrp::core
