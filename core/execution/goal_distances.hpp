// SPDX-License-Identifier: MIT
// goal_distances.hpp: how far a robot still has to go, whatever its plan says.
#pragma once

#include <dmrp/values.h>

#include <array>
#include <cstdint>
#include <dmrp/toolkit/grid_view.hpp>
#include <map>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

namespace dmrp::core {

// The lengths of the shortest ways to one goal among static obstacles, along the edges of a grid.
//
// Reverse resumable A* (Silver: Cooperative pathfinding, AIIDE 2005): the search begins at the goal, is directed to the
// place of the first question, and goes on whenever a question concerns a cell that it has not settled. So a large grid
// costs what the robot sees of it.
class GoalDistances {
 public:
  // The grid's arrays outlive this. A goal in no free cell is reached from the free cells nearest to it.
  GoalDistances(const toolkit::GridView& grid, dmrp_vec2 goal);

  // Straight to the goal in its cell and beside it, elsewhere by the best of the cells around the point that are
  // connected to it. Infinity where no way leads to the goal.
  double from(dmrp_vec2 point);

 private:
  static constexpr std::uint32_t tile_cells = 8;  // across
  struct Tile {
    std::array<float, std::size_t{tile_cells} * tile_cells> to_goal_m;
    std::uint64_t settled = 0;  // a bit a cell
  };
  struct Node {
    float& to_goal_m;
    std::uint64_t& settled;
    std::uint64_t bit;
  };
  using Entry = std::pair<double, std::uint32_t>;  // estimate of the whole way, cell: the order of settling

  Node node(toolkit::Cell cell);
  void offer(toolkit::Cell cell, double to_goal_m);
  double settle(toolkit::Cell cell);
  double estimate_m(toolkit::Cell cell) const;

  toolkit::GridView grid_;
  dmrp_vec2 goal_;
  toolkit::Cell goal_cell_;
  toolkit::Cell aim_;  // of the search
  bool aims_ = false;
  std::uint32_t tile_columns_;
  std::vector<std::unique_ptr<Tile>> tiles_;
  std::vector<Entry> queue_;
};

// Shared by all robots with the same grid and goal.
class GoalDistancesCache {
 public:
  std::shared_ptr<GoalDistances> to(const dmrp_grid& grid, dmrp_vec2 goal);

 private:
  std::map<std::tuple<const std::uint8_t*, double, double>, std::weak_ptr<GoalDistances>> known_;
};

}  // namespace dmrp::core
