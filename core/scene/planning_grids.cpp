// SPDX-License-Identifier: MIT
#include "core/scene/planning_grids.hpp"

#include <algorithm>

#include "core/scene/footprint_grid.hpp"

namespace dmrp::core {

PlanningGrids::PlanningGrids(const StaticGeometry& geometry, const RobotTypes& types, double resolution_m,
                             double margin_m) {
  for (const RobotSettings& type : types.all()) {
    types_.push_back(type.type);
    radii_m_.push_back(type.radius_m);
    grids_.push_back(build_planning_grid(geometry, resolution_m, type, margin_m));
  }
}

const PlanningGrid& PlanningGrids::of(std::string_view type) const {
  return grids_[static_cast<std::size_t>(std::find(types_.begin(), types_.end(), type) - types_.begin())];
}

std::vector<RobotTask> PlanningGrids::draw(std::span<const TypeShare> shares, std::size_t count,
                                           std::uint64_t seed) const {
  if (shares.empty()) return random_tasks(standard(), count, seed);
  std::vector<TypeGrid> drawn;
  for (std::size_t i = 0; i < grids_.size(); ++i)
    if (std::any_of(shares.begin(), shares.end(), [&](const TypeShare& one) { return one.type == types_[i]; }))
      drawn.push_back({types_[i], radii_m_[i], &grids_[i]});
  return random_tasks(drawn, drawn_types(shares, count), seed);
}

}  // namespace dmrp::core
