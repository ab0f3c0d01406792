// SPDX-License-Identifier: MIT
// grid_graph.hpp: the planning grid as a graph: flat arrays of neighbors, one slot a direction.
#pragma once

#include <dmrp/grid.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dmrp::planners {

// A cell of the grid by its row-major index.
using Location = std::int32_t;
constexpr Location nowhere = -1;

// A direction of motion; of four: east, north, west, south.
using Direction = std::int32_t;

class GridGraph {
 public:
  static constexpr Direction direction_count = 4;
  static constexpr Direction no_direction = direction_count;  // of a robot that has not moved yet

  // Moves are those of the edge mask; a move that leaves the grid or enters a cell that is not free is none.
  explicit GridGraph(const dmrp_grid& grid);

  // Takes a cell out: no move enters or leaves it.
  void block(Location location);

  Location location_count() const { return static_cast<Location>(open_.size()); }
  bool is_open(Location location) const { return open_[index(location)] != 0; }

  // Where the move leads, or nowhere.
  Location neighbor(Location from, Direction d) const { return neighbors_[slot(from, d)]; }

  // Where a move in direction d that ends here comes from, or nowhere. (A mask need not be symmetric.)
  Location predecessor(Location to, Direction d) const { return predecessors_[slot(to, d)]; }

  // Whether every move can be undone.
  bool is_symmetric() const;

  // Columns: the number of locations in a row.
  std::int32_t width() const { return width_; }

  // The open cell that holds a point, or nowhere.
  Location locate(dmrp_vec2 point) const;
  dmrp_vec2 center(Location location) const;

 private:
  static std::size_t index(Location location) { return static_cast<std::size_t>(location); }
  static std::size_t slot(Location location, Direction d) {
    return index(location) * static_cast<std::size_t>(direction_count) + static_cast<std::size_t>(d);
  }

  std::int32_t width_;
  std::int32_t height_;
  double resolution_m_;
  dmrp_vec2 origin_;
  std::vector<std::uint8_t> open_;
  std::vector<Location> neighbors_;
  std::vector<Location> predecessors_;
};

constexpr Direction opposite(Direction d) {
  return (d + GridGraph::direction_count / 2) % GridGraph::direction_count;
}

}  // namespace dmrp::planners
