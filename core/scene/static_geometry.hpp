// SPDX-License-Identifier: MIT
// static_geometry.hpp: the static bodies: the shapes of a scenario and the border of its rectangle. Exact distances.
#pragma once

#include <dmrp/world.h>

#include <cstdint>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/rectangle.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "core/scene/broad_phase.hpp"
#include "core/scene/scenario.hpp"

namespace dmrp::core {

// The signed distance of a point from the surface of a body, and the direction out of the body.
struct SurfaceDistance {
  double distance_m = 0.0;  // negative inside
  dmrp_vec2 outward{};      // unit normal of the nearest surface
};

struct NearestShape {
  double clearance_m = 0.0;  // from the point to the nearest shape or the border; 0 inside a shape or outside the world
  std::uint32_t shape = 0;   // shapes().size() means the border
};

// Views of the shapes, which point into `shapes`.
std::vector<dmrp_shape> sdk_shapes_of(const std::vector<Shape>& shapes);

// Immutable, so all trials of a scenario share one. Broad phase: FCL's dynamic AABB tree.
class StaticGeometry {
 public:
  explicit StaticGeometry(const Scenario& scenario);

  // From a stored world: equal to that of its scenario, to the bit. Throws std::invalid_argument for a shape that is
  // neither a circle nor a polygon.
  explicit StaticGeometry(const dmrp_world& world);
  StaticGeometry(const StaticGeometry&) = delete;
  StaticGeometry& operator=(const StaticGeometry&) = delete;

  dmrp_vec2 lower() const { return lower_; }
  dmrp_vec2 upper() const { return upper_; }
  toolkit::Rectangle rectangle() const { return {lower_, upper_}; }
  const std::vector<Shape>& shapes() const { return shapes_; }
  std::span<const dmrp_shape> sdk_shapes() const { return sdk_shapes_; }
  std::uint32_t border() const { return static_cast<std::uint32_t>(shapes_.size()); }  // the border's index
  std::string_view shape_name(std::uint32_t shape) const;                              // "the border" for border()

  // Whether the border is the edge of a map that may go on beyond it, and whether the shape is that edge.
  bool has_open_edge() const { return has_open_edge_; }
  bool is_open_edge(std::uint32_t shape) const;

  // Outlines of all shapes and of the border, as walls for people; circles as polygons around them.
  std::span<const dmrp_segment> segments() const { return segments_; }

  NearestShape nearest(dmrp_vec2 point) const;
  double clearance(dmrp_vec2 point) const { return nearest(point).clearance_m; }
  bool inside_world(dmrp_vec2 point) const;

  // Whether a disc is clear of all shapes and of the border; touching is allowed.
  bool disc_is_free(dmrp_vec2 center, double radius_m) const;

  // Whether a disc stays clear along a straight line, exactly (no sampling).
  bool sweep_is_free(dmrp_vec2 from, dmrp_vec2 to, double radius_m) const;

  // The distance from a convex polygon to the nearest shape or the border, at most `at_most_m`; negative if it overlaps.
  double clearance(toolkit::PolygonView polygon, double at_most_m) const;

  // Whether no shape lies between the two points.
  bool line_of_sight(dmrp_vec2 a, dmrp_vec2 b) const;

  // Indices of the shapes whose bounding boxes touch `box`, ascending. Overwrites `found`.
  void shapes_near(const toolkit::Rectangle& box, std::vector<std::uint32_t>& found) const;

  // The distance to the surface of one shape. Not for the border.
  SurfaceDistance distance_to(std::uint32_t shape, dmrp_vec2 point) const;

 private:
  StaticGeometry(const toolkit::Rectangle& rectangle, std::vector<Shape> shapes);

  dmrp_vec2 lower_;
  dmrp_vec2 upper_;
  std::vector<Shape> shapes_;
  std::vector<dmrp_shape> sdk_shapes_;  // point into shapes_
  std::vector<dmrp_segment> segments_;
  BoxTree tree_;
  bool has_open_edge_ = false;
};

}  // namespace dmrp::core
