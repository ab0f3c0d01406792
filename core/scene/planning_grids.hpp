// SPDX-License-Identifier: MIT
// planning_grids.hpp: the planning grids of a scenario, one for each type of robot.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/planning_grid.hpp"
#include "core/scene/random_tasks.hpp"
#include "core/scene/robot_types.hpp"

namespace dmrp::core {

// A robot as planners see it (SimulationSettings::planning_body).
RobotSettings planning_body_of(const RobotSettings& type, const SimulationSettings& simulation);

// The clearance that its circle's centre needs on a planning cell.
double planning_clearance_m(const RobotSettings& type, const SimulationSettings& simulation);

PlanningGrid build_planning_grid(const StaticGeometry& geometry, const RobotSettings& type,
                                 const SimulationSettings& simulation);

// The grids have the same cells; they differ in which cells are free and which edges are open.
class PlanningGrids {
 public:
  PlanningGrids(const StaticGeometry& geometry, const RobotTypes& types, const SimulationSettings& simulation);

  const PlanningGrid& standard() const { return grids_[0]; }  // of the default type
  const PlanningGrid& of(std::string_view type) const;        // "": the default type

  // The cells and edges that are open for all of these types; no type: the default type's.
  PlanningGrid common(std::span<const std::string> types) const;

  // Random tasks for robots whose types have these shares (random_tasks.hpp), on cells that are free for all of them.
  std::vector<RobotTask> draw(std::span<const TypeShare> shares, std::size_t count, std::uint64_t seed,
                              std::span<const dmrp_vec2> inside, TaskLack* lack = nullptr) const;

 private:
  std::size_t index_of(std::string_view type) const;

  std::vector<std::string> types_;
  std::vector<double> radii_m_;
  std::vector<PlanningGrid> grids_;
};

}  // namespace dmrp::core
