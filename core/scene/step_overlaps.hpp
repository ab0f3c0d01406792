// SPDX-License-Identifier: MIT
// step_overlaps.hpp: whether the footprints of two robots overlap during a step on the planning grid, although they are
// not in one cell (large agents: Li et al., AAAI 2019).
//
// A plan has places and times, but no headings. So:
// - Between two waypoints a robot moves straight at constant speed, and heads along its move, ahead or back: both are
//   checked. This is exact: what a convex part covers relative to another one is convex.
// - At a waypoint, and while it waits, a robot may have any heading that its cell allows: it covers the circle around
//   its footprint. On a cell where it cannot turn (clearance less than that circle's radius, and all its moves along one
//   axis), it covers its footprint along this axis, heading either way.
// Footprints that overlap by less than a micrometre are apart.
#pragma once

#include <dmrp/grid.h>

#include <cstdint>
#include <dmrp/toolkit/grid_view.hpp>
#include <vector>

#include "core/scene/settings.hpp"

namespace dmrp::core {

class StepOverlaps {
 public:
  struct Robot {
    double radius_m;                   // of the disc, or of the circle around the parts
    std::vector<ConvexPolygon> parts;  // none: a disc
    const dmrp_grid* grid;             // its own
    bool is_active;
  };

  StepOverlaps(double cell_m, const std::vector<Robot>& robots);

  // Whether two robots can overlap that share no cell. If not, there is nothing to ask.
  bool are_possible() const { return reach_ > 0; }

  // Robots whose cells are more columns or rows apart at the beginning of a step do not overlap in it.
  std::int32_t reach_cells() const { return reach_; }

  // Whether the robots overlap while both stand on these cells.
  bool overlap(std::uint32_t a, toolkit::Cell at_a, std::uint32_t b, toolkit::Cell at_b);

  // Whether the robots overlap on their way from their cells at one step to those at the next, the next included. Never
  // for two robots that are not active: they stay where they are.
  bool overlap(std::uint32_t a, toolkit::Cell a0, toolkit::Cell a1, std::uint32_t b, toolkit::Cell b0,
               toolkit::Cell b1);

 private:
  // What a robot does in a step: one of eight moves, a stand at any heading, or a stand along one of four axes.
  using Motion = std::uint8_t;

  struct Body {
    double radius_m;
    std::vector<ConvexPolygon> parts;  // none: a disc
    bool operator==(const Body& other) const;
  };
  struct Member {
    std::size_t body;
    const dmrp_grid* grid;
    bool is_active;
  };
  // What a body covers, relative to its place.
  struct Cover {
    double radius_m;
    std::vector<ConvexPolygon> polygons;  // none: the disc
  };
  // By offset of cells and the two motions: whether two bodies overlap; unknown until it is asked for.
  enum class Entry : std::uint8_t { unknown, apart, overlap };

  static Cover cover_of(const Body& body, Motion motion);
  Motion stand(const Member& robot, toolkit::Cell cell) const;
  bool look_up(const Member& a, toolkit::Cell at_a, Motion a_does, const Member& b, toolkit::Cell at_b, Motion b_does);
  bool bodies_overlap(const Body& a, Motion a_does, const Body& b, Motion b_does, toolkit::Cell b_from_a) const;

  double cell_m_;
  std::int32_t reach_ = 0;
  std::vector<Body> bodies_;  // all different
  std::vector<Member> robots_;
  std::vector<std::vector<Entry>> tables_;  // by pair of bodies
};

}  // namespace dmrp::core
