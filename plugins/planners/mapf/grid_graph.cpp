// SPDX-License-Identifier: MIT
#include "planners/mapf/grid_graph.hpp"

#include <cmath>

namespace dmrp::planners {

template <Direction connectivity>
BasicGridGraph<connectivity>::BasicGridGraph(const dmrp_grid& grid)
    : width_(static_cast<std::int32_t>(grid.width)),
      height_(static_cast<std::int32_t>(grid.height)),
      resolution_m_(grid.resolution_m),
      origin_(grid.origin),
      open_(grid.free, grid.free + static_cast<std::size_t>(grid.width) * grid.height),
      neighbors_(open_.size() * direction_count, nowhere),
      predecessors_(open_.size() * direction_count, nowhere) {
  for (Location from = 0; from < location_count(); ++from) {
    if (!is_open(from)) continue;
    for (Direction d = 0; d < direction_count; ++d) {
      const Move& move = moves[static_cast<std::size_t>(d)];
      if (!is_open_move(grid, from, move)) continue;
      const Location to = from + move.columns + move.rows * width_;
      neighbors_[slot(from, d)] = to;
      predecessors_[slot(to, d)] = from;
    }
  }
}

template <Direction connectivity>
Location BasicGridGraph<connectivity>::offset(Location from, std::int32_t columns, std::int32_t rows) const {
  const std::int32_t column = from % width_ + columns;
  const std::int32_t row = from / width_ + rows;
  return column >= 0 && column < width_ && row >= 0 && row < height_ ? row * width_ + column : nowhere;
}

template <Direction connectivity>
bool BasicGridGraph<connectivity>::is_open_move(const dmrp_grid& grid, Location from, const Move& move) const {
  if (!(grid.edges[index(from)] & move.bit)) return false;
  const Location to = offset(from, move.columns, move.rows);
  if (to == nowhere || !is_open(to)) return false;
  return move.columns == 0 || move.rows == 0 || (is_open(from + move.columns) && is_open(from + move.rows * width_));
}

template <Direction connectivity>
void BasicGridGraph<connectivity>::close(Location from, Direction d) {
  const Location to = neighbor(from, d);
  if (to == nowhere) return;
  neighbors_[slot(from, d)] = nowhere;
  predecessors_[slot(to, d)] = nowhere;
}

template <Direction connectivity>
void BasicGridGraph<connectivity>::block(Location location) {
  open_[index(location)] = 0;
  for (Direction d = 0; d < direction_count; ++d) {
    close(location, d);
    if (const Location from = predecessor(location, d); from != nowhere) close(from, d);
  }
  // the diagonals between two neighbors of this cell
  if constexpr (connectivity == 8)
    for (Direction side = 0; side < direction_count; side += 2) {
      const Move& move = moves[static_cast<std::size_t>(side)];
      const Location from = offset(location, move.columns, move.rows);
      if (from == nowhere) continue;
      close(from, (side + 3) % direction_count);
      close(from, (side + 5) % direction_count);
    }
}

template <Direction connectivity>
bool BasicGridGraph<connectivity>::is_symmetric() const {
  for (Location from = 0; from < location_count(); ++from)
    for (Direction d = 0; d < direction_count; ++d)
      if (const Location to = neighbor(from, d); to != nowhere && neighbor(to, opposite(d)) != from) return false;
  return true;
}

template <Direction connectivity>
Location BasicGridGraph<connectivity>::locate(dmrp_vec2 point) const {
  const double column = std::floor((point.x - origin_.x) / resolution_m_);
  const double row = std::floor((point.y - origin_.y) / resolution_m_);
  if (!(column >= 0 && row >= 0 && column < width_ && row < height_)) return nowhere;
  const Location location = static_cast<Location>(row) * width_ + static_cast<Location>(column);
  return is_open(location) ? location : nowhere;
}

template <Direction connectivity>
dmrp_vec2 BasicGridGraph<connectivity>::center(Location location) const {
  return {origin_.x + (location % width_ + 0.5) * resolution_m_, origin_.y + (location / width_ + 0.5) * resolution_m_};
}

template class BasicGridGraph<4>;
template class BasicGridGraph<8>;

}  // namespace dmrp::planners
