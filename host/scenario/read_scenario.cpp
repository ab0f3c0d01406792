// SPDX-License-Identifier: MIT
#include "host/scenario/read_scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/polygon.hpp>
#include <limits>

#include "host/files/read_file.hpp"
#include "host/scenario/read_map.hpp"
#include "host/scenario/read_recordings.hpp"
#include "host/scenario/read_tiles.hpp"
#include "host/scenario/robot_tables.hpp"
#include "host/toml/nearest_name.hpp"
#include "host/toml/toml_document.hpp"

namespace dmrp::host {

namespace {

constexpr double free_heading = std::numeric_limits<double>::quiet_NaN();
constexpr double max_length_m = 1e6;  // of a coordinate
constexpr double max_time_s = 1e6;
constexpr std::int64_t max_people = 10'000;  // of a flow

const std::vector<std::string> root_keys = {"scenario", "map",    "box",  "circle", "polygon",   "robot",     "robots",
                                            "people",   "region", "flow", "tiles",  "recording", "robot_type"};
const std::vector<std::string> header_keys = {"name", "title", "description", "size_m", "origin_m", "time_limit_s"};
const std::vector<std::string> box_keys = {"name", "center_m", "size_m", "angle_rad", "height_m"};
const std::vector<std::string> circle_keys = {"name", "center_m", "radius_m", "height_m"};
const std::vector<std::string> polygon_keys = {"name", "vertices_m", "height_m"};
const std::vector<std::string> robot_keys = {"name", "type", "start", "goal", "goals"};
const std::vector<std::string> region_keys = {"name", "lower_m", "upper_m"};
const std::vector<std::string> flow_keys = {"name", "from", "via", "to", "people", "start", "respawn", "group_size"};

std::vector<double> numbers(const TomlValue& value, std::size_t least, std::size_t most) {
  std::vector<double> out;
  for (const TomlValue& element : value.array()) out.push_back(element.number(-max_length_m, max_length_m));
  if (out.size() < least || out.size() > most)
    value.fail(fmt::format("'{}' must be {}, not {} number{}", value.key(),
                           least == most ? "[x, y]" : "[x, y] or [x, y, theta]", out.size(),
                           out.size() == 1 ? "" : "s"));
  return out;
}

dmrp_vec2 point(const TomlValue& value) {
  const auto xy = numbers(value, 2, 2);
  return {xy[0], xy[1]};
}

dmrp_vec2 size(const TomlValue& value) {
  const dmrp_vec2 out = point(value);
  if (out.x <= 0.0 || out.y <= 0.0)
    value.fail(fmt::format("'{}' must be positive, not [{}, {}]", value.key(), out.x, out.y));
  return out;
}

dmrp_pose pose(const TomlValue& value) {
  const auto xyt = numbers(value, 2, 3);
  return {xyt[0], xyt[1], xyt.size() == 3 ? xyt[2] : free_heading};
}

// A number > 0, at most `maximum`.
double positive(const TomlValue& value, double maximum) {
  value.positive();
  return value.number(0.0, maximum);
}

void refuse_twice(const TomlValue& name, const char* what, const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), name.text()) != names.end())
    name.fail(fmt::format("there are two {} '{}'", what, name.text()));
}

core::Shape read_box(const TomlTable& table) {
  table.allow_only(box_keys);
  core::Shape shape;
  const dmrp_vec2 center = point(table.need("center_m"));
  const dmrp_vec2 extent = size(table.need("size_m"));
  const auto angle = table.find("angle_rad");
  const double theta = angle ? angle->number(-max_length_m, max_length_m) : 0.0;
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  for (const auto& [i, j] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
    shape.vertices.push_back(
        {center.x + c * i * extent.x - s * j * extent.y, center.y + s * i * extent.x + c * j * extent.y});
  return shape;
}

core::Shape read_circle(const TomlTable& table) {
  table.allow_only(circle_keys);
  core::Shape shape;
  shape.kind = core::Shape::Kind::circle;
  shape.center = point(table.need("center_m"));
  shape.radius_m = positive(table.need("radius_m"), max_length_m);
  return shape;
}

core::Shape read_polygon(const TomlTable& table) {
  table.allow_only(polygon_keys);
  core::Shape shape;
  const TomlValue vertices = table.need("vertices_m");
  for (const TomlValue& vertex : vertices.array()) shape.vertices.push_back(point(vertex));
  if (shape.vertices.size() < 3) vertices.fail("'vertices_m' must have at least 3 points");
  if (toolkit::signed_area(shape.vertices) < 0.0) std::reverse(shape.vertices.begin(), shape.vertices.end());
  if (!toolkit::is_convex_ccw(shape.vertices)) vertices.fail("'vertices_m' must go round a convex polygon");
  return shape;
}

template <class Read>
void read_shapes(const TomlTable& root, const std::string& kind, Read&& read, ScenarioFile& out) {
  for (const TomlTable& table : root.tables(kind)) {
    core::Shape shape = read(table);
    const TomlValue name = table.need("name");
    shape.name = name.line();
    for (const core::Shape& other : out.scenario.shapes)
      if (other.name == shape.name) name.fail(fmt::format("there are two shapes '{}'", shape.name));
    if (const auto height = table.find("height_m")) shape.height_m = positive(*height, max_length_m);
    out.scenario.shapes.push_back(std::move(shape));
  }
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
  for (const TomlTable& table : root.tables("robot")) {
    table.allow_only(robot_keys);
    core::RobotTask task;
    if (const auto name = table.find("name")) {
      task.name = name->line();
      refuse_twice(*name, "robots", names);
    } else {
      task.name = fmt::format("robot {}", out.scenario.robots.size() + 1);
    }
    if (const auto type = table.find("type")) task.type = type->line();
    task.start = pose(table.need("start"));
    task.goals = read_goals(table);
    names.push_back(task.name);
    out.scenario.robots.push_back(std::move(task));
    out.robots.push_back(table.position());
  }
}

std::vector<TomlTable::KeyReader> people_readers(core::PeopleSettings& people) {
  const auto read_positive = [](double& to, double maximum) {
    return [&to, maximum](const TomlValue& value) { to = positive(value, maximum); };
  };
  return {{"radius_m", read_positive(people.radius_m, 10.0)},
          {"speed_mean", read_positive(people.speed_mean, 100.0)},
          {"speed_sd", [&people](const TomlValue& value) { people.speed_sd = value.number(0.0, 100.0); }},
          {"speed_min", read_positive(people.speed_min, 100.0)},
          {"speed_max", read_positive(people.speed_max, 100.0)}};
}

void read_people(const TomlTable& root, core::PeopleSettings& people) {
  const auto table = root.find_table("people");
  if (!table) return;
  table->read(people_readers(people));
  if (people.speed_min > people.speed_mean || people.speed_mean > people.speed_max)
    table->fail(fmt::format("[people] needs speed_min <= speed_mean <= speed_max, not {}, {}, {}", people.speed_min,
                            people.speed_mean, people.speed_max));
}

std::vector<std::string> read_regions(const TomlTable& root, ScenarioFile& out) {
  std::vector<std::string> names;
  for (const TomlTable& table : root.tables("region")) {
    table.allow_only(region_keys);
    core::Region region;
    const TomlValue name = table.need("name");
    region.name = name.line();
    refuse_twice(name, "regions", names);
    region.lower = point(table.need("lower_m"));
    region.upper = point(table.need("upper_m"));
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
  if (found == names.end())
    value.fail(fmt::format("no region '{}' (there: {}){}", name, join_names(names), did_you_mean(name, names)));
  return static_cast<std::uint32_t>(found - names.begin());
}

// A flow without people has no groups, so its group size is not limited.
std::uint32_t read_group_size(const TomlValue& value, const core::Flow& flow) {
  const auto size = static_cast<std::uint32_t>(value.integer(1, max_people));
  if (flow.people > 0 && size > flow.people)
    value.fail(fmt::format("'group_size' must be at most 'people', {}, not {}", flow.people, size));
  return size;
}

void read_flows(const TomlTable& root, const std::vector<std::string>& regions, ScenarioFile& out) {
  const auto first_own = static_cast<std::uint32_t>(out.scenario.regions.size() - regions.size());  // after tiles'
  const auto region_of = [&](const TomlValue& value) { return first_own + region_index(value, regions); };
  std::vector<std::string> names;
  for (const TomlTable& table : root.tables("flow")) {
    table.allow_only(flow_keys);
    core::Flow flow;
    const TomlValue name = table.need("name");
    flow.name = name.line();
    refuse_twice(name, "flows", names);
    names.push_back(flow.name);
    flow.regions.push_back(region_of(table.need("from")));
    const auto lead_to = [&](const TomlValue& region) {
      const std::uint32_t next = region_of(region);
      if (next == flow.regions.back())
        region.fail(
            fmt::format("flow '{}' leads from region '{}' to itself: nobody would walk", flow.name, region.text()));
      flow.regions.push_back(next);
    };
    if (const auto via = table.find("via"))
      for (const TomlValue& region : via->array()) lead_to(region);
    lead_to(table.need("to"));
    flow.people = static_cast<std::uint32_t>(table.need("people").integer(0, max_people));
    if (const auto start = table.find("start"); start && start->choice({"along", "from"}) == "from")
      flow.start = core::FlowStart::from;
    if (const auto respawn = table.find("respawn")) flow.respawn = respawn->boolean();
    if (const auto size = table.find("group_size")) flow.group_size = read_group_size(*size, flow);
    out.scenario.flows.push_back(std::move(flow));
    out.flows.push_back(table.position());
  }
}

void read_header(const TomlTable& root, const std::filesystem::path& file, ScenarioFile& out) {
  core::Scenario& scenario = out.scenario;
  const auto header = root.find_table("scenario");
  if (!header) root.fail("the file needs [scenario]");
  header->allow_only(header_keys);
  const TomlValue name = header->need("name");
  scenario.name = name.line();
  const std::string folder = file.parent_path().filename().string();
  if (file.filename() == "scenario.toml" && scenario.name != folder)
    name.fail(fmt::format("'name' must be that of the folder, '{}', not '{}'", folder, scenario.name));
  scenario.title = header->need("title").line();
  scenario.description = header->need("description").line();
  if (const auto origin = header->find("origin_m")) scenario.lower = point(*origin);
  const bool tiled = root.find_table("tiles").has_value();
  if (tiled || root.find_table("map")) {
    if (const auto size_value = header->find("size_m"))
      size_value->fail_at_key(
          fmt::format("a scenario has either 'size_m' or {}, which gives its size", tiled ? "[tiles]" : "a [map]"));
  } else {
    const TomlValue size_value = header->need("size_m");
    const dmrp_vec2 extent = size(size_value);
    if (extent.x > max_side_m || extent.y > max_side_m)
      size_value.fail(fmt::format("'size_m' must be at most [{0}, {0}]", max_side_m));
    scenario.upper = {scenario.lower.x + extent.x, scenario.lower.y + extent.y};
    out.size = size_value.position();
  }
  if (const auto limit = header->find("time_limit_s")) scenario.time_limit_s = positive(*limit, max_time_s);
}

std::vector<TomlKeys> keys_of_tables() {
  core::PeopleSettings unused;
  std::vector<TomlKeys> tables = {{"[scenario]", header_keys},
                                  {"[map]", map_keys},
                                  {"[tiles]", tiles_keys},
                                  {"[[box]]", box_keys},
                                  {"[[circle]]", circle_keys},
                                  {"[[polygon]]", polygon_keys},
                                  {"[[robot]]", robot_keys},
                                  {"[robots]", tasks_keys},
                                  {"[people]", TomlTable::keys_of(people_readers(unused))},
                                  {"[[region]]", region_keys},
                                  {"[[flow]]", flow_keys},
                                  {"[[recording]]", recording_keys}};
  for (TomlKeys& table : robot_table_keys("[robot_type.NAME")) tables.push_back(std::move(table));
  return tables;
}

}  // namespace

void check_extent(const TomlValue& at, dmrp_vec2 extent) {
  if (extent.x > max_side_m || extent.y > max_side_m)
    at.fail(fmt::format("the world must be at most {0} m by {0} m", max_side_m));
}

ScenarioFile read_scenario_file(const std::filesystem::path& file, const std::string& shown_path) {
  ScenarioFile out;
  const auto document = std::make_shared<TomlDocument>(shown_path, read_file(file, shown_path));
  document->know(keys_of_tables());
  out.document = document;
  const TomlTable root = out.document->root();
  root.allow_only(root_keys);
  read_header(root, file, out);
  const auto map = read_map(root, file, shown_path, out);
  read_tiles(root, file, out);
  read_shapes(root, "box", read_box, out);
  read_shapes(root, "circle", read_circle, out);
  read_shapes(root, "polygon", read_polygon, out);
  if (const auto tasks = root.find_table("robots")) {
    if (const auto listed = root.find("robot")) listed->fail_at_key("a scenario has either [[robot]] or [robots]");
    read_tasks(*tasks, map, file, shown_path, out);
  } else {
    read_robots(root, out);
  }
  read_people(root, out.scenario.people);
  const auto regions = read_regions(root, out);
  read_flows(root, regions, out);
  read_recordings(root, file, shown_path, out);
  return out;
}

}  // namespace dmrp::host
