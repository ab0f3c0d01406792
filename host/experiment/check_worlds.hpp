// SPDX-License-Identifier: MIT
// check_worlds.hpp: checks that the robots and people of a scenario can follow their tasks and flows.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/people/flow_routes.hpp"
#include "core/tasks/task_generator.hpp"
#include "host/experiment/experiment.hpp"
#include "host/scenario/read_scenario.hpp"

namespace dmrp::host {

// The robots with random tasks of a scenario.
struct RandomRobots {
  std::size_t most = 0;           // the largest number in the experiment
  std::optional<TomlValue> at{};  // its place in the experiment file, if most > 0
  std::vector<core::TypeShare> types{};
  core::TaskWishes wishes{};
};

// The rule by which there is no room for another random task: "starts must be more than 2 m apart".
std::string lacking_rule(const core::DrawnTasks& drawn);

core::TaskRequest request_of(const RandomRobots& drawn, const core::Scenario& scenario);

// Checks starts, goals and flows against the walls and the robots of these types, and that every repetition has room for
// the random tasks. A mistake is an InputError at its place in the file, a doubt a warning in the experiment. `root`: of
// the experiment file, if there is one: a footprint that it makes too large for the world is a mistake of its own.
// Returns the routes of the flows if people walk: `routes`, if these are given.
std::shared_ptr<const core::FlowRoutes> check_world(const ScenarioFile& file, const core::RobotTypes& types,
                                                    Experiment& experiment, const RandomRobots& drawn = {},
                                                    const TomlTable* root = nullptr,
                                                    std::shared_ptr<const core::FlowRoutes> routes = nullptr);

}  // namespace dmrp::host
