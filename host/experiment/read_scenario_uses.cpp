// SPDX-License-Identifier: MIT
#include "host/experiment/read_scenario_uses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string_view>
#include <utility>

#include "host/errors/mistakes.hpp"
#include "host/files/read_file.hpp"
#include "host/scenario/find_scenario.hpp"
#include "host/scenario/robot_tables.hpp"
#include "host/toml/nearest_name.hpp"
#include "host/toml/setting.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t max_robots = 10'000;
constexpr std::int64_t max_tasks = 1'000'000;
constexpr double max_people_times = 100.0;
constexpr std::int64_t max_people = 100'000;
constexpr double max_jitter_m = 10.0;
constexpr double max_share = 1e6;
const std::vector<std::string> tasks_choices = {"listed", "drawn"};

// A number of robots that a [[scenario]] asks for.
struct RobotCount {
  std::size_t robots;
  bool drawn;       // their tasks are random
  TomlValue value;  // its place in the file
};

// The key `tasks` of a [[scenario]].
struct TasksKey {
  std::optional<TomlValue> at;
  bool listed = false;
  bool drawn = false;
  core::TaskWishes wishes{};
};

TasksKey read_tasks_key(const TomlTable& scenario) {
  TasksKey out{scenario.find("tasks")};
  if (!out.at) return out;
  if (!out.at->is_table()) {
    out.drawn = out.at->choice(tasks_choices) == "drawn";
    out.listed = !out.drawn;
    return out;
  }
  const TomlTable table = out.at->table();
  table.allow_only({"drawn", "conflicts_min", "conflicts_max", "crossing"});
  const auto number = [&table](const char* key, std::int64_t least, std::uint32_t fallback) {
    const auto value = table.find(key);
    return value ? static_cast<std::uint32_t>(value->integer(least, max_tasks)) : fallback;
  };
  out.drawn = true;
  table.need("drawn");
  out.wishes.drawn = number("drawn", 1, 1);
  out.wishes.conflicts_min = number("conflicts_min", 0, 0);
  out.wishes.conflicts_max = number("conflicts_max", 0, core::any_number);
  if (out.wishes.conflicts_max < out.wishes.conflicts_min)
    table.need("conflicts_max")
        .fail(fmt::format("'conflicts_max' must be at least 'conflicts_min', {}", out.wishes.conflicts_min));
  if (const auto crossing = table.find("crossing"); crossing && crossing->choice({"any", "corridor"}) == "corridor")
    out.wishes.crossing = core::Crossing::corridor;
  return out;
}

[[noreturn]] void fail_missing(const TomlValue& use) {
  const std::string name = use.text();
  if (name.find('/') != std::string::npos || name.ends_with(".toml") || is_map_file(name))
    use.fail(fmt::format("no scenario '{}' (there is no such file beside the experiment file)", name));
  const char* path = std::getenv("DMRP_SCENARIO_PATH");
  const std::string folders =
      path && *path ? std::string("DMRP_SCENARIO_PATH is ") + path : "DMRP_SCENARIO_PATH is empty";
  use.fail(fmt::format("no scenario '{}'{} (shipped: {}; {})", name, did_you_mean(name, known_scenarios()),
                       join_names(shipped_scenarios()), folders));
}

// If one number goes beyond the listed robots, the tasks of all numbers are drawn: else a row of numbers would compare
// other tasks.
std::vector<RobotCount> robot_counts(const TomlTable& table, const TomlValue& use, const core::Scenario& scenario,
                                     const TasksKey& tasks) {
  const std::size_t listed = scenario.robots.size();
  const bool people = core::person_count(scenario) > 0;
  const auto value = table.find("robots");
  if (tasks.drawn && !value) tasks.at->fail_at_key("'tasks' that are drawn need 'robots', their number");
  if (!value && listed == 0 && !people)
    use.fail(fmt::format("scenario '{}' lists neither robots nor people", scenario.name));
  if (!value) return {{listed, false, use}};
  std::vector<RobotCount> counts;
  bool drawn = tasks.drawn;
  for (const TomlValue& count : value->is_array() ? value->array() : std::vector<TomlValue>{*value}) {
    const auto robots = static_cast<std::size_t>(count.integer(0, max_robots));
    if (robots == 0 && !people)
      count.fail(fmt::format("'robots' must be at least 1: scenario '{}' has no people", scenario.name));
    if (robots > listed && tasks.listed)
      count.fail(fmt::format("scenario '{}' lists {} robot{}, not {} ('tasks' = 'drawn' draws them)", scenario.name,
                             listed, listed == 1 ? "" : "s", robots));
    drawn = drawn || robots > listed;
    counts.push_back({robots, false, count});
  }
  for (RobotCount& count : counts) count.drawn = drawn && count.robots > 0;
  if (counts.empty()) value->fail("'robots' must have at least one number");
  return counts;
}

// A list of numbers whose first ones could have been listed.
void warn_of_drawn_list(const std::vector<RobotCount>& counts, const TasksKey& tasks, const core::Scenario& scenario,
                        Experiment& experiment) {
  if (tasks.drawn) return;
  const auto could_be_listed = [&](const RobotCount& count) {
    return count.drawn && count.robots <= scenario.robots.size();
  };
  if (std::any_of(counts.begin(), counts.end(), could_be_listed))
    experiment.warnings.push_back(
        counts.front().value.place() +
        fmt::format(": 'robots' goes beyond the {} that scenario '{}' lists: the tasks of all numbers are drawn",
                    scenario.robots.size(), scenario.name));
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
  variant.wishes = use.random.wishes;
  variant.grade = use.file.grade;
  variant.jitter = use.jitter;
  variant.people = use.people;
  variant.census = use.file.census;
  if (use.people.listed) variant.swept.push_back({"", use.people.key, fmt::format("{}", use.people.value)});
  for (const ScenarioVariant& other : experiment.scenarios)
    if (result_name(other) == result_name(variant) && robot_count(other) == count.robots)
      count.value.fail(fmt::format("scenario '{}' occurs twice", with_swept(variant.label, variant.swept)));
  experiment.scenarios.push_back(std::move(variant));
}

std::vector<core::TypeShare> read_shares(const TomlValue& value, const core::RobotTypes& types) {
  std::vector<core::TypeShare> shares;
  for (const TomlValue& entry : value.table().entries()) {
    const std::string name = entry.key() == default_type_name ? "" : entry.key();
    if (!types.find(name)) fail_unknown_type(entry, types);
    entry.positive();
    shares.push_back({name, entry.number(0.0, max_share)});
  }
  if (shares.empty()) value.fail("'types' must have at least one type and its share");
  return shares;
}

// The levels that the [[scenario]] asks for, by default all of its file; one without a number for a scenario that has
// none.
std::vector<std::optional<double>> levels_to_run(const TomlTable& table, const fs::path& file) {
  const std::vector<double> known = read_levels(file, shown(file));
  const auto asked = table.find("levels");
  if (known.empty() && asked) asked->fail_at_key("'levels' are those of a scenario with [grade]");
  if (known.empty()) return {std::nullopt};
  if (!asked) return {known.begin(), known.end()};
  std::vector<std::optional<double>> levels;
  for (const TomlValue& level : asked->array()) levels.emplace_back(level.number());
  if (levels.empty()) asked->fail("'levels' must have at least one number");
  return levels;
}

StartJitter read_jitter(const TomlTable& table) {
  StartJitter jitter;
  const auto value = table.find("start_jitter");
  if (!value) return jitter;
  const TomlTable given = value->table();
  given.allow_only({"position_m", "heading_rad"});
  if (const auto position = given.find("position_m")) jitter.position_m = position->number(0.0, max_jitter_m);
  if (const auto heading = given.find("heading_rad")) jitter.heading_rad = heading->number(0.0, std::numbers::pi);
  return jitter;
}

// The changes of the number of people that the [[scenario]] asks for; one without a key if it asks for none.
std::vector<PeopleChange> people_to_run(const TomlTable& table) {
  const auto total = table.find("people");
  const auto times = table.find("people_times");
  if (!total && !times) return {PeopleChange{}};
  if (total && times) times->fail_at_key("'people' and 'people_times' exclude each other");
  const TomlValue& given = total ? *total : *times;
  std::vector<PeopleChange> changes;
  for (const TomlValue& one : given.is_array() ? given.array() : std::vector<TomlValue>{given})
    changes.push_back({total ? "people" : "people_times",
                       total ? static_cast<double>(one.integer(0, max_people)) : one.number(0.0, max_people_times),
                       given.is_array()});
  if (changes.empty()) given.fail(fmt::format("'{}' must have at least one number", given.key()));
  return changes;
}

// So many people in all, in the proportions of the flows, equally if none has people; the largest remainders are rounded
// up.
void share_people(std::uint64_t total, std::vector<core::Flow>& flows) {
  if (std::none_of(flows.begin(), flows.end(), [](const core::Flow& flow) { return flow.people; }))
    for (core::Flow& flow : flows) flow.people = 1;
  std::uint64_t listed = 0;
  for (const core::Flow& flow : flows) listed += flow.people;
  std::vector<std::pair<std::uint64_t, std::size_t>> remainders;
  std::uint64_t left = total;
  for (std::size_t i = 0; i < flows.size(); ++i) {
    remainders.emplace_back(total * flows[i].people % listed, i);
    flows[i].people = static_cast<std::uint32_t>(total * flows[i].people / listed);
    left -= flows[i].people;
  }
  std::stable_sort(remainders.begin(), remainders.end(), [](auto a, auto b) { return a.first > b.first; });
  for (std::size_t i = 0; i < left; ++i) ++flows[remainders[i].second].people;
}

// Groups are at most as large as their flow.
void change_people(const TomlTable& table, const PeopleChange& change, core::Scenario& scenario) {
  if (!change.key) return;
  if (scenario.flows.empty())
    table.need(change.key).fail_at_key(fmt::format("scenario '{}' has no flows of people", scenario.name));
  if (change.key == std::string_view("people"))
    share_people(static_cast<std::uint64_t>(change.value), scenario.flows);
  else
    for (core::Flow& flow : scenario.flows)
      flow.people = static_cast<std::uint32_t>(std::lround(change.value * flow.people));
  for (core::Flow& flow : scenario.flows) flow.group_size = std::max(1U, std::min(flow.group_size, flow.people));
}

// One [[scenario]] at one level, with one number of people.
ScenarioUse read_use(const TomlTable& table, const TomlValue& name, const fs::path& file, std::optional<double> level,
                     const PeopleChange& people, std::size_t entry, Experiment& experiment) {
  ScenarioUse use = {name, {}, {}, table.find("types")};
  TasksKey tasks;
  std::vector<RobotCount> counts;
  Mistakes mistakes;
  mistakes.attempt([&] { use.jitter = read_jitter(table); });
  const bool has_tasks = mistakes.attempt([&] { tasks = read_tasks_key(table); });
  const bool has_file = mistakes.attempt([&] { use.file = read_scenario_file(file, shown(file), level); });
  if (has_file) mistakes.attempt([&] { change_people(table, people, use.file.scenario); });
  if (has_file && has_tasks) mistakes.attempt([&] { counts = robot_counts(table, name, use.file.scenario, tasks); });
  mistakes.end();
  use.people = people;
  experiment.warnings.insert(experiment.warnings.end(), use.file.warnings.begin(), use.file.warnings.end());
  use.random.wishes = tasks.wishes;
  warn_of_drawn_list(counts, tasks, use.file.scenario, experiment);
  std::size_t most_listed = 0;
  for (const RobotCount& count : counts) {
    if (count.drawn && count.robots > use.random.most) {
      use.random.most = count.robots;
      use.random.at = count.value;
    }
    if (!count.drawn) most_listed = std::max(most_listed, count.robots);
  }
  for (const RobotCount& count : counts) add_variant(use, file, count, entry, experiment);
  keep_listed(use.file.scenario, most_listed);
  return use;
}

}  // namespace

std::vector<TomlKey> scenario_use_keys() {
  return {{"use"},
          {"robots", range_text(0, max_robots)},
          {"tasks", fmt::format("{}, or a table: numbers to {}", choices_text(tasks_choices), max_tasks)},
          {"types", "each " + positive_text(max_share)},
          {"levels"},
          {"start_jitter", fmt::format("position_m: {}, heading_rad: {}", range_text(0.0, max_jitter_m),
                                       range_text(0.0, std::numbers::pi))},
          {"people", range_text(0, max_people)},
          {"people_times", range_text(0.0, max_people_times)}};
}

void read_scenario_uses(const TomlTable& root, Experiment& experiment, std::vector<ScenarioUse>& uses) {
  root.read_tables("scenario", [&](const TomlTable& table) {
    Mistakes mistakes;
    mistakes.attempt([&] { table.allow_only_keys(scenario_use_keys()); });
    mistakes.attempt([&] {
      const TomlValue name = table.need("use");
      const fs::path file = find_scenario(name.text(), experiment.file.parent_path());
      if (file.empty()) fail_missing(name);
      for (const std::optional<double> level : levels_to_run(table, file))
        for (const PeopleChange& people : people_to_run(table))
          mistakes.attempt(
              [&] { uses.push_back(read_use(table, name, file, level, people, uses.size(), experiment)); });
    });
    mistakes.end();
  });
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
