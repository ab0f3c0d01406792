// SPDX-License-Identifier: MIT
#include "grid_graph.hpp"

#include <cmath>

namespace dmrp::planners {

namespace {

struct Move {
  std::uint8_t bit;
  std::int32_t columns;
  std::int32_t rows;
};

constexpr std::array<Move, GridGraph::direction_count> moves = {
    {{DMRP_EDGE_E, 1, 0}, {DMRP_EDGE_N, 0, 1}, {DMRP_EDGE_W, -1, 0}, {DMRP_EDGE_S, 0, -1}}};

}  // namespace

GridGraph::GridGraph(const dmrp_grid& grid)
    : width_(static_cast<std::int32_t>(grid.width)),
      height_(static_cast<std::int32_t>(grid.height)),
      resolution_m_(grid.resolution_m),
      origin_(grid.origin),
      open_(grid.free, grid.free + static_cast<std::size_t>(grid.width) * grid.height),
      neighbors_(open_.size() * direction_count, nowhere),
      predecessors_(open_.size() * direction_count, nowhere) {
  for (std::int32_t row = 0; row < height_; ++row)
    for (std::int32_t column = 0; column < width_; ++column) {
      const Location from = row * width_ + column;
      if (!is_open(from)) continue;
      for (Direction d = 0; d < direction_count; ++d) {
        const Move& move = moves[static_cast<std::size_t>(d)];
        const std::int32_t to_column = column + move.columns;
        const std::int32_t to_row = row + move.rows;
        if (to_column < 0 || to_column >= width_ || to_row < 0 || to_row >= height_) continue;
        const Location to = to_row * width_ + to_column;
        if (!(grid.edges[index(from)] & move.bit) || !is_open(to)) continue;
        neighbors_[slot(from, d)] = to;
        predecessors_[slot(to, d)] = from;
      }
    }
}

void GridGraph::block(Location location) {
  open_[index(location)] = 0;
  for (Direction d = 0; d < direction_count; ++d) {
    const Location to = neighbor(location, d);
    const Location from = predecessor(location, d);
    if (to != nowhere) predecessors_[slot(to, d)] = nowhere;
    if (from != nowhere) neighbors_[slot(from, d)] = nowhere;
    neighbors_[slot(location, d)] = nowhere;
    predecessors_[slot(location, d)] = nowhere;
  }
}

bool GridGraph::is_symmetric() const {
  for (Location from = 0; from < location_count(); ++from)
    for (Direction d = 0; d < direction_count; ++d)
      if (const Location to = neighbor(from, d); to != nowhere && neighbor(to, opposite(d)) != from) return false;
  return true;
}

Location GridGraph::locate(dmrp_vec2 point) const {
  const double column = std::floor((point.x - origin_.x) / resolution_m_);
  const double row = std::floor((point.y - origin_.y) / resolution_m_);
  if (!(column >= 0 && row >= 0 && column < width_ && row < height_)) return nowhere;
  const Location location = static_cast<Location>(row) * width_ + static_cast<Location>(column);
  return is_open(location) ? location : nowhere;
}

dmrp_vec2 GridGraph::center(Location location) const {
  return {origin_.x + (location % width_ + 0.5) * resolution_m_, origin_.y + (location / width_ + 0.5) * resolution_m_};
}

}  // namespace dmrp::planners
