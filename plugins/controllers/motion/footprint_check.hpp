// SPDX-License-Identifier: MIT
// footprint_check.hpp: what a robot's outline costs where it would stand on the costmap.
#ifndef DMRP_CONTROLLERS_MOTION_FOOTPRINT_CHECK_HPP
#define DMRP_CONTROLLERS_MOTION_FOOTPRINT_CHECK_HPP

#include <dmrp/cpp/local_controller.hpp>

#include "controllers/motion/costmap_view.hpp"
#include "controllers/motion/unicycle.hpp"

namespace dmrp::controllers {

inline constexpr int in_collision = -1;

// Of one footprint, grown by a factor and then by a padding. A disc costs what its centre's cell costs; a polygon the
// most of its centre and its outline.
//
// A robot that already stands too near to something (a person stepped up to it) may move as long as it comes no
// nearer: else it would be caught until the other one leaves.
class FootprintCheck {
 public:
  FootprintCheck(const CostmapView& map, const Footprint& footprint, double padding_m, const Pose& now);

  // For the costs that follow. 1 is the footprint itself.
  void scale(double factor);

  // 0 to 252, or in_collision.
  int cost(const ArcState& at) const {
    if (footprint_->vertex_count > 0) return polygon_cost(at);
    const int cost = map_.cost(at.x, at.y);
    return cost <= highest_ ? cost : tolerated(at, cost);
  }

  // The same over the arc of a constant (v, omega): the most of its places, `steps` of them, without the first one.
  int arc_cost(const Pose& from, double v, double omega, double duration_s, int steps) const;

 private:
  int polygon_cost(const ArcState& at) const;
  int tolerated(const ArcState& at, int cost) const;
  bool edge_is_clear(Vec2 from, Vec2 to) const;

  CostmapView map_;
  const Footprint* footprint_;
  double padding_m_;
  double factor_ = 1.0;
  int highest_ = 0;  // cost of the centre
  Vec2 start_;
  bool start_collides_ = false;    // the robot's own place is too near to something ...
  double start_distance_m_ = 0.0;  // ... and this is how near
};

}  // namespace dmrp::controllers

#endif
