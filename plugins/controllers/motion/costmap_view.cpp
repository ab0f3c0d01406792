// SPDX-License-Identifier: MIT
#include "controllers/motion/costmap_view.hpp"

#include <algorithm>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers {

namespace {

// The cost just outside the inscribed radius.
constexpr double highest_decaying_cost = DMRP_COST_INSCRIBED - 1;

}  // namespace

std::uint8_t CostmapView::highest_cost_at(double distance_m) const {
  if (distance_m <= map_->inscribed_radius_m) return DMRP_COST_INSCRIBED - 1;
  if (distance_m > map_->inflation_radius_m) return DMRP_COST_FREE;
  const double cost = highest_decaying_cost * std::exp(-map_->cost_scaling * (distance_m - map_->inscribed_radius_m));
  return static_cast<std::uint8_t>(cost);
}

double CostmapView::distance_of(std::uint8_t cost) const {
  if (cost >= DMRP_COST_LETHAL) return 0.0;
  if (cost >= DMRP_COST_INSCRIBED || !(map_->cost_scaling > 0.0)) return map_->inscribed_radius_m;
  if (cost == DMRP_COST_FREE) return map_->inflation_radius_m;
  return std::min(map_->inflation_radius_m,
                  map_->inscribed_radius_m - std::log(cost / highest_decaying_cost) / map_->cost_scaling);
}

double CostmapView::distance_to_lethal(Vec2 point, double limit_m) const {
  const std::int32_t first_column = std::max(0, column_of(point.x - limit_m));
  const std::int32_t last_column = std::min(width_ - 1, column_of(point.x + limit_m));
  const std::int32_t first_row = std::max(0, row_of(point.y - limit_m));
  const std::int32_t last_row = std::min(height_ - 1, row_of(point.y + limit_m));
  double nearest_squared = limit_m * limit_m;
  for (std::int32_t row = first_row; row <= last_row; ++row) {
    for (std::int32_t column = first_column; column <= last_column; ++column) {
      if (map_->costs[row * width_ + column] < DMRP_COST_LETHAL) continue;
      nearest_squared = std::min(nearest_squared, toolkit::squared_distance(point, center(column, row)));
    }
  }
  return std::sqrt(nearest_squared);
}

}  // namespace dmrp::controllers
