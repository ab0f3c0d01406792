// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/experiment/experiment.hpp"
#include "host/experiment/settings_tables.hpp"
#include "host/plugins/parameter_text.hpp"
#include "host/program/executable.hpp"
#include "host/scenario/find_scenario.hpp"
#include "host/scenario/robot_tables.hpp"
#include "host/toml/toml_text.hpp"

namespace dmrp::host {

namespace {

bool is_finite(const ParameterValue& value) {
  return std::isfinite(value.number) &&
         std::all_of(value.numbers.begin(), value.numbers.end(), [](double number) { return std::isfinite(number); });
}

// A default need not name a file.
std::string value_text(const ParameterValue& value, const FileName& name) {
  std::error_code ignored;
  if (value.type != DMRP_PARAM_PATH || !std::filesystem::is_regular_file(value.text, ignored)) return toml_text(value);
  return toml_text(name(value.text));
}

// What comes with the host by its name alone, unless it has a name of its own: every installation finds its own.
std::string name_anywhere(const std::filesystem::path& file, const std::string& shipped_name, const FileName& name) {
  const std::string given = name(file);
  return given != file || shipped_name.empty() ? given : shipped_name;
}

void write_uses(std::string& out, std::uint32_t kind, const std::vector<PluginUse>& uses, const FileName& name) {
  for (const PluginUse& use : uses) {
    const std::string source =
        use.plans.is_given() ? "file  = " + toml_text(name(use.plans.name)) : "use   = " + toml_text(use.info.id);
    out += fmt::format("\n[[{}]]\n{}\nlabel = {}\n", kind_name(kind), source, toml_text(use.label));
    if (use.plans.is_given() && use.info.connectivity == DMRP_CONNECTIVITY_ANY) out += "any_angle = true\n";
    if (use.control_latency_ns)
      out += fmt::format("control_latency_s = {}\n", toml_text(static_cast<double>(*use.control_latency_ns) / 1e9));
    if (use.bound != Bound::none) out += fmt::format("bound = \"{}\"\n", use.bound == Bound::lower ? "lower" : "upper");
    if (use.parameters.empty()) continue;
    out += fmt::format("[{}.params]\n", kind_name(kind));
    // A default may be infinite or NaN, which an experiment file cannot set: it becomes a comment.
    for (const ParameterValue& value : use.parameters)
      out += fmt::format("{}{} = {}\n", is_finite(value) ? "" : "# ", toml_key(value.key), value_text(value, name));
  }
}

void write_shares(std::string& out, const ScenarioVariant& variant) {
  std::string shares;
  for (const core::TypeShare& one : variant.drawn_types)
    shares += fmt::format("{}{} = {}", shares.empty() ? "" : ", ",
                          toml_key(one.type.empty() ? default_type_name : one.type), toml_text(one.share));
  if (!shares.empty()) out += fmt::format("types  = {{ {} }}\n", shares);
}

std::string tasks_text(const core::TaskWishes& wishes) {
  if (wishes.drawn == 0) return "\"drawn\"";
  std::string out = fmt::format("{{ drawn = {}, conflicts_min = {}", wishes.drawn, wishes.conflicts_min);
  if (wishes.conflicts_max != core::any_number) out += fmt::format(", conflicts_max = {}", wishes.conflicts_max);
  return out + fmt::format(", crossing = \"{}\" }}", wishes.crossing == core::Crossing::any ? "any" : "corridor");
}

void write_people(std::string& out, const PeopleChange& people) {
  if (!people.key) return;
  const std::string value = fmt::format("{}", people.value);
  out += fmt::format("{} = {}\n", people.key, people.listed ? "[" + value + "]" : value);
}

// Without those that differ from the one before in swept settings alone: a file's sweep makes them anew.
std::vector<ScenarioVariant> without_settings_sweep(const Experiment& experiment) {
  std::size_t points = 1;
  for (const SettingsSweep& sweep : experiment.sweeps) points *= sweep.values.size();
  std::vector<ScenarioVariant> out;
  for (std::size_t i = 0; i < experiment.scenarios.size(); i += points) out.push_back(experiment.scenarios[i]);
  return out;
}

// The random tasks for one number of robots depend on the other numbers of the same [[scenario]].
void write_scenarios(std::string& out, const std::vector<ScenarioVariant>& scenarios, const FileName& name) {
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    const ScenarioVariant& variant = scenarios[i];
    std::string robots = std::to_string(robot_count(variant));
    if (variant.most_drawn > 0) {
      for (; i + 1 < scenarios.size() && scenarios[i + 1].entry == variant.entry; ++i)
        robots += fmt::format(", {}", robot_count(scenarios[i + 1]));
      robots = "[" + robots + "]";
    }
    const std::string use = name_anywhere(variant.file, name_of_shipped_scenario(variant.file), name);
    out += fmt::format("\n[[scenario]]\nuse    = {}\nrobots = {}\n", toml_text(use), robots);
    if (variant.most_drawn > 0) out += fmt::format("tasks  = {}\n", tasks_text(variant.wishes));
    write_shares(out, variant);
    if (!variant.grade.series.empty()) out += fmt::format("levels = [{}]\n", toml_text(variant.grade.level));
    if (const StartJitter& jitter = variant.jitter; jitter.position_m > 0.0 || jitter.heading_rad > 0.0)
      out += fmt::format("start_jitter = {{ position_m = {}, heading_rad = {} }}\n", toml_text(jitter.position_m),
                         toml_text(jitter.heading_rad));
    write_people(out, variant.people);
  }
}

}  // namespace

std::string absolute_name(const std::filesystem::path& file) {
  return file.string();
}

std::string effective_toml(const Experiment& experiment, const FileName& name) {
  std::string out = "[experiment]\n";
  out += fmt::format("name    = {}\nseed    = {}\ntrials  = {}\n", toml_text(experiment.name), experiment.seed,
                     experiment.trials);
  std::vector<std::string> libraries;
  for (const LibraryUse& library : experiment.libraries)
    libraries.push_back(name_anywhere(library.file, name_of_own_library(library.file), name));
  out += "plugins = " + toml_text(libraries) + "\n";
  write_scenarios(out, without_settings_sweep(experiment), name);
  write_uses(out, DMRP_KIND_GLOBAL_PLANNER, experiment.global_planners, name);
  write_uses(out, DMRP_KIND_LOCAL_CONTROLLER, experiment.local_controllers, name);
  write_uses(out, DMRP_KIND_PEDESTRIAN_MODEL, experiment.pedestrian_models, name);
  write_uses(out, DMRP_KIND_METRIC, experiment.metrics, name);
  return out + settings_text(experiment);
}

}  // namespace dmrp::host
