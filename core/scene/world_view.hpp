// SPDX-License-Identifier: MIT
// world_view.hpp: a dmrp_world and the data that it points to.
#pragma once

#include <dmrp/world.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/planning_grid.hpp"
#include "core/scene/scenario.hpp"
#include "core/scene/settings.hpp"
#include "core/scene/static_geometry.hpp"

namespace dmrp::core {

// Owns all data that its dmrp_world points to.
class WorldView {
 public:
  WorldView(const Scenario& scenario, const RobotSettings& robot, const SimulationSettings& simulation,
            const StaticGeometry& geometry, const PlanningGrid& planning_grid, const PlanningGrid& walking_grid,
            std::int64_t call_budget_ns);

  // A deep copy of a world with any strides.
  explicit WorldView(const dmrp_world& world);

  ~WorldView();
  WorldView(WorldView&&) noexcept;
  WorldView& operator=(WorldView&&) noexcept;

  // The world for plugins other than local controllers (self = -1).
  const dmrp_world& world() const;

  // The world for the controller of one robot. Points into this view's storage.
  dmrp_world seen_by(std::int32_t robot) const;

 private:
  struct Storage;
  std::unique_ptr<Storage> storage_;
};

}  // namespace dmrp::core
