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
      numbers_(static_cast<std::size_t>(grid.width) * grid.height, nowhere) {
  std::vector<std::uint8_t> edges;  // by location
  for (std::size_t cell = 0; cell < numbers_.size(); ++cell) {
    if (!grid.free[cell]) continue;
    numbers_[cell] = static_cast<Location>(places_.size());
    places_.push_back({static_cast<std::int32_t>(cell % grid.width), static_cast<std::int32_t>(cell / grid.width)});
    edges.push_back(grid.edges[cell]);
  }
  open_.assign(places_.size(), 1);
  neighbors_.assign(places_.size() * direction_count, nowhere);
  predecessors_.assign(places_.size() * direction_count, nowhere);
  for (Location from = 0; from < location_count(); ++from)
    for (Direction d = 0; d < direction_count; ++d) {
      const Move& move = moves[static_cast<std::size_t>(d)];
      if (!is_open_move(edges[index(from)], from, move)) continue;
      const Location to = offset(from, move.columns, move.rows);
      neighbors_[slot(from, d)] = to;
      predecessors_[slot(to, d)] = from;
    }
}

template <Direction connectivity>
bool BasicGridGraph<connectivity>::is_open_move(std::uint8_t edges, Location from, const Move& move) const {
  if (!(edges & move.bit) || offset(from, move.columns, move.rows) == nowhere) return false;
  return move.columns == 0 || move.rows == 0 ||
         (offset(from, move.columns, 0) != nowhere && offset(from, 0, move.rows) != nowhere);
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
  const Location location = at(static_cast<std::int32_t>(column), static_cast<std::int32_t>(row));
  return location != nowhere && is_open(location) ? location : nowhere;
}

template <Direction connectivity>
dmrp_vec2 BasicGridGraph<connectivity>::center(Location location) const {
  return {origin_.x + (column(location) + 0.5) * resolution_m_, origin_.y + (row(location) + 0.5) * resolution_m_};
}

template class BasicGridGraph<4>;
template class BasicGridGraph<8>;

}  // namespace dmrp::planners
