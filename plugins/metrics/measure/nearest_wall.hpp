// SPDX-License-Identifier: MIT
// nearest_wall.hpp: the static surface nearest to a moving point.
#pragma once

#include <algorithm>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/rectangle.hpp>
#include <dmrp/toolkit/shape_distance.hpp>
#include <vector>

namespace dmrp::metrics {

// Use one object for each moving body. The result is exact, although most calls examine few shapes: until the body has
// moved by more than `reach` since the last full search, only shapes that were then at most 2 * reach farther away than
// the nearest can be nearest.
class NearestWall {
 public:
  struct Surface {
    double distance_m;  // negative inside a shape and beyond the border
    Vec2 point;         // on the surface
  };

  void begin(const World& world) {
    world_ = world;
    border_ = {world->lower, world->upper};
    searched_ = false;
  }

  Surface find(Vec2 point) {
    if (!searched_ || toolkit::squared_distance(point, searched_from_) > reach_m * reach_m) search_all(point);
    Surface nearest = border_surface(point);
    for (const std::size_t index : candidates_) {
      const Surface surface = shape_surface(world_.shapes()[index], point);
      if (surface.distance_m < nearest.distance_m) nearest = surface;
    }
    return nearest;
  }

 private:
  static constexpr double reach_m = 0.5;

  // The border is always examined, so it is not a candidate.
  void search_all(Vec2 point) {
    searched_ = true;
    searched_from_ = point;
    candidates_.clear();
    distances_m_.clear();
    double nearest_m = border_surface(point).distance_m;
    for (const Shape& shape : world_.shapes()) {
      // no shape is nearer than its bounding box, whose distance is 0 inside
      const double to_box_m = toolkit::distance(toolkit::bounds(shape), point);
      const double to_shape_m =
          to_box_m > nearest_m + 2.0 * reach_m ? to_box_m : shape_surface(shape, point).distance_m;
      distances_m_.push_back(to_shape_m);
      nearest_m = std::min(nearest_m, to_shape_m);
    }
    for (std::size_t index = 0; index < distances_m_.size(); ++index)
      if (distances_m_[index] <= nearest_m + 2.0 * reach_m) candidates_.push_back(index);
  }

  Surface border_surface(Vec2 point) const {
    const Vec2 lower = point - border_.lower;
    const Vec2 upper = border_.upper - point;
    Surface nearest = {lower.x, {border_.lower.x, point.y}};
    if (upper.x < nearest.distance_m) nearest = {upper.x, {border_.upper.x, point.y}};
    if (lower.y < nearest.distance_m) nearest = {lower.y, {point.x, border_.lower.y}};
    if (upper.y < nearest.distance_m) nearest = {upper.y, {point.x, border_.upper.y}};
    return nearest;
  }

  static Surface shape_surface(const Shape& shape, Vec2 point) {
    if (shape.kind == DMRP_SHAPE_CIRCLE) {
      const Vec2 outward = toolkit::normalized(point - shape.center);
      return {toolkit::distance(shape.center, point) - shape.radius_m, shape.center + shape.radius_m * outward};
    }
    const toolkit::PolygonView polygon = toolkit::polygon_of(shape);
    const Vec2 on_border = toolkit::closest_border_point(polygon, point);
    const double distance_m = toolkit::distance(on_border, point);
    return {toolkit::contains(polygon, point) ? -distance_m : distance_m, on_border};
  }

  World world_;
  toolkit::Rectangle border_;
  bool searched_ = false;
  Vec2 searched_from_ = {0.0, 0.0};
  std::vector<std::size_t> candidates_;  // indices of shapes
  std::vector<double> distances_m_;
};

}  // namespace dmrp::metrics
