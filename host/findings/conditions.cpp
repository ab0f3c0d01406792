// SPDX-License-Identifier: MIT
#include "host/findings/conditions.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <filesystem>
#include <set>
#include <vector>

#include "host/files/read_file.hpp"

namespace dmrp::host {
namespace {

bool is_swept(const toml::node_view<const toml::node> table, std::string_view key) {
  return static_cast<bool>(table["sweep"][key]);
}

// "local routes", "no local routes" or "local routes swept".
std::string helped(const toml::node_view<const toml::node> table, std::string_view key, bool helps,
                   std::string_view name) {
  if (is_swept(table, key)) return fmt::format("{} swept", name);
  return fmt::format("{}{}", helps ? "" : "no ", name);
}

// Most experiments have no latency, and say nothing of it.
std::string latency_words(const toml::node_view<const toml::node> navigation) {
  if (is_swept(navigation, "compensate_latency")) return "latency compensation swept";
  return navigation["compensate_latency"].value_or(false) ? "latency compensated" : "";
}

std::string replanning_words(const toml::node_view<const toml::node> simulation) {
  for (const char* key : {"replan_period_s", "replan_period_steps", "replan_stray_m", "replan_stall_s"}) {
    if (is_swept(simulation, key)) return "replanning swept";
    if (simulation[key].value_or(0.0) > 0.0) return "replanning";
  }
  return "no replanning";
}

// "tuned parameters": the folders of the controllers' parameter files.
std::string parameter_words(const toml::table& experiment) {
  std::set<std::string> sets;
  const toml::array* controllers = experiment["local_controller"].as_array();
  for (std::size_t i = 0; controllers && i < controllers->size(); ++i) {
    const auto file = (*controllers)[i].as_table()
                          ? (*controllers->get(i)->as_table())["params_file"].value<std::string>()
                          : std::nullopt;
    const std::string set = file ? std::filesystem::path(*file).parent_path().filename().string() : "default";
    sets.insert(set.empty() || set == "." ? "own" : set);
  }
  return sets.empty() ? "" : fmt::format("{} parameters", fmt::join(sets, " and "));
}

std::string awareness_words(const toml::table& effective) {
  constexpr const char* key = "robot_awareness";
  std::set<std::string> values;
  const toml::array* models = effective["pedestrian_model"].as_array();
  for (std::size_t i = 0; models && i < models->size(); ++i) {
    const toml::node_view<const toml::node> model(models->get(i));
    if (is_swept(model, key)) return "robot awareness swept";
    if (const auto value = model["params"][key].value<double>()) values.insert(fmt::format("{:g}", *value));
  }
  return values.empty() ? "" : fmt::format("robot awareness {}", fmt::join(values, " and "));
}

}  // namespace

std::string conditions_words(std::string_view effective_toml, std::string_view experiment_toml) {
  const toml::table effective = toml::parse(effective_toml);
  const toml::node_view<const toml::node> simulation = effective["simulation"];
  const toml::node_view<const toml::node> navigation = effective["navigation"];
  const toml::node_view<const toml::node> recovery = effective["recovery"];
  const std::string tracking =
      is_swept(simulation, "tracking") ? "swept" : simulation["tracking"].value_or(std::string());
  const std::vector<std::string> all = {
      helped(navigation, "route", navigation["route"].value_or(std::string()) == "around", "local routes"),
      helped(navigation, "monitor", navigation["monitor"].value_or(false), "collision monitor"),
      latency_words(navigation),
      helped(recovery, "retries", recovery["retries"].value_or(0) > 0, "recoveries"),
      replanning_words(simulation),
      "tracking " + tracking,
      parameter_words(toml::parse(experiment_toml)),
      awareness_words(effective)};
  std::string words;
  for (const std::string& one : all)
    if (!one.empty()) words += (words.empty() ? "" : ", ") + one;
  return words;
}

std::string conditions_of_run(const std::filesystem::path& run_directory) {
  const auto text = [&](const char* name) { return read_file(run_directory / name, (run_directory / name).string()); };
  return conditions_words(text("effective.toml"), text("experiment.toml"));
}

}  // namespace dmrp::host
