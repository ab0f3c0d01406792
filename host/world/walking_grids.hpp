// SPDX-License-Identifier: MIT
// walking_grids.hpp: dmrp.walking_grid/1: the grids of one world that plugins asked for.
#pragma once

#include <dmrp/ext/walking_grid.h>
#include <dmrp/world.h>

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "core/scene/planning_grid.hpp"
#include "core/scene/static_geometry.hpp"
#include "host/plugins/calls/call_guard.hpp"

namespace dmrp::host {

// Keeps every grid: all trials and instances of a world share them. For one thread.
class WalkingGrids {
 public:
  explicit WalkingGrids(std::shared_ptr<const core::StaticGeometry> geometry);

  // Of a stored trace's world, which outlives this object.
  explicit WalkingGrids(const dmrp_world& world);

  WalkingGrids(const WalkingGrids&) = delete;
  WalkingGrids& operator=(const WalkingGrids&) = delete;

  // Computed by the first request. nullptr for a request out of range.
  const core::PlanningGrid* find(double resolution_m, double radius_m);

  // For plugins that `guard` calls: it refuses requests that break the contract.
  const dmrp_walking_grid* extension(CallGuard* guard = nullptr) {
    guard_ = guard;
    return &extension_;
  }

  // A grid, and what it is asked for by.
  struct Known {
    double resolution_m;
    double radius_m;
    dmrp_grid view;
  };

  // All grids so far.
  std::vector<Known> known() const;

  // Takes a grid over that somebody else has computed, and whose arrays outlive this object.
  void add(const Known& known);

 private:
  struct Grid {
    core::PlanningGrid grid;
    dmrp_grid view{};
  };
  Grid* grid(double resolution_m, double radius_m);

  const dmrp_world* world_ = nullptr;
  std::shared_ptr<const core::StaticGeometry> geometry_;  // of world_ by the first request
  std::map<std::pair<double, double>, std::unique_ptr<Grid>> grids_;
  dmrp_walking_grid extension_{};
  CallGuard* guard_ = nullptr;
};

}  // namespace dmrp::host
