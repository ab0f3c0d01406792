// SPDX-License-Identifier: MIT
// Whether people see their targets, asked again and again on their way there.
#pragma once

#include <cstdint>
#include <dmrp/toolkit/grid_view.hpp>
#include <vector>

namespace dmrp::pedestrians {

// A line that somebody looked along.
struct LineOfSight {
  dmrp_vec2 from = {0.0, 0.0};
  dmrp_vec2 to = {0.0, 0.0};
  double room_m = 0.0;  // from anywhere nearer to it than this, `to` is in sight too; 0 where it is not free itself
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
  enum class Room : std::uint8_t { none, beside_blocked, all_round };  // of a cell: which of the nine are free

  double room_beside(toolkit::Cell cell, const LineOfSight& line) const;

  toolkit::GridView grid_;
  std::vector<Room> rooms_;  // by cell
};

}  // namespace dmrp::pedestrians
