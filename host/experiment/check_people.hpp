// SPDX-License-Identifier: MIT
// check_people.hpp: checks the flows and recordings of a scenario against its walls.
#pragma once

#include <cstddef>
#include <memory>

#include "core/scene/planning_grid.hpp"
#include "core/scene/static_geometry.hpp"
#include "host/experiment/experiment.hpp"
#include "host/scenario/read_scenario.hpp"

namespace dmrp::host {

// Checks that people can walk along their flows, that there is room for all at t = 0 in every repetition, and that
// recorded people keep out of shapes. `most_drawn`: the largest number of robots with random tasks on the grid
// `planning`. A mistake is an InputError at its place in the file, a doubt a warning in the experiment.
void check_people(const ScenarioFile& file, const std::shared_ptr<const core::StaticGeometry>& geometry,
                  const core::PlanningGrid& planning, std::size_t most_drawn, Experiment& experiment);

}  // namespace dmrp::host
