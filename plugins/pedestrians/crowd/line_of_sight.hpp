// SPDX-License-Identifier: MIT
// Whether people see their targets, with answers that stay valid while they walk.
//
// Going along a long line cell by cell is slow, and a person asks again at every new cell on the way to the same target
// t. So the last line is kept, with a witness w and a distance r for which its answer also holds for other lines to t:
//
//   free: the line ran from w to t, and            blocked: w is the centre of a blocked square whose
//   every blocked cell is at least r from it       inscribed circle has the radius r
//
//         ######  nearest blocked cell                            ##########
//         ######                                                  ##########
//           |                                       p o--_        ####w#####
//           | r                                            `--_   ###|######
//           |                                                  `--_  | d < r
//   w o-----+-----------------------* t                           ##`--_####
//        |                    __--'                                     `--_
//        | d < r      __---'                                                `--* t
//      p o-----___--'
//
//   No point of the line from p to t is farther    The line from p to t passes w at a distance
//   from the line w-t than p is. For d < r it      d < r, so it crosses the square: t is hidden
//   meets no blocked cell: t is in sight of p.     from p.
#pragma once

#include <cstdint>
#include <dmrp/cpp/plugin_base.hpp>
#include <dmrp/toolkit/grid_view.hpp>
#include <vector>

namespace dmrp::pedestrians {

// A line to a target, its answer, and the range in which the answer holds for other lines to this target.
struct SightLine {
  Vec2 to = {0.0, 0.0};
  Vec2 witness = {0.0, 0.0};  // of a free line: its beginning; of a blocked one: the centre of the obstacle
  bool is_free = false;
  float range_m = 0.0F;  // r in the figure
};

// Gives the same answers as toolkit::line_is_free().
class LineOfSight {
 public:
  // The grid's arrays must outlive this object.
  void start(const toolkit::GridView& grid);

  // Whether all cells on the line are free. `last` is the line examined before, if any; it is replaced where it does
  // not answer this question. `last.to` is `to` afterwards.
  bool is_free(Vec2 from, Vec2 to, SightLine& last) const;

 private:
  // A cell's state, and whether its eight neighbours have the same one.
  enum class CellState : std::uint8_t { all_blocked, blocked, free, all_free };

  struct Ray {
    Vec2 from;
    Vec2 direction;  // unit vector; zero where the length is zero
    double length_m;
  };

  static bool is_answered_by(const SightLine& last, Vec2 from);
  SightLine examine(Vec2 from, Vec2 to) const;
  double clearance_beside(toolkit::Cell cell, const Ray& ray) const;

  toolkit::GridView grid_;
  std::vector<CellState> states_;  // by cell
};

}  // namespace dmrp::pedestrians
