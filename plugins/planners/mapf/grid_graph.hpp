// SPDX-License-Identifier: MIT
// grid_graph.hpp: the planning grid as a graph: flat arrays of neighbors, one slot a direction.
#pragma once

#include <dmrp/grid.h>

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dmrp::planners {

// A free cell of the grid. Free cells are numbered from 0 in row-major order, so that tables over all locations do not
// grow with walls.
using Location = std::int32_t;
constexpr Location nowhere = -1;

// A direction of motion, counter-clockwise from east: of four east, north, west, south; of eight those and, between
// them, the diagonals, which have the odd numbers.
using Direction = std::int32_t;

template <Direction connectivity>
class BasicGridGraph {
  static_assert(connectivity == 4 || connectivity == 8);

 public:
  static constexpr Direction direction_count = connectivity;
  static constexpr Direction no_direction = direction_count;  // of a robot that has not moved yet

  // Takes the moves of the edge mask, except those that leave the grid, enter a cell that is not free, or cut a corner.
  explicit BasicGridGraph(const dmrp_grid& grid);

  // Removes a cell: no move enters or leaves it, and no diagonal passes beside it.
  void block(Location location);

  Location location_count() const { return static_cast<Location>(open_.size()); }
  // False after block().
  bool is_open(Location location) const { return open_[index(location)] != 0; }

  // The destination of the move, or nowhere.
  Location neighbor(Location from, Direction d) const { return neighbors_[slot(from, d)]; }

  // The origin of the move in direction d that ends here, or nowhere. (The mask need not be symmetric.)
  Location predecessor(Location to, Direction d) const { return predecessors_[slot(to, d)]; }

  static constexpr Direction opposite(Direction d) { return (d + direction_count / 2) % direction_count; }
  static constexpr bool is_diagonal(Direction d) { return connectivity == 8 && d % 2 != 0; }

  // The two cells beside an open diagonal: those that share an edge with both its ends.
  std::array<Location, 2> beside(Location from, Direction diagonal) const {
    assert(is_diagonal(diagonal) && neighbor(from, diagonal) != nowhere);
    const Move& move = moves[static_cast<std::size_t>(diagonal)];
    return {at(column(from) + move.columns, row(from)), at(column(from), row(from) + move.rows)};
  }

  // Whether the opposite of every move is a move.
  bool is_symmetric() const;

  std::int32_t column(Location location) const { return places_[index(location)].column; }
  std::int32_t row(Location location) const { return places_[index(location)].row; }
  // The location in this column and row, or nowhere.
  Location at(std::int32_t column, std::int32_t row) const {
    if (column < 0 || row < 0 || column >= width_ || row >= height_) return nowhere;
    return numbers_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                    static_cast<std::size_t>(column)];
  }

  // The open cell that contains the point, or nowhere.
  Location locate(dmrp_vec2 point) const;
  dmrp_vec2 center(Location location) const;

 private:
  struct Move {
    std::uint8_t bit;
    std::int32_t columns;
    std::int32_t rows;
  };
  static constexpr std::array<Move, connectivity> all_moves() {
    constexpr std::array<Move, 8> eight = {{{DMRP_EDGE_E, 1, 0},
                                            {DMRP_EDGE_NE, 1, 1},
                                            {DMRP_EDGE_N, 0, 1},
                                            {DMRP_EDGE_NW, -1, 1},
                                            {DMRP_EDGE_W, -1, 0},
                                            {DMRP_EDGE_SW, -1, -1},
                                            {DMRP_EDGE_S, 0, -1},
                                            {DMRP_EDGE_SE, 1, -1}}};
    std::array<Move, connectivity> out{};
    for (std::size_t d = 0; d < out.size(); ++d) out[d] = eight[d * (8 / out.size())];
    return out;
  }
  static constexpr std::array<Move, connectivity> moves = all_moves();

  struct Place {
    std::int32_t column;
    std::int32_t row;
  };

  std::size_t index(Location location) const {
    assert(location >= 0 && location < static_cast<Location>(places_.size()));
    return static_cast<std::size_t>(location);
  }
  std::size_t slot(Location location, Direction d) const {
    assert(d >= 0 && d < direction_count);
    return index(location) * static_cast<std::size_t>(direction_count) + static_cast<std::size_t>(d);
  }
  // The location so many columns and rows away, or nowhere.
  Location offset(Location from, std::int32_t columns, std::int32_t rows) const {
    return at(column(from) + columns, row(from) + rows);
  }
  bool is_open_move(std::uint8_t edges, Location from, const Move& move) const;
  void close(Location from, Direction d);

  std::int32_t width_;
  std::int32_t height_;
  double resolution_m_;
  dmrp_vec2 origin_;
  std::vector<Location> numbers_;  // by cell in row-major order; nowhere if it is not free
  std::vector<Place> places_;      // by location, as all that follow
  std::vector<std::uint8_t> open_;
  std::vector<Location> neighbors_;
  std::vector<Location> predecessors_;
};

extern template class BasicGridGraph<4>;
extern template class BasicGridGraph<8>;

using GridGraph = BasicGridGraph<4>;

// For four directions.
constexpr Direction opposite(Direction d) {
  return GridGraph::opposite(d);
}

}  // namespace dmrp::planners
