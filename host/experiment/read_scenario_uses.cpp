// SPDX-License-Identifier: MIT
#include "host/experiment/read_scenario_uses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "host/files/read_file.hpp"
#include "host/scenario/find_scenario.hpp"
#include "host/scenario/robot_tables.hpp"
#include "host/toml/nearest_name.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t max_robots = 10'000;

// A number of robots that a [[scenario]] asks for.
struct RobotCount {
  std::size_t robots;
  bool drawn;       // their tasks are random
  bool all_drawn;   // tasks = "drawn": so are those of all other numbers
  TomlValue value;  // its place in the file
};

[[noreturn]] void fail_missing(const TomlValue& use) {
  const std::string name = use.text();
  if (name.find('/') != std::string::npos || name.ends_with(".toml"))
    use.fail(fmt::format("no scenario '{}' (there is no such file beside the experiment file)", name));
  const char* path = std::getenv("DMRP_SCENARIO_PATH");
  const std::string folders =
      path && *path ? std::string("DMRP_SCENARIO_PATH is ") + path : "DMRP_SCENARIO_PATH is empty";
  use.fail(fmt::format("no scenario '{}' (shipped: {}; {}){}", name, join_names(shipped_scenarios()), folders,
                       did_you_mean(name, known_scenarios())));
}

std::vector<RobotCount> robot_counts(const TomlTable& table, const TomlValue& use, const core::Scenario& scenario) {
  const std::size_t listed = scenario.robots.size();
  const bool people = core::person_count(scenario) > 0;
  const auto value = table.find("robots");
  const auto tasks = table.find("tasks");
  const std::string from = tasks ? tasks->choice({"listed", "drawn"}) : "";
  if (from == "drawn" && !value) tasks->fail_at_key("'tasks' = 'drawn' needs 'robots', their number");
  if (!value && listed == 0 && !people)
    use.fail(fmt::format("scenario '{}' lists neither robots nor people", scenario.name));
  if (!value) return {{listed, false, false, use}};
  std::vector<RobotCount> counts;
  for (const TomlValue& count : value->is_array() ? value->array() : std::vector<TomlValue>{*value}) {
    const auto robots = static_cast<std::size_t>(count.integer(0, max_robots));
    if (robots == 0 && !people)
      count.fail(fmt::format("'robots' must be at least 1: scenario '{}' has no people", scenario.name));
    if (robots > listed && from == "listed")
      count.fail(fmt::format("scenario '{}' lists {} robot{}, not {} ('tasks' = 'drawn' draws them)", scenario.name,
                             listed, listed == 1 ? "" : "s", robots));
    const bool drawn = robots > 0 && (robots > listed || from == "drawn");
    counts.push_back({robots, drawn, from == "drawn", count});
  }
  if (counts.empty()) value->fail("'robots' must have at least one number");
  return counts;
}

// Keeps the first `count` listed robots. The others take no part, but people keep clear of their starts.
void keep_listed(core::Scenario& scenario, std::size_t count) {
  for (std::size_t i = count; i < scenario.robots.size(); ++i)
    scenario.other_starts.push_back({scenario.robots[i].start.x, scenario.robots[i].start.y});
  scenario.robots.resize(count);
}

void add_variant(const ScenarioUse& use, const fs::path& file, const RobotCount& count, std::size_t entry,
                 Experiment& experiment) {
  ScenarioVariant variant;
  variant.scenario = use.file.scenario;
  const std::size_t listed = variant.scenario.robots.size();
  keep_listed(variant.scenario, count.drawn ? 0 : count.robots);
  variant.label = variant.scenario.name;
  if (count.robots != listed || count.drawn) variant.label += fmt::format("/{}", count.robots);
  variant.file = file;
  variant.files = use.file.files;
  variant.drawn_robots = static_cast<std::uint32_t>(count.drawn ? count.robots : 0);
  variant.most_drawn = static_cast<std::uint32_t>(use.random.most);
  variant.entry = static_cast<std::uint32_t>(entry);
  variant.all_drawn = count.all_drawn;
  for (const ScenarioVariant& other : experiment.scenarios)
    if (other.scenario.name == variant.scenario.name && robot_count(other) == count.robots)
      count.value.fail(fmt::format("scenario '{}' occurs twice", variant.label));
  experiment.scenarios.push_back(std::move(variant));
}

std::vector<core::TypeShare> read_shares(const TomlValue& value, const core::RobotTypes& types) {
  std::vector<core::TypeShare> shares;
  for (const TomlValue& entry : value.table().entries()) {
    const std::string name = entry.key() == default_type_name ? "" : entry.key();
    if (!types.find(name)) fail_unknown_type(entry, types);
    entry.positive();
    shares.push_back({name, entry.number(0.0, 1e6)});
  }
  if (shares.empty()) value.fail("'types' must have at least one type and its share");
  return shares;
}

}  // namespace

std::vector<ScenarioUse> read_scenario_uses(const TomlTable& root, Experiment& experiment) {
  std::vector<ScenarioUse> uses;
  for (const TomlTable& table : root.tables("scenario")) {
    table.allow_only(scenario_use_keys);
    const TomlValue name = table.need("use");
    const fs::path file = find_scenario(name.text(), experiment.file.parent_path());
    if (file.empty()) fail_missing(name);
    ScenarioUse use = {name, read_scenario_file(file, shown(file)), {}, table.find("types")};
    const std::vector<RobotCount> counts = robot_counts(table, name, use.file.scenario);
    std::size_t most_listed = 0;
    for (const RobotCount& count : counts) {
      if (count.drawn && count.robots > use.random.most) use.random = {count.robots, count.value};
      if (!count.drawn) most_listed = std::max(most_listed, count.robots);
    }
    for (const RobotCount& count : counts) add_variant(use, file, count, uses.size(), experiment);
    keep_listed(use.file.scenario, most_listed);
    uses.push_back(std::move(use));
  }
  return uses;
}

void resolve_robot_types(ScenarioUse& use, std::size_t entry, Experiment& experiment) {
  use.robot_types = robot_types_of(use.file, experiment.robot, experiment.robot_types);
  if (use.types) use.random.types = read_shares(*use.types, use.robot_types);
  if (use.types && use.random.most == 0) use.types->fail_at_key("'types' are those of drawn robots; none are drawn");
  for (ScenarioVariant& variant : experiment.scenarios)
    if (variant.entry == entry) {
      variant.types = use.robot_types;
      variant.drawn_types = use.random.types;
    }
}

}  // namespace dmrp::host
