// SPDX-License-Identifier: MIT
// shortest_way.hpp: the length of the shortest way of a disc between points in the static world.
//
// Theta* (Nash, Daniel, Koenig and Felner, AAAI 2007; Daniel et al., JAIR 39, 2010): A* over the cells of a grid whose
// nodes may have any earlier node in line of sight as parent, so ways bend only at corners and do not follow the grid.
// The found length is within about 1 % of the shortest. A cell is open if its centre is at least the disc's radius away
// from every shape. Starts and goals keep their exact positions; their cells count as open.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/grid_view.hpp>
#include <utility>
#include <vector>

namespace dmrp::metrics {

class ShortestWay {
 public:
  // The grid must outlive this object.
  explicit ShortestWay(const Grid& grid) : grid_(grid) {}

  // From the robot's start through its goals in order; NaN if there is no way.
  double tour_length(const Robot& robot);

  // NaN if there is no way.
  double length(Vec2 from, Vec2 to, double radius_m);

 private:
  using Entry = std::pair<double, std::uint32_t>;  // estimated length of the whole way, cell

  bool open(std::uint32_t cell) const;
  bool is_visible(Vec2 from, Vec2 to) const;
  Vec2 position_of(std::uint32_t cell) const;
  void expand(std::uint32_t cell);

  toolkit::GridView grid_;
  double radius_m_ = 0.0;
  Vec2 from_ = {0.0, 0.0};
  Vec2 to_ = {0.0, 0.0};
  std::uint32_t first_ = 0;
  std::uint32_t last_ = 0;
  std::vector<double> lengths_m_;       // by cell: of the best way found so far
  std::vector<std::uint32_t> parents_;  // by cell
  std::vector<std::uint8_t> settled_;   // by cell
  std::vector<Entry> queue_;
};

}  // namespace dmrp::metrics
