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

// The grids have the same cells; they differ in which cells are free and which edges are open.
class PlanningGrids {
 public:
  PlanningGrids(const StaticGeometry& geometry, const RobotTypes& types, double resolution_m, double margin_m);

  const PlanningGrid& standard() const { return grids_[0]; }  // of the default type
  const PlanningGrid& of(std::string_view type) const;        // "": the default type

  // The cells and edges that are open for all of these types; no type: the default type's.
  PlanningGrid common(std::span<const std::string> types) const;

  // Random tasks for robots whose types have these shares (random_tasks.hpp), on cells that are free for all of them.
  std::vector<RobotTask> draw(std::span<const TypeShare> shares, std::size_t count, std::uint64_t seed,
                              std::span<const dmrp_vec2> inside) const;

 private:
  std::size_t index_of(std::string_view type) const;

  std::vector<std::string> types_;
  std::vector<double> radii_m_;
  std::vector<PlanningGrid> grids_;
};

}  // namespace dmrp::core
