// SPDX-License-Identifier: MIT
#include "host/experiment/settings_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host/experiment/settings_tables.hpp"
#include "host/scenario/robot_tables.hpp"

namespace dmrp::host {

namespace {

constexpr std::size_t max_points = 1000;
constexpr const char* swept_tables[] = {"simulation", "recovery", "navigation", "robot"};

Settings settings_of(SettingsPoint& point, const std::string& table) {
  if (table == "simulation") return simulation_settings(point.simulation);
  if (table == "navigation") return navigation_settings(point.simulation.navigation);
  return table == "recovery" ? recovery_settings(point.simulation.recovery) : robot_values(point.robot);
}

// "lidar" of "lidar.beams".
std::string first_part(const std::string& key) {
  return key.substr(0, key.find('.'));
}

// The lists of a sweep, by key; those of subtables, as of `lidar = { beams = [90, 360] }`, by "lidar.beams".
std::vector<std::pair<std::string, TomlValue>> lists_of(const TomlTable& sweep, const Settings& settings) {
  std::vector<std::string> known;
  for (const Setting& setting : settings) known.push_back(first_part(setting.key));
  sweep.allow_only(known);
  std::vector<std::pair<std::string, TomlValue>> lists;
  for (const TomlValue& entry : sweep.entries()) {
    std::vector<std::string> inner;
    for (const Setting& setting : settings)
      if (setting.key.starts_with(entry.key() + ".")) inner.push_back(setting.key.substr(entry.key().size() + 1));
    if (inner.empty()) {
      lists.emplace_back(entry.key(), entry);
      continue;
    }
    const TomlTable subtable = entry.table();
    subtable.allow_only(inner);
    for (const TomlValue& list : subtable.entries()) lists.emplace_back(entry.key() + "." + list.key(), list);
  }
  return lists;
}

// A value as readers see it: without a text's quotes and without the ".0" of a whole number.
std::string plain(const std::string& toml) {
  if (toml.size() >= 2 && toml.front() == '"') return toml.substr(1, toml.size() - 2);
  return toml.ends_with(".0") ? toml.substr(0, toml.size() - 2) : toml;
}

// Each point with each value of a list.
std::vector<SettingsPoint> multiply(const std::vector<SettingsPoint>& points, SettingsSweep& sweep,
                                    const TomlValue& list) {
  const std::vector<TomlValue> values = list.array();
  if (values.empty()) list.fail(fmt::format("'{}' sweeps over no values", list.key()));
  if (points.size() * values.size() > max_points)
    list.fail(fmt::format("the sweep has more than {} combinations", max_points));
  std::vector<SettingsPoint> out;
  for (const SettingsPoint& point : points) {
    sweep.values.clear();
    for (const TomlValue& value : values) {
      SettingsPoint& next = out.emplace_back(point);
      for (const Setting& setting : settings_of(next, sweep.table)) {
        if (setting.key != sweep.key) continue;
        setting.read(value);
        sweep.values.push_back(setting.write());
      }
      const std::string& text = sweep.values.back();
      if (std::count(sweep.values.begin(), sweep.values.end(), text) > 1)
        value.fail(fmt::format("'{} {}' twice in a sweep", sweep.key, plain(text)));
      next.swept.push_back({sweep.table, sweep.key, plain(text)});
    }
  }
  return out;
}

}  // namespace

std::vector<SettingsPoint> read_settings_sweep(const TomlTable& root, Experiment& experiment) {
  std::vector<SettingsPoint> points = {{experiment.simulation, experiment.robot}};
  for (const std::string table : swept_tables) {
    const auto settings = root.find_table(table);
    const auto sweep = settings ? settings->find_table("sweep") : std::nullopt;
    if (!sweep) continue;
    for (const auto& [key, list] : lists_of(*sweep, settings_of(points.front(), table))) {
      SettingsSweep& swept = experiment.sweeps.emplace_back(SettingsSweep{table, key, {}});
      points = multiply(points, swept, list);
      if (table == "simulation" && key == "time_limit_s") experiment.time_limit_set = true;
    }
    for (SettingsPoint& point : points)
      if (table == "simulation")
        check_simulation(*sweep, point.simulation);
      else if (table == "robot")
        check_robot(*sweep, point.robot);
  }
  return points;
}

}  // namespace dmrp::host
