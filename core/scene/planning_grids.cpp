// SPDX-License-Identifier: MIT
#include "core/scene/planning_grids.hpp"

#include <algorithm>
#include <cassert>

#include "core/scene/footprint_grid.hpp"

namespace dmrp::core {

RobotSettings planning_body_of(const RobotSettings& type, const SimulationSettings& simulation) {
  RobotSettings body = type;
  if (simulation.planning_body == PlanningBody::footprint) return body;
  body.radius_m = 0.0;
  body.parts.clear();
  return body;
}

double planning_clearance_m(const RobotSettings& type, const SimulationSettings& simulation) {
  return planning_body_of(type, simulation).radius_m + simulation.planning_margin_m;
}

PlanningGrid build_planning_grid(const StaticGeometry& geometry, const RobotSettings& type,
                                 const SimulationSettings& simulation) {
  const double cell_m = simulation.grid_resolution_m;
  if (simulation.planning_body == PlanningBody::footprint)
    return build_planning_grid(geometry, cell_m, type, simulation.planning_margin_m);
  return build_planning_grid(geometry, cell_m, simulation.planning_margin_m, 0.0);
}

PlanningGrids::PlanningGrids(const StaticGeometry& geometry, const RobotTypes& types,
                             const SimulationSettings& simulation) {
  for (const RobotSettings& type : types.all()) {
    types_.push_back(type.type);
    radii_m_.push_back(type.radius_m);
    grids_.push_back(build_planning_grid(geometry, type, simulation));
  }
}

std::size_t PlanningGrids::index_of(std::string_view type) const {
  return static_cast<std::size_t>(std::find(types_.begin(), types_.end(), type) - types_.begin());
}

const PlanningGrid& PlanningGrids::of(std::string_view type) const {
  assert(index_of(type) < grids_.size());
  return grids_[index_of(type)];
}

PlanningGrid PlanningGrids::common(std::span<const std::string> types) const {
  PlanningGrid grid = types.empty() ? standard() : of(types.front());
  for (const std::string& type : types) {
    const PlanningGrid& other = of(type);
    for (std::size_t cell = 0; cell < grid.free.size(); ++cell) {
      grid.free[cell] = grid.free[cell] && other.free[cell];
      grid.edges[cell] &= other.edges[cell];
    }
  }
  return grid;
}

std::vector<RobotTask> PlanningGrids::draw(std::span<const TypeShare> shares, std::size_t count, std::uint64_t seed,
                                           std::span<const dmrp_vec2> inside, TaskLack* lack) const {
  if (shares.empty()) return random_tasks(standard(), count, seed, inside, lack);
  std::vector<std::string> types;
  for (const TypeShare& one : shares) types.push_back(one.type);
  const PlanningGrid grid = common(types);
  std::vector<TypeGrid> drawn;
  for (const std::string& type : types) drawn.push_back({type, radii_m_[index_of(type)], &grid});
  return random_tasks(drawn, drawn_types(shares, count), seed, inside, lack);
}

}  // namespace dmrp::core
