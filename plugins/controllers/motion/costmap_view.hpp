// SPDX-License-Identifier: MIT
// costmap_view.hpp: a dmrp_costmap read by points, and costs read as distances.
#ifndef DMRP_CONTROLLERS_MOTION_COSTMAP_VIEW_HPP
#define DMRP_CONTROLLERS_MOTION_COSTMAP_VIEW_HPP

#include <dmrp/ext/local_costmap.h>

#include <cmath>
#include <cstdint>

namespace dmrp::controllers {

// A view: the costmap must outlive it. Outside the window nothing is known: cost free.
class CostmapView {
 public:
  explicit CostmapView(const dmrp_costmap& map)
      : map_(&map),
        width_(static_cast<std::int32_t>(map.width)),
        height_(static_cast<std::int32_t>(map.height)),
        cells_per_m_(1.0 / map.resolution_m) {}

  std::int32_t width() const { return width_; }
  std::int32_t height() const { return height_; }
  double resolution_m() const { return map_->resolution_m; }
  const std::uint8_t* costs() const { return map_->costs; }

  // Cells left of or below the window may come out as -1 or less, never as 0.
  std::int32_t column_of(double x) const { return whole((x - map_->origin.x) * cells_per_m_); }
  std::int32_t row_of(double y) const { return whole((y - map_->origin.y) * cells_per_m_); }
  bool contains(std::int32_t column, std::int32_t row) const {
    return static_cast<std::uint32_t>(column) < map_->width && static_cast<std::uint32_t>(row) < map_->height;
  }
  // -1 outside the window.
  std::int32_t index_of(double x, double y) const {
    const std::int32_t column = column_of(x);
    const std::int32_t row = row_of(y);
    return contains(column, row) ? row * width_ + column : -1;
  }
  std::uint8_t cost(double x, double y) const {
    const std::int32_t index = index_of(x, y);
    return index < 0 ? std::uint8_t{DMRP_COST_FREE} : map_->costs[index];
  }
  dmrp_vec2 center(std::int32_t column, std::int32_t row) const {
    return {map_->origin.x + (column + 0.5) * map_->resolution_m, map_->origin.y + (row + 0.5) * map_->resolution_m};
  }

  // The highest cost of a cell that is at least `distance_m` from every obstacle.
  std::uint8_t highest_cost_at(double distance_m) const;

  // How far the nearest obstacle of a cell of this cost is: the inscribed radius or less for the top costs, the
  // inflation radius or more for free cells.
  double distance_of(std::uint8_t cost) const;

  // From a point to the nearest lethal cell's centre, up to `limit_m`, cell by cell: for the few places where the
  // costs say no more than "too near".
  double distance_to_lethal(dmrp_vec2 point, double limit_m) const;

 private:
  static std::int32_t whole(double cells) {
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

#endif
