// SPDX-License-Identifier: MIT
// variant_world.hpp: what all trials of a scenario variant share: its static geometry, grids and the contract's view.
// Where robots are drawn, each trial has one of its own.
#pragma once

#include <memory>

#include "core/people/flow_routes.hpp"
#include "core/scene/planning_grid.hpp"
#include "core/scene/settings.hpp"
#include "core/scene/static_geometry.hpp"
#include "core/scene/world_view.hpp"
#include "host/experiment/experiment.hpp"

namespace dmrp::host {

struct VariantWorld {
  // Without the robots that are drawn.
  VariantWorld(const Experiment& experiment, const ScenarioVariant& variant);

  // With the robots that are drawn for the trial of this seed (world_seed()).
  VariantWorld(const Experiment& experiment, const ScenarioVariant& variant, const VariantWorld& shared,
               std::uint64_t seed);

  core::Scenario scenario;
  core::SimulationSettings simulation;  // with the time limit that holds for this scenario
  std::shared_ptr<const core::StaticGeometry> geometry;
  core::PlanningGrid planning_grid;
  core::PlanningGrid walking_grid;
  core::FlowRoutes routes;  // of the people
  core::WorldView view;
};

// Whether every trial of the variant is set in a world of its own.
inline bool is_drawn(const ScenarioVariant& variant) {
  return variant.most_drawn > 0;
}

// A number of seconds from the experiment file, as the contract counts them.
inline std::int64_t nanoseconds(double seconds) {
  return static_cast<std::int64_t>(seconds * 1e9 + 0.5);
}

}  // namespace dmrp::host
