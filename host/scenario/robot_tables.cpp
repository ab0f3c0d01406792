// SPDX-License-Identifier: MIT
#include "host/scenario/robot_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <dmrp/toolkit/polygon.hpp>
#include <numbers>
#include <optional>
#include <utility>

#include "core/scene/footprint.hpp"
#include "host/errors/mistakes.hpp"
#include "host/toml/nearest_name.hpp"

namespace dmrp::host {

namespace {

constexpr double min_radius_m = 0.01;
constexpr double max_radius_m = 10.0;
constexpr double max_noise = 100.0;           // of odometry
constexpr double max_dropout_share = 0.9;     // with more a costmap cannot distinguish them from free space
constexpr double max_costmap_cells = 2000.0;  // along a side
const std::vector<TomlKey> footprint_keys = {{"radius_m", range_text(min_radius_m, max_radius_m)},
                                             {"vertices_m", "each " + range_text(-max_radius_m, max_radius_m)},
                                             {"parts_m", "each " + range_text(-max_radius_m, max_radius_m)}};
const std::vector<std::string> drives = {"differential", "holonomic", "ackermann"};

// The numbers, counted from 1, of two sides that meet although they are no neighbours.
std::optional<std::pair<std::size_t, std::size_t>> crossing_sides(toolkit::PolygonView polygon) {
  for (std::size_t i = 0; i < polygon.size(); ++i)
    for (std::size_t j = i + 2; j < polygon.size(); ++j) {
      const bool are_neighbours = i == 0 && j + 1 == polygon.size();
      if (!are_neighbours && toolkit::intersects(polygon.edge(i), polygon.edge(j))) return std::pair(i + 1, j + 1);
    }
  return std::nullopt;
}

core::ConvexPolygon read_part(const TomlValue& value) {
  core::ConvexPolygon polygon;
  for (const TomlValue& vertex : value.array()) {
    const std::vector<TomlValue> xy = vertex.array();
    if (xy.size() != 2)
      vertex.fail(fmt::format("a vertex must be [x, y], not {} number{}", xy.size(), xy.size() == 1 ? "" : "s"));
    polygon.push_back({xy[0].number(-max_radius_m, max_radius_m), xy[1].number(-max_radius_m, max_radius_m)});
  }
  if (polygon.size() < 3) value.fail("a footprint's polygon must have at least 3 vertices");
  if (const auto sides = crossing_sides(polygon))
    value.fail(
        fmt::format("the footprint's polygon crosses itself: its sides {} and {} meet", sides->first, sides->second));
  if (toolkit::signed_area(polygon) < 0.0) std::reverse(polygon.begin(), polygon.end());
  if (!toolkit::is_convex_ccw(polygon))
    value.fail("the footprint's polygon must be convex (a concave footprint is a list of convex 'parts_m')");
  return polygon;
}

void read_footprint(const TomlTable& table, core::RobotSettings& to) {
  table.allow_only_keys(footprint_keys);
  const std::vector<TomlValue> entries = table.entries();
  if (entries.size() != 1) table.fail("'footprint' must have one of radius_m, vertices_m and parts_m");
  const TomlValue& given = entries.front();
  to.parts.clear();
  if (given.key() == "radius_m") {
    to.radius_m = given.number(min_radius_m, max_radius_m);
    return;
  }
  if (given.key() == "vertices_m") to.parts.push_back(read_part(given));
  if (given.key() == "parts_m")
    for (const TomlValue& part : given.array()) to.parts.push_back(read_part(part));
  if (to.parts.empty()) given.fail("'parts_m' must have at least one polygon");
  if (!(core::inscribed_radius(to.parts) > 0.0))
    given.fail("the footprint must contain the robot's origin (0, 0), about which it turns");
  to.radius_m = core::circumscribed_radius(to.parts);
}

std::string footprint_text(const core::RobotSettings& robot) {
  if (robot.parts.empty()) return fmt::format("{{ radius_m = {} }}", toml_text(robot.radius_m));
  std::string text;
  for (const core::ConvexPolygon& part : robot.parts) {
    std::string vertices;
    for (const dmrp_vec2 vertex : part)
      vertices += fmt::format("{}[{}, {}]", vertices.empty() ? "" : ", ", toml_text(vertex.x), toml_text(vertex.y));
    text += fmt::format("{}[{}]", text.empty() ? "" : ", ", vertices);
  }
  return fmt::format("{{ parts_m = [{}] }}", text);
}

Setting footprint_setting(core::RobotSettings& to) {
  return {"footprint", [&to](const TomlValue& value) { read_footprint(value.table("'footprint'"), to); },
          [&to] { return footprint_text(to); }};
}

Settings odometry_settings(core::OdometrySettings& to) {
  const auto read_noise = [&to](const TomlValue& value) {
    const std::vector<TomlValue> given = value.array();
    if (given.size() != to.noise.size())
      value.fail(
          fmt::format("'noise' must be [a1, a2, a3, a4], not {} number{}", given.size(), given.size() == 1 ? "" : "s"));
    for (std::size_t i = 0; i < given.size(); ++i) to.noise[i] = given[i].number(0.0, max_noise);
  };
  const auto write_noise = [&to] { return toml_text(std::vector<double>(to.noise.begin(), to.noise.end())); };
  return {{"noise", read_noise, write_noise, "each " + range_text(0.0, max_noise)},
          seconds_or_never("fix_period_s", to.fix_period_ns)};
}

Settings lidar_settings(core::LidarSettings& to) {
  return {integer("beams", to.beams, 1, 100'000),
          number("field_of_view_rad", to.field_of_view_rad, 0.01, 2.0 * std::numbers::pi),
          number("range_min_m", to.range_min_m, 0.0, max_length_m),
          positive("range_max_m", to.range_max_m, max_length_m),
          number("noise_sd_m", to.noise_sd_m, 0.0, 10.0),
          number("dropout_share", to.dropout_share, 0.0, max_dropout_share)};
}

void check_lidar(const TomlTable& table, const core::LidarSettings& lidar) {
  if (lidar.range_min_m >= lidar.range_max_m)
    table.fail(
        fmt::format("'lidar' needs range_min_m < range_max_m, not {} and {}", lidar.range_min_m, lidar.range_max_m));
}

Settings costmap_settings(core::CostmapSettings& to) {
  return {number("resolution_m", to.resolution_m, 0.01, 1.0),
          number("window_m", to.window_m, 1.0, 100.0),
          positive("obstacle_range_m", to.obstacle_range_m, max_length_m),
          positive("raytrace_range_m", to.raytrace_range_m, max_length_m),
          positive("inflation_radius_m", to.inflation_radius_m, 100.0),
          positive("cost_scaling", to.cost_scaling, 1000.0)};
}

void check_costmap(const TomlTable& table, const core::CostmapSettings& costmap) {
  const double cells = costmap.window_m / costmap.resolution_m;
  if (cells > max_costmap_cells)
    table.fail(fmt::format("'costmap' can have at most {} cells along a side: a window of {} m at {} m has {:.0f}",
                           max_costmap_cells, costmap.window_m, costmap.resolution_m, cells));
}

Settings robot_settings(core::RobotSettings& to) {
  return {footprint_setting(to),
          choice("drive", to.drive, drives, DMRP_KINEMATICS_DIFFERENTIAL),
          number("v_min", to.v_min, -100.0, 0.0),
          number("recovery_v_min", to.recovery_v_min, -100.0, 0.0),
          positive("v_max", to.v_max, 100.0),
          positive("v_y_max", to.v_y_max, 100.0),
          positive("omega_max", to.omega_max, 100.0),
          positive("a_max", to.a_max, 1000.0),
          positive("alpha_max", to.alpha_max, 1000.0),
          positive("wheelbase_m", to.wheelbase_m, max_radius_m),
          positive("steering_max", to.steering_max, 1.5),
          positive("steering_rate_max", to.steering_rate_max, 100.0),
          latency("actuation_latency_s", to.actuation_latency_ns),
          subtable("odometry", odometry_settings(to.odometry)),
          subtable("lidar", lidar_settings(to.lidar), [&to](const TomlTable& table) { check_lidar(table, to.lidar); }),
          subtable("costmap", costmap_settings(to.costmap),
                   [&to](const TomlTable& table) { check_costmap(table, to.costmap); })};
}

// The drive that a key belongs to; nullopt: all.
std::optional<core::Drive> drive_of(const std::string& key) {
  if (key == "v_y_max") return core::Drive::holonomic;
  if (key == "wheelbase_m" || key == "steering_max" || key == "steering_rate_max") return core::Drive::ackermann;
  return std::nullopt;
}

const std::string& name_of(core::Drive drive) {
  return drives[static_cast<std::size_t>(drive) - DMRP_KINEMATICS_DIFFERENTIAL];
}

void check_drive(const TomlTable& table, core::RobotSettings& robot) {
  for (const TomlValue& entry : table.entries())
    if (const auto drive = drive_of(entry.key()); drive && *drive != robot.drive)
      entry.fail_at_key(fmt::format("'{}' belongs to drive = '{}', but the drive is '{}'", entry.key(), name_of(*drive),
                                    name_of(robot.drive)));
  if (robot.drive == core::Drive::holonomic && !(robot.v_y_max > 0.0)) robot.v_y_max = robot.v_max;
  if (robot.drive == core::Drive::ackermann && !(robot.wheelbase_m > 0.0))
    table.need("drive").fail("drive = 'ackermann' needs 'wheelbase_m'");
}

// Adds the [robot_type.NAME] of a file to `types`, or replaces them.
template <class Put>
void read_types(const TomlTable& root, const core::RobotSettings& standard, const Put& put) {
  const auto types = root.find_table("robot_type");
  if (!types) return;
  Mistakes mistakes;
  for (const TomlValue& entry : types->entries())
    mistakes.attempt([&] {
      core::RobotSettings type = standard;
      read_robot_table(entry.table(fmt::format("[robot_type.{}]", entry.key())), type);
      type.type = entry.key();
      if (type.type == default_type_name) entry.fail_at_key("[robot] is the type 'default'");
      put(std::move(type));
    });
  mistakes.end();
}

std::string unknown_type(const std::string& name, const core::RobotTypes& types) {
  std::vector<std::string> names;
  for (const core::RobotSettings& type : types.all())
    if (!type.type.empty()) names.push_back(type.type);
  return fmt::format("unknown type '{}'{}", name,
                     names.empty() ? " (there: no [robot_type.NAME])" : among(name, names));
}

}  // namespace

void read_robot_table(const TomlTable& table, core::RobotSettings& robot, const std::vector<std::string>& others) {
  std::vector<TomlTable::KeyReader> readers = readers_of(robot_settings(robot));
  for (const std::string& other : others) readers.emplace_back(other, [](const TomlValue& value) { value.table(); });
  table.read(readers);
  check_drive(table, robot);
}

Settings robot_values(core::RobotSettings& to) {
  const std::pair<const char*, Settings> subtables[] = {{"odometry", odometry_settings(to.odometry)},
                                                        {"lidar", lidar_settings(to.lidar)},
                                                        {"costmap", costmap_settings(to.costmap)}};
  Settings values = robot_settings(to);
  for (const auto& subtable : subtables) {
    std::erase_if(values, [&](const Setting& setting) { return setting.key == subtable.first; });
    for (const Setting& setting : subtable.second)
      values.push_back({fmt::format("{}.{}", subtable.first, setting.key), setting.read, setting.write, setting.range});
  }
  return values;
}

void check_robot(const TomlTable& table, core::RobotSettings& robot) {
  check_lidar(table, robot.lidar);
  check_costmap(table, robot.costmap);
  check_drive(table, robot);
}

std::vector<core::RobotSettings> read_robot_types(const TomlTable& root, const core::RobotSettings& standard) {
  std::vector<core::RobotSettings> types;
  read_types(root, standard, [&](core::RobotSettings type) { types.push_back(std::move(type)); });
  return types;
}

core::RobotTypes robot_types_of(const ScenarioFile& file, const core::RobotSettings& standard,
                                std::span<const core::RobotSettings> of_experiment) {
  core::RobotTypes types(standard);
  read_types(file.document->root(), standard, [&](core::RobotSettings type) { types.put(std::move(type)); });
  for (const core::RobotSettings& type : of_experiment) types.put(type);
  Mistakes mistakes;
  for (std::size_t i = 0; i < file.scenario.robots.size(); ++i)
    if (const std::string& name = file.scenario.robots[i].type; !types.find(name))
      mistakes.attempt([&] {
        file.document->fail(file.robots[i], fmt::format("robot {} has the {}", i, unknown_type(name, types)));
      });
  mistakes.end();
  return types;
}

void fail_unknown_type(const TomlValue& at, const core::RobotTypes& types) {
  at.fail_at_key(unknown_type(at.key(), types));
}

const char* shown_drive(core::Drive drive) {
  if (drive == core::Drive::differential) return "a differential drive";
  return drive == core::Drive::holonomic ? "a holonomic drive" : "an Ackermann drive";
}

std::vector<TomlKeys> robot_table_keys(const std::string& table) {
  core::RobotSettings unused;
  return {keys_of(table + "]", robot_settings(unused)),
          {table + ".footprint]", footprint_keys},
          keys_of(table + ".odometry]", odometry_settings(unused.odometry)),
          keys_of(table + ".lidar]", lidar_settings(unused.lidar)),
          keys_of(table + ".costmap]", costmap_settings(unused.costmap))};
}

std::string robot_text(const core::RobotSettings& robot) {
  core::RobotSettings copy = robot;  // Setting::read needs a variable; the text does not change it
  Settings settings = robot_settings(copy);
  std::erase_if(settings, [&](const Setting& setting) {
    const auto drive = drive_of(setting.key);
    return drive && *drive != robot.drive;
  });
  return lines_of(settings, 9);
}

}  // namespace dmrp::host
