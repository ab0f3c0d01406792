// SPDX-License-Identifier: MIT
#include "controllers/mppi/still_costmap.hpp"

#include <algorithm>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>

#include "controllers/motion/costmap_view.hpp"

namespace dmrp::controllers::mppi {

namespace {

std::uint8_t cost_at(const dmrp_costmap& map, double distance_m) {
  if (distance_m <= 0.5 * map.resolution_m) return DMRP_COST_LETHAL;
  if (distance_m < map.inscribed_radius_m) return DMRP_COST_INSCRIBED;
  return CostmapView(map).highest_cost_at(distance_m);
}

}  // namespace

const dmrp_costmap& StillCostmap::copy(const dmrp_costmap& map, const std::vector<Obstacle>& obstacles) {
  costs_.assign(map.costs, map.costs + std::size_t{map.width} * map.height);
  map_ = map;
  map_.costs = costs_.data();
  for (const Obstacle& obstacle : obstacles)
    if (is_moving(obstacle)) rebuild(obstacle, obstacles);
  return map_;
}

void StillCostmap::rebuild(const Obstacle& agent, const std::vector<Obstacle>& obstacles) {
  const double reach_m = agent.radius_m + map_.inflation_radius_m + map_.resolution_m;
  beside_.clear();
  for (const Obstacle& other : obstacles) {
    const double apart_m = toolkit::distance(agent.center, other.center) - other.reach_m - other.radius_m;
    if (!is_moving(other) && apart_m < reach_m + map_.inflation_radius_m) beside_.push_back(&other);
  }
  const CostmapView view(map_);
  Footprint point{};  // a disc without radius
  const std::int32_t first_column = std::max(0, view.column_of(agent.center.x - reach_m));
  const std::int32_t last_column = std::min(view.width() - 1, view.column_of(agent.center.x + reach_m));
  const std::int32_t first_row = std::max(0, view.row_of(agent.center.y - reach_m));
  const std::int32_t last_row = std::min(view.height() - 1, view.row_of(agent.center.y + reach_m));
  for (std::int32_t row = first_row; row <= last_row; ++row) {
    for (std::int32_t column = first_column; column <= last_column; ++column) {
      std::uint8_t& cost = costs_[static_cast<std::size_t>(row * view.width() + column)];
      const Vec2 at = view.center(column, row);
      if (cost == DMRP_COST_FREE || toolkit::distance(at, agent.center) > reach_m) continue;
      double nearest_m = std::numeric_limits<double>::infinity();
      for (const Obstacle* other : beside_)
        nearest_m = std::min(nearest_m, separation(point, {at.x, at.y, 0.0}, *other, 0.0).distance_m);
      cost = std::min(cost, cost_at(map_, nearest_m));
    }
  }
}

}  // namespace dmrp::controllers::mppi
