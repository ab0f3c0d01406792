// SPDX-License-Identifier: MIT
#include "host/scenario/read_scenario.hpp"

#include <fmt/format.h>

#include "host/errors/mistakes.hpp"
#include "host/files/read_file.hpp"
#include "host/scenario/find_scenario.hpp"
#include "host/scenario/read_crowd.hpp"
#include "host/scenario/read_map.hpp"
#include "host/scenario/read_recordings.hpp"
#include "host/scenario/read_shapes.hpp"
#include "host/scenario/read_tiles.hpp"
#include "host/scenario/robot_tables.hpp"
#include "host/scenario/scenario_values.hpp"
#include "host/toml/setting.hpp"
#include "host/toml/toml_text.hpp"

namespace dmrp::host {

namespace {

const std::vector<TomlKey> scenario_root_keys = {{"scenario"}, {"map"},       {"box"},        {"circle"}, {"polygon"},
                                                 {"robot"},    {"robots"},    {"people"},     {"region"}, {"flow"},
                                                 {"tiles"},    {"recording"}, {"robot_type"}, {"grade"}};
const std::vector<std::string> harder_choices = {"higher", "lower"};

std::vector<TomlKey> scenario_header_keys() {
  return {{"name"},
          {"title"},
          {"description"},
          {"size_m", "each " + positive_text(max_side_m)},
          {"origin_m", point_range()},
          {"inside_m", point_range()},
          {"time_limit_s", positive_text(max_time_s)}};
}

std::vector<TomlKey> robot_keys() {
  return {{"name"}, {"type"}, {"start", pose_range()}, {"goal", pose_range()}, {"goals", pose_range()}};
}

std::vector<TomlKey> grade_keys() {
  return {{"quantity"}, {"unit"}, {"harder", choices_text(harder_choices)}, {"levels"}, {"robots", "at least 1"}};
}

std::vector<double> levels_of(const TomlTable& grade) {
  std::vector<double> levels;
  const TomlValue listed = grade.need("levels");
  for (const TomlValue& level : listed.array()) levels.push_back(level.number());
  if (levels.empty()) listed.fail("'levels' must have at least one number");
  return levels;
}

// The scenario's name gets the level, so that results tell levels apart.
void read_grade(const TomlTable& grade, double level, ScenarioFile& out) {
  out.grade = {out.scenario.name, grade.need("quantity").line(), grade.need("unit").line(),
               grade.need("harder").choice(harder_choices) == "higher", level};
  out.scenario.name += fmt::format(" {}", level);
}

// The number of listed robots that take part at this level.
void keep_graded(const TomlTable& grade, ScenarioFile& out) {
  const auto robots = grade.find("robots");
  if (!robots) return;
  const auto count = robots->integer(1, static_cast<std::int64_t>(out.scenario.robots.size()));
  out.scenario.robots.resize(static_cast<std::size_t>(count));
  out.robots.resize(static_cast<std::size_t>(count));
}

std::vector<dmrp_pose> read_goals(const TomlTable& robot) {
  const auto goals = robot.find("goals");
  const auto goal = robot.find("goal");
  if (goals && goal) goal->fail_at_key("a robot has either 'goal' or 'goals'");
  if (!goals) return {pose(robot.need("goal"))};
  std::vector<dmrp_pose> out;
  for (const TomlValue& element : goals->array()) out.push_back(pose(element));
  if (out.empty()) goals->fail("'goals' must have at least one");
  return out;
}

void read_robots(const TomlTable& root, ScenarioFile& out) {
  std::vector<std::string> names;
  root.read_tables("robot", [&](const TomlTable& table) {
    core::RobotTask task;
    task.name = fmt::format("robot {}", out.scenario.robots.size());
    Mistakes mistakes;
    mistakes.attempt([&] { table.allow_only_keys(robot_keys()); });
    mistakes.attempt([&] {
      const auto name = table.find("name");
      if (!name) return;
      task.name = name->line();
      refuse_twice(*name, "robots", names);
    });
    mistakes.attempt([&] {
      if (const auto type = table.find("type")) task.type = type->line();
    });
    mistakes.attempt([&] { task.start = pose(table.need("start")); });
    mistakes.attempt([&] { task.goals = read_goals(table); });
    mistakes.end();
    names.push_back(task.name);
    out.scenario.robots.push_back(std::move(task));
    out.robots.push_back(table.position());
  });
}

// The name defaults to that of the folder or file, and the title to the name.
void read_names(const TomlTable& header, const std::filesystem::path& file, core::Scenario& scenario) {
  const bool has_folder = file.filename() == "scenario.toml";
  const std::string own = has_folder ? file.parent_path().filename().string() : file.stem().string();
  const auto name = header.find("name");
  scenario.name = name ? name->line() : own;
  if (has_folder && scenario.name != own)
    name->fail(fmt::format("'name' must be that of the folder, '{}', not '{}'", own, scenario.name));
  const auto title = header.find("title");
  scenario.title = title ? title->line() : scenario.name;
  if (const auto description = header.find("description")) scenario.description = description->line();
}

void read_extent(const TomlTable& root, const TomlTable& header, ScenarioFile& out) {
  core::Scenario& scenario = out.scenario;
  if (const auto origin = header.find("origin_m")) scenario.lower = point(*origin);
  const bool tiled = root.find("tiles").has_value();
  if (tiled || root.find("map")) {
    if (const auto size_value = header.find("size_m"))
      size_value->fail_at_key(
          fmt::format("a scenario has either 'size_m' or {}, which gives its size", tiled ? "[tiles]" : "a [map]"));
    return;
  }
  const TomlValue size_value = header.need("size_m");
  const dmrp_vec2 extent = size(size_value);
  if (extent.x > max_side_m || extent.y > max_side_m)
    size_value.fail(fmt::format("'size_m' must be at most [{0}, {0}]", max_side_m));
  scenario.upper = {scenario.lower.x + extent.x, scenario.lower.y + extent.y};
  out.size = size_value.position();
}

void read_header(const TomlTable& root, const std::filesystem::path& file, ScenarioFile& out) {
  core::Scenario& scenario = out.scenario;
  const TomlTable header = root.need("scenario").table("[scenario]");
  Mistakes mistakes;
  mistakes.attempt([&] { header.allow_only_keys(scenario_header_keys()); });
  mistakes.attempt([&] { read_names(header, file, scenario); });
  mistakes.attempt([&] {
    const auto inside = header.find("inside_m");
    if (!inside) return;
    scenario.inside = {point(*inside)};
    out.inside = inside->position();
  });
  mistakes.attempt([&] { read_extent(root, header, out); });
  mistakes.attempt([&] {
    if (const auto limit = header.find("time_limit_s")) scenario.time_limit_s = positive(*limit, max_time_s);
  });
  mistakes.end();
}

// The tasks that are listed, in this file or in one of MovingAI.
void read_listed_tasks(const TomlTable& root, const std::optional<TaskMap>& map, const std::filesystem::path& file,
                       const std::string& shown_path, ScenarioFile& out) {
  const auto tasks = root.find_table("robots");
  if (!tasks) return read_robots(root, out);
  if (const auto listed = root.find("robot")) listed->fail_at_key("a scenario has either [[robot]] or [robots]");
  read_tasks(*tasks, map, file, shown_path, out);
}

// A map alone is a scenario that has it and nothing else.
std::string scenario_text(const std::filesystem::path& file, const std::string& shown_path) {
  if (!is_map_file(file)) return read_file(file, shown_path);
  return "[scenario]\n[map]\nfile = " + toml_text(file.filename().string()) + "\n";
}

// The level that the file is read at, by default its first.
void set_level(const TomlTable& grade, std::optional<double> level, TomlDocument& document) {
  grade.allow_only_keys(grade_keys());
  document.set_level(level ? *level : levels_of(grade).front());
}

}  // namespace

std::vector<TomlKeys> scenario_keys() {
  std::vector<TomlKeys> tables = {{"[scenario]", scenario_header_keys()},
                                  {"[map]", map_keys()},
                                  {"[tiles]", tiles_keys()},
                                  {"[[box]]", box_keys()},
                                  {"[[circle]]", circle_keys()},
                                  {"[[polygon]]", polygon_keys()},
                                  {"[[robot]]", robot_keys()},
                                  {"[robots]", tasks_keys()},
                                  people_keys(),
                                  {"[[region]]", region_keys()},
                                  {"[[flow]]", flow_keys()},
                                  {"[[recording]]", recording_keys},
                                  {"[grade]", grade_keys()}};
  for (TomlKeys& table : robot_table_keys("[robot_type.NAME")) tables.push_back(std::move(table));
  return tables;
}

void check_extent(const TomlValue& at, dmrp_vec2 extent) {
  if (extent.x > max_side_m || extent.y > max_side_m)
    at.fail(fmt::format("the world must be at most {0} m by {0} m", max_side_m));
}

std::vector<double> read_levels(const std::filesystem::path& file, const std::string& shown_path) {
  const TomlDocument document(shown_path, scenario_text(file, shown_path));
  const auto grade = document.root().find_table("grade");
  return grade ? levels_of(*grade) : std::vector<double>();
}

ScenarioFile read_scenario_file(const std::filesystem::path& file, const std::string& shown_path,
                                std::optional<double> level) {
  ScenarioFile out;
  const auto document = std::make_shared<TomlDocument>(shown_path, scenario_text(file, shown_path));
  std::vector<TomlKeys> tables = scenario_keys();
  tables.push_back({"", scenario_root_keys});
  document->know(std::move(tables));
  out.document = document;
  const TomlTable root = out.document->root();
  if (const auto experiment = root.find("experiment"))
    experiment->fail("this is an experiment, not a scenario: its [[scenario]] names one");
  const auto grade = root.find_table("grade");
  if (grade) set_level(*grade, level, *document);
  Mistakes mistakes;
  mistakes.attempt([&] { root.allow_only_keys(scenario_root_keys); });
  const bool has_header = mistakes.attempt([&] { read_header(root, file, out); });
  if (grade) mistakes.attempt([&] { read_grade(*grade, *document->level(), out); });
  std::optional<TaskMap> map;
  const bool has_map = has_header && mistakes.attempt([&] { map = read_map(root, file, shown_path, out); });
  if (has_map) mistakes.attempt([&] { read_tiles(root, file, out); });
  mistakes.attempt([&] { read_shapes(root, out); });
  const bool may_need_map = root.find("robots").has_value();
  const bool has_robots =
      (has_map || !may_need_map) && mistakes.attempt([&] { read_listed_tasks(root, map, file, shown_path, out); });
  if (grade && has_robots) mistakes.attempt([&] { keep_graded(*grade, out); });
  mistakes.attempt([&] { read_crowd(root, out); });
  mistakes.attempt([&] { read_recordings(root, file, shown_path, out); });
  mistakes.end();
  if (!out.inside)
    for (const core::RobotTask& task : out.scenario.robots) out.scenario.inside.push_back({task.start.x, task.start.y});
  return out;
}

}  // namespace dmrp::host
