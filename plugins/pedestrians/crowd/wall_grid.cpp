// SPDX-License-Identifier: MIT
#include "pedestrians/crowd/wall_grid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/segment.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::pedestrians {

namespace {

constexpr double cell_m = 1.0;
constexpr double half_diagonal_m = 0.70710678118654757 * cell_m;

std::int32_t cells_along(double extent_m) {
  return std::max(static_cast<std::int32_t>(std::ceil(extent_m / cell_m)), 1);
}

std::int32_t clamped(double cells, std::int32_t count) {
  return cells > 0.0 ? static_cast<std::int32_t>(std::min(cells, count - 1.0)) : 0;
}

}  // namespace

void WallGrid::start(Span<Segment> segments, Vec2 lower, Vec2 upper, double reach_m) {
  assert(lower.x <= upper.x && lower.y <= upper.y && reach_m >= 0.0);
  segments_.assign(segments.begin(), segments.end());
  lower_ = lower;
  reach_m_ = reach_m;
  columns_ = cells_along(upper.x - lower.x);
  rows_ = cells_along(upper.y - lower.y);

  // a segment belongs to every cell whose centre is nearer to it than the reach and half of the cell's diagonal
  std::vector<std::vector<std::uint32_t>> cells(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  const double bound_m = reach_m + half_diagonal_m;
  for (std::uint32_t s = 0; s < segments_.size(); ++s) {
    const Segment& wall = segments_[s];
    const auto first_column = clamped((std::min(wall.from.x, wall.to.x) - bound_m - lower.x) / cell_m, columns_);
    const auto last_column = clamped((std::max(wall.from.x, wall.to.x) + bound_m - lower.x) / cell_m, columns_);
    const auto first_row = clamped((std::min(wall.from.y, wall.to.y) - bound_m - lower.y) / cell_m, rows_);
    const auto last_row = clamped((std::max(wall.from.y, wall.to.y) + bound_m - lower.y) / cell_m, rows_);
    for (std::int32_t row = first_row; row <= last_row; ++row) {
      for (std::int32_t column = first_column; column <= last_column; ++column) {
        const Vec2 center = {lower.x + (column + 0.5) * cell_m, lower.y + (row + 0.5) * cell_m};
        if (toolkit::distance(wall, center) <= bound_m) cells[cell_of(center)].push_back(s);
      }
    }
  }

  begins_.assign(1, 0);
  members_.clear();
  for (const auto& cell : cells) {
    members_.insert(members_.end(), cell.begin(), cell.end());
    begins_.push_back(static_cast<std::uint32_t>(members_.size()));
  }
}

void WallGrid::nearest_points(Vec2 position, std::vector<WallPoint>& found) const {
  found.clear();
  for (const std::uint32_t s : near(position)) {
    const Vec2 apart = position - toolkit::closest_point(segments_[s], position);
    const double distance_m = toolkit::norm(apart);
    if (distance_m > 0.0 && distance_m <= reach_m_) found.push_back({apart / distance_m, distance_m});
  }
}

Span<std::uint32_t> WallGrid::near(Vec2 position) const {
  const std::size_t cell = cell_of(position);
  return {members_.data() + begins_[cell], begins_[cell + 1] - begins_[cell]};
}

std::size_t WallGrid::cell_of(Vec2 position) const {
  const auto column = static_cast<std::size_t>(clamped((position.x - lower_.x) / cell_m, columns_));
  const auto row = static_cast<std::size_t>(clamped((position.y - lower_.y) / cell_m, rows_));
  return row * static_cast<std::size_t>(columns_) + column;
}

}  // namespace dmrp::pedestrians
