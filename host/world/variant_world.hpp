// SPDX-License-Identifier: MIT
// variant_world.hpp: the data that all trials of a scenario variant share: static geometry, grids, the contract's view.
// If the variant draws robots at random, each trial has its own.
#pragma once

#include <memory>
#include <optional>

#include "core/people/flow_routes.hpp"
#include "core/scene/planning_grids.hpp"
#include "core/scene/settings.hpp"
#include "core/scene/static_geometry.hpp"
#include "core/scene/world_view.hpp"
#include "host/experiment/experiment.hpp"
#include "host/world/walking_grids.hpp"

namespace dmrp::host {

struct VariantWorld {
  // Without random robots.
  VariantWorld(const Experiment& experiment, const ScenarioVariant& variant);

  // With the robots that this task_seed() draws or displaces.
  VariantWorld(const Experiment& experiment, const ScenarioVariant& variant, const VariantWorld& shared,
               std::uint64_t seed);

  // The world that all trials of the variant have in common, without robots of one trial: this one, where none are drawn.
  const VariantWorld& shared() const { return shared_ ? *shared_ : *this; }

 private:
  const VariantWorld* shared_ = nullptr;

 public:
  core::Scenario scenario;
  core::SimulationSettings simulation;  // with the time limit of this scenario
  std::shared_ptr<const core::StaticGeometry> geometry;
  core::RobotTypes types;
  std::shared_ptr<const core::PlanningGrids> planning_grids;
  core::PlanningGrid planning_grid;  // free and open for all robots
  std::shared_ptr<WalkingGrids> walking_grids;
  core::FlowRoutes routes;  // of the people
  core::WorldView view;
  std::optional<core::WorldView> point_view;  // with the bodies that planners plan for, if these are points

  // Gives the world as plugins of a kind see it.
  const dmrp_world& world_for(std::uint32_t kind) const {
    return kind == DMRP_KIND_GLOBAL_PLANNER && point_view ? point_view->world() : view.world();
  }

  // Whether a planning body of this radius keeps clear of walls on its way.
  bool sweep_is_free(dmrp_vec2 from, dmrp_vec2 to, double radius_m) const;
};

// 16 hexadecimal digits that tell the starts and goals of a scenario's robots from others. "" without robots.
std::string task_hash(const core::Scenario& scenario);

// Seconds of the experiment file, in the contract's unit.
inline std::int64_t nanoseconds(double seconds) {
  return static_cast<std::int64_t>(seconds * 1e9 + 0.5);
}

}  // namespace dmrp::host
