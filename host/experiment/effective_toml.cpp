// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "host/experiment/experiment.hpp"

namespace dmrp::host {

namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

// The shortest text that reads back as the same double, and as a float of TOML.
std::string number(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
  return text;
}

std::string seconds(std::int64_t ns) {
  return number(static_cast<double>(ns) / 1e9);
}

template <class Items, class Format>
std::string array(const Items& items, Format&& format) {
  std::string out;
  for (const auto& item : items) out += (out.empty() ? "" : ", ") + format(item);
  return "[" + out + "]";
}

std::string parameter(const ParameterValue& value) {
  switch (value.type) {
    case DMRP_PARAM_BOOL:
      return value.integer ? "true" : "false";
    case DMRP_PARAM_INT:
      return fmt::format("{}", value.integer);
    case DMRP_PARAM_DOUBLE:
      return number(value.number);
    case DMRP_PARAM_DOUBLE_ARRAY:
      return array(value.numbers, number);
    case DMRP_PARAM_STRING_ARRAY:
      return array(value.texts, quoted);
    default:
      return quoted(value.text);
  }
}

bool is_finite(const ParameterValue& value) {
  return std::isfinite(value.number) &&
         std::all_of(value.numbers.begin(), value.numbers.end(), [](double number) { return std::isfinite(number); });
}

// Bare where TOML allows it.
std::string key(const std::string& name) {
  const auto bare = [](unsigned char c) { return c < 0x80 && (std::isalnum(c) || c == '_' || c == '-'); };
  return std::all_of(name.begin(), name.end(), bare) ? name : quoted(name);
}

void write_uses(std::string& out, std::uint32_t kind, const std::vector<PluginUse>& uses) {
  for (const PluginUse& use : uses) {
    out += fmt::format("\n[[{}]]\nuse   = {}\nlabel = {}\n", kind_name(kind), quoted(use.info.id), quoted(use.label));
    if (use.parameters.empty()) continue;
    out += fmt::format("[{}.params]\n", kind_name(kind));
    // A default may be infinite or undefined, which nobody can write: told in a comment.
    for (const ParameterValue& value : use.parameters)
      out += fmt::format("{}{} = {}\n", is_finite(value) ? "" : "# ", key(value.key), parameter(value));
  }
}

void write_simulation(std::string& out, const Experiment& experiment) {
  const core::SimulationSettings& s = experiment.simulation;
  static constexpr const char* const tracking[] = {"none", "visible", "all"};
  out += "\n[simulation]\n";
  out += fmt::format("step_s               = {}\n", seconds(s.step_ns));
  out += fmt::format("control_period_s     = {}\n", seconds(s.control_period_ns));
  if (experiment.time_limit_set) out += fmt::format("time_limit_s         = {}\n", seconds(s.time_limit_ns));
  out += fmt::format("grid_resolution_m    = {}\n", number(s.grid_resolution_m));
  out += fmt::format("step_duration_s      = {}\n", seconds(s.step_duration_ns));
  out += fmt::format("planning_margin_m    = {}\n", number(s.planning_margin_m));
  out += fmt::format("tracking             = \"{}\"\n", tracking[static_cast<int>(s.tracking)]);
  out += fmt::format("tracking_range_m     = {}\n", number(s.tracking_range_m));
  out += fmt::format("goal_tolerance_m     = {}\n", number(s.goal.tolerance_m));
  out += fmt::format("goal_tolerance_rad   = {}\n", number(s.goal.tolerance_rad));
  out += fmt::format("goal_tolerance_speed = {}\n", number(s.goal.tolerance_speed));
  out += fmt::format("goal_settle_s        = {}\n", number(s.goal.settle_s));
}

void write_robot(std::string& out, const core::RobotSettings& r) {
  out += "\n[robot]\n";
  out += fmt::format("footprint = {{ radius_m = {} }}\n", number(r.radius_m));
  out += fmt::format("v_min     = {}\nv_max     = {}\nomega_max = {}\na_max     = {}\nalpha_max = {}\n",
                     number(r.v_min), number(r.v_max), number(r.omega_max), number(r.a_max), number(r.alpha_max));
  out += fmt::format("lidar     = {{ beams = {}, field_of_view_rad = {}, range_min_m = {}, range_max_m = {} }}\n",
                     r.lidar.beams, number(r.lidar.field_of_view_rad), number(r.lidar.range_min_m),
                     number(r.lidar.range_max_m));
  const core::CostmapSettings& c = r.costmap;
  out += fmt::format(
      "costmap   = {{ resolution_m = {}, window_m = {}, obstacle_range_m = {}, raytrace_range_m = {}, "
      "inflation_radius_m = {}, cost_scaling = {} }}\n",
      number(c.resolution_m), number(c.window_m), number(c.obstacle_range_m), number(c.raytrace_range_m),
      number(c.inflation_radius_m), number(c.cost_scaling));
}

}  // namespace

std::string effective_toml(const Experiment& experiment) {
  std::string out = "[experiment]\n";
  out += fmt::format("name    = {}\nseed    = {}\ntrials  = {}\n", quoted(experiment.name), experiment.seed,
                     experiment.trials);
  out += "plugins = " +
         array(experiment.libraries, [](const LibraryUse& library) { return quoted(library.file.string()); }) + "\n";
  for (const ScenarioVariant& variant : experiment.scenarios)
    out += fmt::format("\n[[scenario]]\nuse    = {}\nrobots = {}\n", quoted(variant.file.string()),
                       variant.scenario.robots.size());
  write_uses(out, DMRP_KIND_GLOBAL_PLANNER, experiment.global_planners);
  write_uses(out, DMRP_KIND_LOCAL_CONTROLLER, experiment.local_controllers);
  write_uses(out, DMRP_KIND_PEDESTRIAN_MODEL, experiment.pedestrian_models);
  write_uses(out, DMRP_KIND_METRIC, experiment.metrics);
  write_simulation(out, experiment);
  write_robot(out, experiment.robot);
  static constexpr const char* const traces[] = {"all", "failed", "none"};
  out += fmt::format("\n[record]\ntraces = \"{}\"\n", traces[static_cast<int>(experiment.traces)]);
  const RunLimits& l = experiment.limits;
  out += fmt::format(
      "\n[limits]\nplanner_time_s    = {}\nstep_time_s       = {}\ntrial_wall_time_s = {}\nmemory_mb         = {}\n",
      number(l.planner_time_s), number(l.step_time_s), number(l.trial_wall_time_s), l.memory_mb);
  return out;
}

}  // namespace dmrp::host
