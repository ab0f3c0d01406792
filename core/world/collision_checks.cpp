// SPDX-License-Identifier: MIT
#include "core/world/collision_checks.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/shape_distance.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "core/scene/collision_shapes.hpp"

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

struct CollisionChecks::Implementation {
  std::shared_ptr<const StaticGeometry> geometry;
  std::array<Wall, 4> walls;    // as seen from the origin
  std::vector<Parts> shapes{};  // one part each; prisms are made when a body comes close
  std::vector<Parts> bodies{};

  const Parts& shape(std::uint32_t index) {
    ConvexPart& part = shapes[index][0];
    if (!part.is_disc() && !part.prism) part.prism = make_prism(part.polygon);
    return shapes[index];
  }
};

CollisionChecks::CollisionChecks(std::shared_ptr<const StaticGeometry> geometry)
    : implementation_(new Implementation{geometry, walls_around(*geometry, {})}) {
  for (const dmrp_shape& shape : geometry->sdk_shapes()) implementation_->shapes.push_back({part_of(shape)});
}

CollisionChecks::~CollisionChecks() = default;

void CollisionChecks::place(std::span<const SolidBody> bodies, std::span<const SolidOutline> outlines) {
  implementation_->bodies.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    place_body(implementation_->bodies[i], bodies[i], i < outlines.size() ? outlines[i] : SolidOutline{});
}

void CollisionChecks::with_shapes(IndexPairs pairs, std::uint32_t count, double depth_m, std::vector<Overlap>& found) {
  Implementation& my = *implementation_;
  found.clear();
  const auto add = [&](const Overlap& deepest) {
    if (deepest.depth_m > depth_m) found.push_back(deepest);
  };
  auto pair = pairs.begin();
  for (std::uint32_t i = 0; i < count; ++i) {
    for (; pair != pairs.end() && pair->first == i; ++pair) {
      Overlap deepest = {i, pair->second};
      take_deepest(my.bodies[i], my.shape(pair->second), deepest);
      add(deepest);
    }
    Overlap with_border = {i, my.geometry->border()};
    for (const ConvexPart& part : my.bodies[i]) {
      if (toolkit::contains(my.geometry->rectangle(), part.bounds)) continue;
      for (const Wall& wall : my.walls)
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
    take_deepest(implementation_->bodies[a], implementation_->bodies[b], deepest);
    if (deepest.depth_m > depth_m) found.push_back(deepest);
  }
}

}  // namespace dmrp::core
