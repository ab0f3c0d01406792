// SPDX-License-Identifier: MIT
// scenario_variant.hpp: a scenario with a number of robots, as used by an experiment.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/people/flow_routes.hpp"
#include "core/scene/random_tasks.hpp"
#include "core/scene/robot_types.hpp"
#include "core/scene/scenario.hpp"
#include "core/scene/settings.hpp"
#include "core/tasks/task_generator.hpp"
#include "host/toml/swept_value.hpp"

namespace dmrp::host {

// The level of a test that has several: [grade] of its file.
struct Grade {
  std::string series;    // the name in the file; empty: the scenario has no levels
  std::string quantity;  // "width of the door"
  std::string unit;
  bool harder_when_higher = true;
  double level = 0.0;
};

// What the cells of a map are.
struct MapCensus {
  std::string file;  // its name, without folder
  std::size_t cells = 0;
  std::size_t free = 0;     // known to be
  std::size_t unknown = 0;  // of the rest, which are walls
  bool unknown_is_free = false;
};

// "800 cells: 77 % free, 21 % walls, 2 % unknown (count as walls)"
std::string census_text(const MapCensus& census);

// The largest deviations of a listed robot's start, drawn for each trial.
struct StartJitter {
  double position_m = 0.0;
  double heading_rad = 0.0;
};

// Another number of people than the flows of the file have.
struct PeopleChange {
  const char* key = nullptr;  // of [[scenario]]: "people" or "people_times"; null: none
  double value = 0.0;
  bool listed = false;  // one of a list
};

// A scenario with a number of robots: either the first of the listed ones, or robots with random tasks for each trial.
struct ScenarioVariant {
  core::Scenario scenario;     // with exactly the listed robots that take part
  std::string label;           // the scenario's name; "mall/2" if the number of robots differs from the listed number
  std::filesystem::path file;  // scenario.toml
  std::vector<std::filesystem::path> files{};  // other files that it names: maps, tasks, recordings, tiles
  std::uint32_t drawn_robots = 0;              // robots with random tasks; then no listed robot takes part
  std::uint32_t most_drawn = 0;  // the largest drawn_robots of this [[scenario]]: people keep clear of all their starts
  std::uint32_t entry = 0;       // index of the [[scenario]]
  core::RobotTypes types{};      // that its robots can have
  std::vector<core::TypeShare> drawn_types{};  // of the drawn robots; none: all of the default type
  core::TaskWishes wishes{};                   // for the drawn tasks
  Grade grade{};
  StartJitter jitter{};
  PeopleChange people{};              // applied
  std::optional<MapCensus> census{};  // if it has a [map]
  std::vector<SweptValue> swept{};
  std::shared_ptr<const core::FlowRoutes> routes{};      // if people walk, and its world has been checked
  std::optional<core::SimulationSettings> simulation{};  // if [simulation] has a sweep: in place of the experiment's
};

// Its name in results, with swept values.
inline std::string result_name(const ScenarioVariant& variant) {
  return with_swept(variant.scenario.name, variant.swept);
}

// Whether each trial has robots of its own.
inline bool is_drawn(const ScenarioVariant& variant) {
  return variant.most_drawn > 0 || variant.jitter.position_m > 0.0 || variant.jitter.heading_rad > 0.0;
}

inline std::uint32_t robot_count(const ScenarioVariant& variant) {
  return variant.drawn_robots + static_cast<std::uint32_t>(variant.scenario.robots.size());
}

// What to draw for a trial: tasks for the variant with the most robots of this [[scenario]].
core::TaskRequest task_request(const ScenarioVariant& variant);

// The names of the types of its robots, each once.
std::vector<std::string> types_in_use(const ScenarioVariant& variant);

}  // namespace dmrp::host
