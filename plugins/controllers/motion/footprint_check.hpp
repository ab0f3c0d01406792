// SPDX-License-Identifier: MIT
// footprint_check.hpp: the cost of a robot's footprint at a pose on the costmap.
#pragma once

#include <dmrp/cpp/local_controller.hpp>

#include "controllers/motion/costmap_view.hpp"
#include "controllers/motion/unicycle.hpp"

namespace dmrp::controllers {

inline constexpr int in_collision = -1;

// Checks one footprint, scaled by a factor and then enlarged by a padding. A disc costs as much as the cell of its
// centre; polygons cost the maximum of their centre and their outlines.
//
// A robot that already stands too close to an obstacle (a person stepped up to it) may move as long as it comes no
// closer. Otherwise it could not move until the obstacle leaves.
class FootprintCheck {
 public:
  FootprintCheck(const CostmapView& map, const Footprint& footprint, double padding_m, const Pose& now);

  // Sets the scale of all later costs; 1 is the footprint itself.
  void scale(double factor);

  // 0 to 252, or in_collision.
  int cost(const DirectedPoint& robot) const {
    if (footprint_->part_count > 0) return polygon_cost(robot);
    const int cost = map_.cost(robot.at);
    return cost <= highest_ ? cost : tolerated(robot.at, cost);
  }

  // Whether the robot is too close to an obstacle at its pose now, and whether it would be at another one.
  bool starts_too_close() const { return start_collides_; }
  bool is_too_close(const DirectedPoint& robot) const;

  // The maximum cost over the arc of a constant (v, omega), at `steps` poses after the first one; in_collision if one
  // of them is.
  int arc_cost(const Pose& from, double v, double omega, double duration_s, int steps) const;

 private:
  int polygon_cost(const DirectedPoint& robot) const;
  int tolerated(Vec2 center, int cost) const;
  bool outline_is_clear(const Polygon& part, const DirectedPoint& robot) const;
  bool edge_is_clear(Vec2 from, Vec2 to) const;

  CostmapView map_;
  const Footprint* footprint_;
  double padding_m_;
  double factor_ = 1.0;
  int highest_ = 0;  // allowed cost of the centre
  Vec2 start_;
  bool start_collides_ = false;    // the robot already stands too close to an obstacle ...
  double start_distance_m_ = 0.0;  // ... at this distance
};

}  // namespace dmrp::controllers
