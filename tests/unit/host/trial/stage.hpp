// SPDX-License-Identifier: MIT
// stage.hpp: trials and their metrics in this process, with the plugins of one library.
#pragma once

#include <filesystem>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/trace/trace_reader.hpp"
#include "host/trial/ask_metric.hpp"
#include "host/trial/run_trial.hpp"
#include "tests/unit/core/trace/trace_in_memory.hpp"

namespace dmrp::test {

// With the default parameters.
inline host::PluginUse use_of(const std::vector<host::PluginInfo>& plugins, const std::string& id) {
  for (const host::PluginInfo& info : plugins) {
    if (info.id != id) continue;
    host::PluginUse use = {0, info, id, {}};
    for (const host::ParameterSpec& spec : info.parameters) use.parameters.push_back(spec.fallback);
    return use;
  }
  throw std::runtime_error("no plugin " + id);
}

// An empty hall of 10 x 6 m; the goal of the first robot lies off its cell's centre.
inline core::Scenario hall(std::size_t robots) {
  core::Scenario scenario;
  scenario.name = "hall";
  scenario.upper = {10.0, 6.0};
  scenario.time_limit_s = 40.0;
  for (std::size_t i = 0; i < robots; ++i) {
    const double y = 1.5 + 2.0 * static_cast<double>(i);
    const double any_heading = std::numeric_limits<double>::quiet_NaN();
    scenario.robots.push_back({"r" + std::to_string(i), {1.5, y, 0.0}, {{i == 0 ? 8.8 : 8.5, y, any_heading}}});
  }
  return scenario;
}

// The ids of a trial's plugins; "" for none.
struct Cast {
  std::string planner;
  std::string controller;
  std::string people;
  std::string metric;
};

// A line that a plugin logged.
struct LogLine {
  std::int32_t level;
  std::string plugin;
  std::string text;
};

// Runs trials one after the other with the same instances, as a worker does. Change the experiment before the first.
struct Stage {
  Stage(const std::filesystem::path& library, const Cast& cast, core::Scenario scenario) {
    experiment.libraries = {{library.filename().string(), library, {}}};
    const host::Library loaded(library);
    const auto use = [&](std::vector<host::PluginUse>& uses, const std::string& id) {
      if (!id.empty()) uses = {use_of(loaded.plugins(), id)};
      return id.empty() ? -1 : 0;
    };
    combination = {0, use(experiment.global_planners, cast.planner), use(experiment.local_controllers, cast.controller),
                   use(experiment.pedestrian_models, cast.people)};
    use(experiment.metrics, cast.metric);
    experiment.scenarios = {{std::move(scenario), "hall", ""}};
    experiment.robot.lidar.beams = 36;
    guests = std::make_unique<host::Guests>(host::Guests::local(
        experiment.libraries, note, guard, [this](std::int32_t level, const auto& plugin, const auto& text) {
          log.push_back({level, plugin, text});
        }));
  }

  // Builds the world, once.
  void open() {
    if (!variant) variant = std::make_unique<host::VariantWorld>(experiment, experiment.scenarios[0]);
  }

  host::TrialEnding run() {
    open();
    trace = std::make_unique<TraceInMemory>(variant->view.world());
    guests->begin_trial({0, variant->simulation.step_ns});
    const host::TrialEnding ending = run_trial({experiment, combination, *variant, 1, first_plan}, *guests, **trace);
    reader = std::make_unique<core::TraceReader>(trace->bytes());
    return ending;
  }

  host::MetricResult measured() {
    const auto robots = static_cast<std::uint32_t>(variant->scenario.robots.size());
    return ask_metric(*guests, experiment.metrics[0], 0, {trace->bytes(), variant.get(), robots, 1}, 1.0);
  }

  // The fault that ends the trial, or the measuring of it.
  host::PluginFault fault() {
    try {
      run();
      if (!experiment.metrics.empty()) measured();
    } catch (const host::PluginFault& fault) {
      return fault;
    }
    throw std::runtime_error("no fault");
  }

  std::vector<LogLine> log;
  host::CallNote note{};
  host::CallGuard guard{note};
  host::Experiment experiment;
  host::Combination combination;
  host::FirstPlan first_plan;
  std::unique_ptr<host::VariantWorld> variant;
  std::unique_ptr<host::Guests> guests;
  std::unique_ptr<TraceInMemory> trace;
  std::unique_ptr<core::TraceReader> reader;
};

}  // namespace dmrp::test
