// SPDX-License-Identifier: MIT
// The half-planes of velocities that somebody permits themselves on account of walls.
//
// Van den Berg, Guy, Lin, Manocha: Reciprocal n-body collision avoidance, ISRR 2009 (Springer 2011), section 5.4, on
// outlines rather than lone segments: a wall's velocity obstacle ends where that of the wall beside it begins, so that
// nobody is sent past a wall's end into the next one.
#pragma once

#include <dmrp/values.h>

#include <cstddef>
#include <cstdint>
#include <dmrp/cpp/span.hpp>
#include <vector>

#include "pedestrians/crowd/wall_grid.hpp"
#include "pedestrians/orca/half_plane.hpp"

namespace dmrp::pedestrians {

class WallObstacles {
 public:
  // Segments are closed outlines, one after the other: counter-clockwise ones of bodies, and the world's border.
  void start(Span<dmrp_segment> segments, dmrp_vec2 lower, dmrp_vec2 upper, double reach_m);

  // Appends the half-planes of all walls that a disc at `position` can come to touch within `horizon_s`, nearest wall
  // first. The zero velocity is in all of them.
  void append_half_planes(dmrp_vec2 position, dmrp_vec2 velocity, double radius_m, double max_speed, double horizon_s,
                          std::vector<HalfPlane>& planes);

 private:
  // A wall with the free side to its right: seen from there, `from` is its left end.
  struct Wall {
    dmrp_vec2 from;
    dmrp_vec2 to;
    dmrp_vec2 direction;       // unit vector; zero for a wall without length
    dmrp_vec2 left_direction;  // of the walls that it shares its ends with
    dmrp_vec2 right_direction;
    bool left_sticks_out;  // whether at least half of the ground about this end is free: no corner to walk into
    bool right_sticks_out;
  };

  struct Near {
    double squared_distance;
    std::uint32_t wall;
  };

  // What somebody sees of a wall, from their own position; they are not in touch with it.
  struct View {
    dmrp_vec2 left;  // ends, m; both the same where the wall is seen end-on
    dmrp_vec2 right;
    dmrp_vec2 left_leg;  // unit vectors along the sides of the velocity obstacle
    dmrp_vec2 right_leg;
    bool left_leg_is_covered;  // by the velocity obstacle of the wall that shares this end
    bool right_leg_is_covered;
    bool end_on;
  };

  void link_outline(std::size_t begin, std::size_t end);
  void find_near(dmrp_vec2 position, double range_m);
  static bool is_touching(const Wall& wall, dmrp_vec2 position, double radius_m, dmrp_vec2& nearest, bool& is_owned);
  static bool view_of(const Wall& wall, dmrp_vec2 position, double radius_m, View& view);
  static bool border_nearest(const Wall& wall, const View& view, dmrp_vec2 velocity, double radius_m, double horizon_s,
                             HalfPlane& plane);

  WallGrid grid_;
  std::vector<Wall> walls_;  // by segment
  std::vector<Near> near_;
};

}  // namespace dmrp::pedestrians
