// SPDX-License-Identifier: MIT
#include "host/experiment/read_scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/polygon.hpp>
#include <fstream>
#include <limits>
#include <sstream>

#include "host/executable.hpp"
#include "host/experiment/experiment.hpp"
#include "host/experiment/nearest_name.hpp"
#include "host/experiment/toml_document.hpp"
#include "host/input_error.hpp"

namespace dmrp::host {

namespace {

constexpr double free_heading = std::numeric_limits<double>::quiet_NaN();
constexpr double longest_side_m = 10'000.0;

std::vector<double> numbers(const TomlValue& value, std::size_t least, std::size_t most) {
  std::vector<double> out;
  for (const TomlValue& element : value.array()) out.push_back(element.number());
  if (out.size() < least || out.size() > most)
    value.fail(least == most ? fmt::format("'{}' must have {} numbers, not {}", value.key(), least, out.size())
                             : fmt::format("'{}' must be [x, y] or [x, y, theta]", value.key()));
  return out;
}

dmrp_vec2 point(const TomlValue& value) {
  const auto xy = numbers(value, 2, 2);
  return {xy[0], xy[1]};
}

dmrp_vec2 size(const TomlValue& value) {
  const dmrp_vec2 out = point(value);
  if (out.x <= 0.0 || out.y <= 0.0) value.fail(fmt::format("'{}' must be positive", value.key()));
  return out;
}

dmrp_pose pose(const TomlValue& value) {
  const auto xyt = numbers(value, 2, 3);
  return {xyt[0], xyt[1], xyt.size() == 3 ? xyt[2] : free_heading};
}

core::Shape read_box(TomlTable& table) {
  core::Shape shape;
  const dmrp_vec2 center = point(table.need("center_m"));
  const dmrp_vec2 half = size(table.need("size_m"));
  const auto angle = table.find("angle_rad");
  const double theta = angle ? angle->number() : 0.0;
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  for (const auto& [i, j] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
    shape.vertices.push_back({center.x + c * i * half.x - s * j * half.y, center.y + s * i * half.x + c * j * half.y});
  return shape;
}

core::Shape read_circle(TomlTable& table) {
  core::Shape shape;
  shape.kind = core::Shape::Kind::circle;
  shape.center = point(table.need("center_m"));
  shape.radius_m = table.need("radius_m").positive();
  return shape;
}

core::Shape read_polygon(TomlTable& table) {
  core::Shape shape;
  const TomlValue vertices = table.need("vertices_m");
  for (const TomlValue& vertex : vertices.array()) shape.vertices.push_back(point(vertex));
  if (shape.vertices.size() < 3) vertices.fail("'vertices_m' must have at least 3 points");
  if (toolkit::signed_area(shape.vertices) < 0.0) std::reverse(shape.vertices.begin(), shape.vertices.end());
  if (!toolkit::is_convex_ccw(shape.vertices)) vertices.fail("'vertices_m' must go round a convex polygon");
  return shape;
}

template <class Read>
void read_shapes(TomlTable& root, const std::string& kind, Read&& read, ScenarioFile& out) {
  for (TomlTable& table : root.tables(kind)) {
    const std::string name = table.need("name").text();
    core::Shape shape = read(table);
    shape.name = name;
    if (const auto height = table.find("height_m")) shape.height_m = height->positive();
    table.finish();
    out.scenario.shapes.push_back(std::move(shape));
  }
}

void read_robots(TomlTable& root, ScenarioFile& out) {
  for (TomlTable& table : root.tables("robot")) {
    core::RobotTask task;
    const auto name = table.find("name");
    task.name = name ? name->text() : fmt::format("robot {}", out.scenario.robots.size() + 1);
    task.start = pose(table.need("start"));
    if (const auto goals = table.find("goals")) {
      for (const TomlValue& goal : goals->array()) task.goals.push_back(pose(goal));
      if (task.goals.empty()) goals->fail("'goals' must have at least one");
      if (const auto goal = table.find("goal")) goal->fail("a robot has either 'goal' or 'goals'");
    } else {
      task.goals.push_back(pose(table.need("goal")));
    }
    table.finish();
    out.scenario.robots.push_back(std::move(task));
    out.robots.push_back(table.position());
  }
}

void read_people(TomlTable& root, core::PeopleSettings& people) {
  auto table = root.find_table("people");
  if (!table) return;
  const auto number = [&](const char* key, double& to) {
    if (const auto value = table->find(key)) to = value->positive();
  };
  number("radius_m", people.radius_m);
  number("speed_mean", people.speed_mean);
  if (const auto value = table->find("speed_sd")) people.speed_sd = value->number(0.0);
  number("speed_min", people.speed_min);
  number("speed_max", people.speed_max);
  table->finish();
  if (people.speed_min > people.speed_mean || people.speed_mean > people.speed_max)
    table->fail(fmt::format("[people] needs speed_min <= speed_mean <= speed_max, not {}, {}, {}", people.speed_min,
                            people.speed_mean, people.speed_max));
}

std::vector<std::string> read_regions(TomlTable& root, ScenarioFile& out) {
  std::vector<std::string> names;
  for (TomlTable& table : root.tables("region")) {
    core::Region region;
    const TomlValue name = table.need("name");
    region.name = name.text();
    if (std::find(names.begin(), names.end(), region.name) != names.end())
      name.fail(fmt::format("there are two regions '{}'", region.name));
    region.lower = point(table.need("lower_m"));
    region.upper = point(table.need("upper_m"));
    table.finish();
    if (region.lower.x > region.upper.x || region.lower.y > region.upper.y)
      table.fail(fmt::format("region '{}' needs lower_m <= upper_m", region.name));
    names.push_back(region.name);
    out.scenario.regions.push_back(region);
    out.regions.push_back(table.position());
  }
  return names;
}

std::uint32_t region_index(const TomlValue& value, const std::vector<std::string>& names) {
  const std::string name = value.text();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) value.fail(fmt::format("no region '{}'{}", name, did_you_mean(name, names)));
  return static_cast<std::uint32_t>(found - names.begin());
}

void read_flows(TomlTable& root, const std::vector<std::string>& regions, ScenarioFile& out) {
  for (TomlTable& table : root.tables("flow")) {
    core::Flow flow;
    flow.name = table.need("name").text();
    flow.regions.push_back(region_index(table.need("from"), regions));
    if (const auto via = table.find("via"))
      for (const TomlValue& region : via->array()) flow.regions.push_back(region_index(region, regions));
    flow.regions.push_back(region_index(table.need("to"), regions));
    flow.people = static_cast<std::uint32_t>(table.need("people").integer(0, 100'000));
    table.finish();
    out.scenario.flows.push_back(std::move(flow));
    out.flows.push_back(table.position());
  }
}

void read_header(TomlTable& root, core::Scenario& scenario) {
  auto header = root.find_table("scenario");
  if (!header) root.fail("the file needs [scenario]");
  scenario.name = header->need("name").text();
  scenario.title = header->need("title").text();
  scenario.description = header->need("description").text();
  const TomlValue size_value = header->need("size_m");
  const dmrp_vec2 extent = size(size_value);
  if (extent.x > longest_side_m || extent.y > longest_side_m)
    size_value.fail(fmt::format("'size_m' must be at most {} m", longest_side_m));
  if (const auto origin = header->find("origin_m")) scenario.lower = point(*origin);
  scenario.upper = {scenario.lower.x + extent.x, scenario.lower.y + extent.y};
  if (const auto limit = header->find("time_limit_s")) scenario.time_limit_s = limit->positive();
  header->finish();
}

std::string read_text(const std::filesystem::path& file, const std::string& shown) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw InputError(shown + ":1:1: cannot be read");
  return text.str();
}

}  // namespace

ScenarioFile read_scenario_file(const std::filesystem::path& file, const std::string& shown_path) {
  ScenarioFile out;
  out.document = std::make_shared<TomlDocument>(shown_path, read_text(file, shown_path));
  TomlTable root = out.document->root();
  read_header(root, out.scenario);
  read_shapes(root, "box", read_box, out);
  read_shapes(root, "circle", read_circle, out);
  read_shapes(root, "polygon", read_polygon, out);
  read_robots(root, out);
  read_people(root, out.scenario.people);
  const auto regions = read_regions(root, out);
  read_flows(root, regions, out);
  root.finish();
  return out;
}

std::vector<std::filesystem::path> scenario_folders() {
  std::vector<std::filesystem::path> folders = {shared_data_path() / "scenarios"};
  for (auto& folder : folders_of_variable("DMRP_SCENARIO_PATH")) folders.push_back(std::move(folder));
  return folders;
}

std::filesystem::path find_scenario(const std::string& name_or_path, const std::filesystem::path& base) {
  namespace fs = std::filesystem;
  std::vector<fs::path> candidates;
  if (name_or_path.find('/') == std::string::npos && !name_or_path.ends_with(".toml"))
    for (const fs::path& folder : scenario_folders()) candidates.push_back(folder / name_or_path / "scenario.toml");
  else
    candidates = {base / name_or_path, base / name_or_path / "scenario.toml"};
  for (const fs::path& candidate : candidates)
    if (std::error_code ignored; fs::is_regular_file(candidate, ignored)) return fs::canonical(candidate);
  return {};
}

std::vector<std::string> shipped_scenarios() {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(shared_data_path() / "scenarios", ignored))
    if (std::filesystem::is_regular_file(entry.path() / "scenario.toml", ignored))
      names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace dmrp::host
