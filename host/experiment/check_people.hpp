// SPDX-License-Identifier: MIT
// check_people.hpp: checks the flows and recordings of a scenario against its walls.
#pragma once

#include <memory>

#include "core/people/flow_routes.hpp"
#include "core/scene/planning_grids.hpp"
#include "core/scene/static_geometry.hpp"
#include "host/experiment/check_worlds.hpp"
#include "host/experiment/experiment.hpp"
#include "host/scenario/read_scenario.hpp"

namespace dmrp::host {

// Checks that people can walk along their flows, that there is room for all at t = 0 in every repetition, and that
// recorded people keep out of shapes, walk no faster than people do, and not where a robot starts. `drawn`: robots with
// random tasks on the grids `planning`. Sets `routes` if people walk, and finds them only if they are not set.
// A mistake is an InputError at its place in the file, a doubt a warning in the experiment.
void check_people(const ScenarioFile& file, const core::RobotTypes& types,
                  const std::shared_ptr<const core::StaticGeometry>& geometry, const core::PlanningGrids& planning,
                  const RandomRobots& drawn, Experiment& experiment, std::shared_ptr<const core::FlowRoutes>& routes);

}  // namespace dmrp::host
