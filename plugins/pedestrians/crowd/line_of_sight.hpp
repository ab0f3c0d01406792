// SPDX-License-Identifier: MIT
// Whether people see their targets, asked again and again on their way there.
#pragma once

#include <dmrp/values.h>

#include <cstdint>
#include <dmrp/toolkit/grid_view.hpp>
#include <vector>

namespace dmrp::pedestrians {

// A line that somebody looked along, and how far beside it the answer is the same.
struct LineOfSight {
  dmrp_vec2 to = {0.0, 0.0};
  dmrp_vec2 witness = {0.0, 0.0};  // where it began if it is free; else the middle of what is in the way
  bool is_free = false;
  float room_m = 0.0F;  // lines to `to` are free that begin nearer to this one; or blocked that pass the witness nearer
};

// Answers as toolkit::line_is_free() does, mostly without going along the line: in a large world lines are long, and
// whoever walks along one of them stays beside it.
class Sight {
 public:
  // The grid's arrays must outlive it.
  void start(const toolkit::GridView& grid);

  // Whether all cells on the line are free. `last` is the line that was looked along before, if any, and becomes this
  // one unless it answers by itself; `last.to` is `to` afterwards.
  bool is_free(dmrp_vec2 from, dmrp_vec2 to, LineOfSight& last) const;

 private:
  // Of a cell: free or not, and whether all eight around it are the same.
  enum class Room : std::uint8_t { all_blocked, blocked, free, all_free };

  struct Ray {
    dmrp_vec2 from;
    dmrp_vec2 along;  // unit vector; zero where the length is
    double length_m;
  };

  static bool is_told_by(const LineOfSight& last, dmrp_vec2 from);
  LineOfSight look(dmrp_vec2 from, dmrp_vec2 to) const;
  double room_beside(toolkit::Cell cell, const Ray& ray) const;

  toolkit::GridView grid_;
  std::vector<Room> rooms_;  // by cell
};

}  // namespace dmrp::pedestrians
