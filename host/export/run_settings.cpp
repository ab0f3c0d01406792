// SPDX-License-Identifier: MIT
#include "host/export/run_settings.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <functional>
#include <sstream>
#include <utility>

#include "host/results/csv.hpp"

namespace dmrp::host {
namespace {

constexpr const char* kinds[] = {"global_planner", "local_controller", "pedestrian_model"};
constexpr const char* settings_tables[] = {"simulation", "recovery", "navigation", "ending", "robot", "limits"};

const std::string& label_of(const CombinationLabels& combination, std::string_view kind) {
  if (kind == "global_planner") return combination.global_planner;
  return kind == "local_controller" ? combination.local_controller : combination.pedestrian_model;
}

std::string text_of(const toml::node& node) {
  if (const auto number = node.value_exact<double>()) return shortest_number(*number);
  if (const auto text = node.value_exact<std::string>()) return *text;
  std::ostringstream written;
  node.visit([&](const auto& value) { written << value; });
  return written.str();
}

// Calls `found` for each value, with its name below `prefix`.
void flatten(const std::string& prefix, const toml::table& table,
             const std::function<void(const std::string&, const std::string&)>& found) {
  for (const auto& [key, node] : table) {
    const std::string name = prefix + "." + std::string(key.str());
    if (const toml::table* inner = node.as_table())
      flatten(name, *inner, found);
    else
      found(name, text_of(node));
  }
}

}  // namespace

RunSettings::RunSettings(std::string_view effective_toml, std::span<const TrialRecord> trials, PeopleCounts people)
    : people_(std::move(people)) {
  const toml::table root = toml::parse(effective_toml);
  for (const std::string kind : kinds) {
    const toml::array* uses = root[kind].as_array();
    for (std::size_t i = 0; uses && i < uses->size(); ++i) {
      const toml::table* use = uses->get(i)->as_table();
      if (!use) continue;
      Values& values = plugins_[kind][(*use)["label"].value_or(std::string())];
      values[kind + ".id"] = (*use)["use"].value_or(std::string("file"));  // plans of one, not of a plugin
      add_name(kind + ".id");
      if (const toml::table* params = (*use)["params"].as_table())
        flatten(kind, *params, [&](const std::string& name, const std::string& value) {
          values[name] = value;
          add_name(name);
        });
    }
  }
  for (const std::string table : settings_tables)
    if (const toml::table* settings = root[table].as_table())
      flatten(table, *settings, [&](const std::string& name, const std::string& value) {
        if (name.starts_with(table + ".sweep.")) return;
        settings_[name] = value;
        add_name(name);
      });
  for (const std::string& name : swept_columns(trials)) add_name(name);
  if (!people_.empty()) add_name("people");
}

std::string RunSettings::value(const std::string& name, const TrialRecord& trial) const {
  if (std::string swept = swept_value(trial.swept, name); !swept.empty()) return swept;
  if (name == "people") return std::to_string(people_in(people_, trial));
  const std::string none;
  const CombinationLabels combination = combination_of(trial);
  for (const auto& [kind, of_label] : plugins_)
    if (name.starts_with(kind + ".")) {
      const auto plugin = of_label.find(label_of(combination, kind));
      if (plugin == of_label.end()) return none;
      const auto found = plugin->second.find(name);
      return found == plugin->second.end() ? none : found->second;
    }
  const auto found = settings_.find(name);
  return found == settings_.end() ? none : found->second;
}

void RunSettings::add_name(const std::string& name) {
  if (std::find(names_.begin(), names_.end(), name) == names_.end()) names_.push_back(name);
}

}  // namespace dmrp::host
