// SPDX-License-Identifier: MIT
// world_view.hpp: a dmrp_world and the data that it points to.
#pragma once

#include <dmrp/world.h>

#include <cstdint>
#include <memory>

#include "core/scene/planning_grid.hpp"
#include "core/scene/robot_types.hpp"
#include "core/scene/scenario.hpp"
#include "core/scene/settings.hpp"
#include "core/scene/static_geometry.hpp"

namespace dmrp::core {

// Owns all data that its dmrp_world points to. All instances of a trial share one.
class WorldView {
 public:
  WorldView(const Scenario& scenario, const RobotTypes& types, const SimulationSettings& simulation,
            const StaticGeometry& geometry, const PlanningGrid& planning_grid, std::int64_t call_budget_ns);
  ~WorldView();
  WorldView(WorldView&&) noexcept;

  const dmrp_world& world() const;

 private:
  struct Storage;
  std::unique_ptr<Storage> storage_;
};

}  // namespace dmrp::core
