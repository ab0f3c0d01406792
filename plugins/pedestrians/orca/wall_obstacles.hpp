// SPDX-License-Identifier: MIT
// The half-planes of velocities that walls permit.
//
// Van den Berg, Guy, Lin, Manocha: Reciprocal n-body collision avoidance, ISRR 2009 (Springer 2011), section 5.4,
// applied to outlines instead of single segments: a wall's velocity obstacle ends where that of the adjacent wall
// begins, so that no half-plane leads a person past the end of one wall into the next.
#pragma once

#include <cstddef>
#include <cstdint>
#include <dmrp/cpp/plugin_base.hpp>
#include <vector>

#include "pedestrians/crowd/wall_grid.hpp"
#include "reciprocal/half_plane.hpp"

namespace dmrp::pedestrians {

using reciprocal::half_plane;
using reciprocal::HalfPlane;

class WallObstacles {
 public:
  // The segments must form closed outlines, one after the other: those of shapes, counter-clockwise, and the border of
  // the world.
  void start(Span<Segment> segments, Vec2 lower, Vec2 upper, double reach_m);

  // Appends the half-planes of all walls that a disc at `position` can reach within `horizon_s`, nearest wall first.
  // All of them contain the zero velocity.
  void append_half_planes(Vec2 position, Vec2 velocity, double radius_m, double max_speed, double horizon_s,
                          std::vector<HalfPlane>& planes);

 private:
  // A wall whose free side is to its right: from there, `from` is the left end.
  struct Wall {
    Vec2 from;
    Vec2 to;
    Vec2 direction;       // unit vector; zero for a wall without length
    Vec2 left_direction;  // of the adjacent walls
    Vec2 right_direction;
    bool left_sticks_out;  // this end is a convex corner: at least half of the ground around it is free
    bool right_sticks_out;
  };

  struct Near {
    double squared_distance;
    std::uint32_t wall;
  };

  // A wall relative to a person who does not touch it.
  struct View {
    Vec2 left;  // ends, m; equal where only one end counts
    Vec2 right;
    Vec2 left_leg;  // unit vectors along the legs of the velocity obstacle
    Vec2 right_leg;
    bool left_leg_is_covered;  // by the velocity obstacle of the adjacent wall
    bool right_leg_is_covered;
    bool end_on;
  };

  void link_outline(std::size_t begin, std::size_t end);
  void find_near(Vec2 position, double range_m);
  static bool is_touching(const Wall& wall, Vec2 position, double radius_m, Vec2& nearest, bool& is_owned);
  static bool view_of(const Wall& wall, Vec2 position, double radius_m, View& view);
  static bool border_nearest(const Wall& wall, const View& view, Vec2 velocity, double radius_m, double horizon_s,
                             HalfPlane& plane);

  WallGrid grid_;
  std::vector<Wall> walls_;  // by segment
  std::vector<Near> near_;
};

}  // namespace dmrp::pedestrians
