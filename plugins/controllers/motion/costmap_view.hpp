// SPDX-License-Identifier: MIT
// costmap_view.hpp: a dmrp_costmap addressed by points, and its costs converted to distances.
#pragma once

#include <dmrp/ext/local_costmap.h>

#include <cassert>
#include <cstdint>
#include <dmrp/cpp/local_controller.hpp>

namespace dmrp::controllers {

// A view: the costmap must outlive it. Points outside the costmap's window count as free.
class CostmapView {
 public:
  explicit CostmapView(const dmrp_costmap& map)
      : map_(&map),
        width_(static_cast<std::int32_t>(map.width)),
        height_(static_cast<std::int32_t>(map.height)),
        cells_per_m_(1.0 / map.resolution_m) {
    assert(map.costs && map.resolution_m > 0.0);
  }

  std::int32_t width() const { return width_; }
  std::int32_t height() const { return height_; }
  double resolution_m() const { return map_->resolution_m; }
  const std::uint8_t* costs() const { return map_->costs; }

  // Negative left of or below the window.
  std::int32_t column_of(double x) const { return floor((x - map_->origin.x) * cells_per_m_); }
  std::int32_t row_of(double y) const { return floor((y - map_->origin.y) * cells_per_m_); }
  bool contains(std::int32_t column, std::int32_t row) const {
    return static_cast<std::uint32_t>(column) < map_->width && static_cast<std::uint32_t>(row) < map_->height;
  }
  // -1 outside the window.
  std::int32_t index_of(Vec2 point) const {
    const std::int32_t column = column_of(point.x);
    const std::int32_t row = row_of(point.y);
    return contains(column, row) ? row * width_ + column : -1;
  }
  std::uint8_t cost(Vec2 point) const {
    const std::int32_t index = index_of(point);
    return index < 0 ? std::uint8_t{DMRP_COST_FREE} : map_->costs[index];
  }
  Vec2 center(std::int32_t column, std::int32_t row) const {
    return {map_->origin.x + (column + 0.5) * map_->resolution_m, map_->origin.y + (row + 0.5) * map_->resolution_m};
  }

  // The highest cost of a cell at least `distance_m` from every obstacle.
  std::uint8_t highest_cost_at(double distance_m) const;

  // The distance from a cell of this cost to the nearest obstacle. Costs from DMRP_COST_INSCRIBED on give the inscribed
  // radius, an upper bound; DMRP_COST_LETHAL gives 0; free cells give the inflation radius, a lower bound.
  double distance_of(std::uint8_t cost) const;

  // The distance from a point to the centre of the nearest lethal cell, at most `limit_m`. Scans the cells within
  // `limit_m`: meant for points closer to an obstacle than the costs can resolve.
  double distance_to_lethal(Vec2 point, double limit_m) const;

 private:
  static std::int32_t floor(double cells) {
    if (!(cells > -1e9 && cells < 1e9)) return -1000000000;
    const auto truncated = static_cast<std::int32_t>(cells);
    return truncated - (cells < truncated);
  }

  const dmrp_costmap* map_;
  std::int32_t width_;
  std::int32_t height_;
  double cells_per_m_;
};

}  // namespace dmrp::controllers
