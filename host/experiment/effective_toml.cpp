// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "host/experiment/experiment.hpp"
#include "host/plugins/parameter_text.hpp"
#include "host/toml/toml_text.hpp"

namespace dmrp::host {

namespace {

std::string seconds(std::int64_t ns) {
  return toml_text(static_cast<double>(ns) / 1e9);
}

bool is_finite(const ParameterValue& value) {
  return std::isfinite(value.number) &&
         std::all_of(value.numbers.begin(), value.numbers.end(), [](double number) { return std::isfinite(number); });
}

// Bare where TOML allows it.
std::string key(const std::string& name) {
  const auto bare = [](unsigned char c) { return c < 0x80 && (std::isalnum(c) || c == '_' || c == '-'); };
  return std::all_of(name.begin(), name.end(), bare) ? name : toml_text(name);
}

void write_uses(std::string& out, std::uint32_t kind, const std::vector<PluginUse>& uses) {
  for (const PluginUse& use : uses) {
    out += fmt::format("\n[[{}]]\nuse   = {}\nlabel = {}\n", kind_name(kind), toml_text(use.info.id),
                       toml_text(use.label));
    if (use.parameters.empty()) continue;
    out += fmt::format("[{}.params]\n", kind_name(kind));
    // A default may be infinite or undefined, which nobody can write: told in a comment.
    for (const ParameterValue& value : use.parameters)
      out += fmt::format("{}{} = {}\n", is_finite(value) ? "" : "# ", key(value.key), toml_text(value));
  }
}

// What robots are drawn for one number depends on the others that stand with it.
void write_scenarios(std::string& out, const std::vector<ScenarioVariant>& scenarios) {
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    const ScenarioVariant& variant = scenarios[i];
    std::string robots = std::to_string(robot_count(variant));
    if (variant.most_drawn > 0) {
      for (; i + 1 < scenarios.size() && scenarios[i + 1].entry == variant.entry; ++i)
        robots += fmt::format(", {}", robot_count(scenarios[i + 1]));
      robots = "[" + robots + "]";
    }
    out += fmt::format("\n[[scenario]]\nuse    = {}\nrobots = {}\n", toml_text(variant.file.string()), robots);
    if (variant.all_drawn) out += "tasks  = \"drawn\"\n";
  }
}

void write_simulation(std::string& out, const Experiment& experiment) {
  const core::SimulationSettings& s = experiment.simulation;
  static constexpr const char* const tracking[] = {"none", "visible", "all"};
  static constexpr const char* const dispatch[] = {"full_path", "waypoint"};
  static constexpr const char* const execution[] = {"free", "ordered"};
  out += "\n[simulation]\n";
  out += fmt::format("step_s                     = {}\n", seconds(s.step_ns));
  out += fmt::format("control_period_s           = {}\n", seconds(s.control_period_ns));
  if (experiment.time_limit_set) out += fmt::format("time_limit_s               = {}\n", seconds(s.time_limit_ns));
  out += fmt::format("grid_resolution_m          = {}\n", toml_text(s.grid_resolution_m));
  out += fmt::format("step_duration_s            = {}\n", seconds(s.step_duration_ns));
  out += fmt::format("control_latency_s          = {}\n", seconds(s.control_latency_ns));
  out += fmt::format("planning_latency_s         = {}\n", seconds(s.planning_latency_ns));
  out += fmt::format("planning_margin_m          = {}\n", toml_text(s.planning_margin_m));
  out += fmt::format("tracking                   = \"{}\"\n", tracking[static_cast<int>(s.tracking)]);
  out += fmt::format("tracking_range_m           = {}\n", toml_text(s.tracking_range_m));
  out += fmt::format("tracking_velocity_noise_sd = {}\n", toml_text(s.tracking_velocity_noise_sd));
  out += fmt::format("goal_tolerance_m           = {}\n", toml_text(s.goal.tolerance_m));
  out += fmt::format("goal_tolerance_rad         = {}\n", toml_text(s.goal.tolerance_rad));
  out += fmt::format("goal_tolerance_speed       = {}\n", toml_text(s.goal.tolerance_speed));
  out += fmt::format("goal_settle_s              = {}\n", toml_text(s.goal.settle_s));
  out += fmt::format("dispatch                   = \"{}\"\n", dispatch[static_cast<int>(s.dispatch)]);
  out += fmt::format("execution                  = \"{}\"\n", execution[static_cast<int>(s.execution)]);
  out += fmt::format("replan_period_s            = {}\n", seconds(s.replan.period_ns));
  out += fmt::format("replan_stray_m             = {}\n", toml_text(s.replan.stray_m));
  out += fmt::format("replan_stall_s             = {}\n", seconds(s.replan.stall_ns));
  out += fmt::format("replan_min_interval_s      = {}\n", seconds(s.replan.min_interval_ns));
}

void write_robot(std::string& out, const core::RobotSettings& r) {
  out += "\n[robot]\n";
  out += fmt::format("footprint = {{ radius_m = {} }}\n", toml_text(r.radius_m));
  out += fmt::format("v_min     = {}\nv_max     = {}\nomega_max = {}\na_max     = {}\nalpha_max = {}\n",
                     toml_text(r.v_min), toml_text(r.v_max), toml_text(r.omega_max), toml_text(r.a_max),
                     toml_text(r.alpha_max));
  const auto& noise = r.odometry.noise;
  out += fmt::format("actuation_latency_s = {}\n", seconds(r.actuation_latency_ns));
  out += fmt::format("odometry  = {{ noise = [{}, {}, {}, {}], fix_period_s = {} }}\n", toml_text(noise[0]),
                     toml_text(noise[1]), toml_text(noise[2]), toml_text(noise[3]), seconds(r.odometry.fix_period_ns));
  out += fmt::format(
      "lidar     = {{ beams = {}, field_of_view_rad = {}, range_min_m = {}, range_max_m = {}, noise_sd_m = {}, "
      "dropout_share = {} }}\n",
      r.lidar.beams, toml_text(r.lidar.field_of_view_rad), toml_text(r.lidar.range_min_m),
      toml_text(r.lidar.range_max_m), toml_text(r.lidar.noise_sd_m), toml_text(r.lidar.dropout_share));
  const core::CostmapSettings& c = r.costmap;
  out += fmt::format(
      "costmap   = {{ resolution_m = {}, window_m = {}, obstacle_range_m = {}, raytrace_range_m = {}, "
      "inflation_radius_m = {}, cost_scaling = {} }}\n",
      toml_text(c.resolution_m), toml_text(c.window_m), toml_text(c.obstacle_range_m), toml_text(c.raytrace_range_m),
      toml_text(c.inflation_radius_m), toml_text(c.cost_scaling));
}

}  // namespace

std::string effective_toml(const Experiment& experiment) {
  std::string out = "[experiment]\n";
  out += fmt::format("name    = {}\nseed    = {}\ntrials  = {}\n", toml_text(experiment.name), experiment.seed,
                     experiment.trials);
  std::vector<std::string> libraries;
  for (const LibraryUse& library : experiment.libraries) libraries.push_back(library.file.string());
  out += "plugins = " + toml_text(libraries) + "\n";
  write_scenarios(out, experiment.scenarios);
  write_uses(out, DMRP_KIND_GLOBAL_PLANNER, experiment.global_planners);
  write_uses(out, DMRP_KIND_LOCAL_CONTROLLER, experiment.local_controllers);
  write_uses(out, DMRP_KIND_PEDESTRIAN_MODEL, experiment.pedestrian_models);
  write_uses(out, DMRP_KIND_METRIC, experiment.metrics);
  write_simulation(out, experiment);
  write_robot(out, experiment.robot);
  static constexpr const char* const traces[] = {"all", "failed", "none"};
  out += fmt::format("\n[record]\ntraces      = \"{}\"\nscans       = {}\nannotations = {}\n",
                     traces[static_cast<int>(experiment.traces)], experiment.scans, experiment.annotations);
  const RunLimits& l = experiment.limits;
  out += fmt::format(
      "\n[limits]\nplanner_time_s    = {}\nstep_time_s       = {}\ntrial_wall_time_s = {}\nmemory_mb         = {}\n",
      toml_text(l.planner_time_s), toml_text(l.step_time_s), toml_text(l.trial_wall_time_s), l.memory_mb);
  return out;
}

}  // namespace dmrp::host
