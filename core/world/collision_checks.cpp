// SPDX-License-Identifier: MIT
#include "core/world/collision_checks.hpp"

#include <algorithm>
#include <cassert>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/shape_distance.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "core/world/collision_shapes.hpp"

namespace dmrp::core {
namespace {

using Parts = std::vector<ConvexPart>;

void place_disc(ConvexPart& part, dmrp_vec2 center, double radius_m) {
  const dmrp_vec2 reach = {radius_m, radius_m};
  part.position = center;
  part.radius_m = radius_m;
  part.bounds = {center - reach, center + reach};
}

// The parts of a body keep their prisms.
void place_body(Parts& parts, const SolidBody& body, const SolidOutline& outline) {
  const bool is_new = parts.empty();
  parts.resize(std::max<std::size_t>(1, outline.parts.size()));
  if (outline.parts.empty()) return place_disc(parts[0], body.position, body.radius_m);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    ConvexPart& part = parts[k];
    part.position = body.position;
    part.theta = outline.theta;
    part.polygon = toolkit::to_world({body.position.x, body.position.y, outline.theta}, outline.parts[k]);
    part.bounds = toolkit::bounds(part.polygon);
    if (is_new) part.prism = make_prism(outline.parts[k]);
  }
}

ConvexPart part_of(const dmrp_shape& shape) {
  ConvexPart part;
  if (shape.kind == DMRP_SHAPE_CIRCLE)
    place_disc(part, shape.center, shape.radius_m);
  else
    part.polygon.assign(shape.vertices, shape.vertices + shape.vertex_count);
  part.bounds = toolkit::bounds(shape);
  return part;
}

void take_deeper(const std::optional<PartOverlap>& found, Overlap& deepest) {
  if (found && found->depth_m > deepest.depth_m)
    deepest = {deepest.a, deepest.b, found->depth_m, found->point, found->normal};
}

void take_deepest(const Parts& a, const Parts& b, Overlap& deepest) {
  for (const ConvexPart& one : a)
    for (const ConvexPart& other : b)
      if (toolkit::touch(one.bounds, other.bounds)) take_deeper(overlap(one, other), deepest);
}

}  // namespace

CollisionChecks::CollisionChecks(std::shared_ptr<const StaticGeometry> geometry) : geometry_(std::move(geometry)) {
  for (const dmrp_shape& shape : geometry_->sdk_shapes()) shapes_.push_back({part_of(shape)});
}

CollisionChecks::~CollisionChecks() = default;

const CollisionChecks::Parts& CollisionChecks::shape(std::uint32_t index) {
  ConvexPart& part = shapes_[index][0];
  if (!part.is_disc() && !part.prism) part.prism = make_prism(part.polygon);
  return shapes_[index];
}

void CollisionChecks::place(std::span<const SolidBody> bodies, std::span<const SolidOutline> outlines) {
  bodies_.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    place_body(bodies_[i], bodies[i], i < outlines.size() ? outlines[i] : SolidOutline{});
}

void CollisionChecks::with_shapes(IndexPairs pairs, std::uint32_t count, double depth_m, std::vector<Overlap>& found) {
  found.clear();
  const auto add = [&](const Overlap& deepest) {
    if (deepest.depth_m > depth_m) found.push_back(deepest);
  };
  auto pair = pairs.begin();
  for (std::uint32_t i = 0; i < count; ++i) {
    for (; pair != pairs.end() && pair->first == i; ++pair) {
      Overlap deepest = {i, pair->second};
      take_deepest(bodies_[i], shape(pair->second), deepest);
      add(deepest);
    }
    Overlap with_border = {i, geometry_->border()};
    for (const ConvexPart& part : bodies_[i]) {
      if (geometry_->inside_world(part.bounds.lower) && geometry_->inside_world(part.bounds.upper)) continue;
      for (const Wall& wall : walls_around(*geometry_, {}))
        take_deeper(overlap_with_half_plane(part, wall.inward, -wall.distance_m), with_border);
    }
    add(with_border);
  }
}

void CollisionChecks::between(IndexPairs pairs, std::uint32_t count, double depth_m, std::vector<Overlap>& found) {
  found.clear();
  for (const auto& [a, b] : pairs) {
    if (a >= count) break;
    Overlap deepest = {a, b};
    take_deepest(bodies_[a], bodies_[b], deepest);
    if (deepest.depth_m > depth_m) found.push_back(deepest);
  }
}

}  // namespace dmrp::core
