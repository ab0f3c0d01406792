// SPDX-License-Identifier: MIT
// bench_controllers: measures the time of a control cycle. Drives trials in closed loop, records the input of each
// controller, and replays it to fresh instances, timing each call alone; the commands must be the same to the bit.
//
//   controller/ID/cycle/median, /p99     ms of one step() on the mall with its people, CBS plans, agents tracked
//   controller/ID/crowd/median, /p99     the same for a robot among 20 people and boxes in a hall of 12 m
//   controller/ID/allocations            blocks allocated per cycle on the mall, after the first second
//   controller/ID/iterations             a cycle on the mall, where the controller notes "iterations N" for the trace
//
// The sensors are not measured: their output is recorded.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "host/experiment/experiment.hpp"
#include "host/plugins/calls/call_guard.hpp"
#include "host/workers/supervisor.hpp"
#include "tests/bench/bench_controllers_allocations.hpp"
#include "tests/bench/bench_controllers_trial.hpp"
#include "tests/bench/bench_rows.hpp"

namespace {

using namespace dmrp;
namespace fs = std::filesystem;

constexpr std::size_t warm_up_calls = 10;

struct Options {
  std::vector<std::string> controllers;
  std::vector<std::string> settings;  // key=value
  std::string parameters;             // file
  bool quick = false;
  bench::Output output;
};

// All calls on one scenario.
struct Measured {
  std::vector<double> call_ms;
  std::uint64_t calls = 0;        // after warming up ...
  std::uint64_t allocations = 0;  // ... and what these allocated
  double iterations = 0.0;        // the sum ...
  std::uint64_t annotated = 0;    // ... over the calls that annotated them
  std::uint32_t robots = 0;
  std::uint32_t arrived = 0;
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

// A value in TOML's syntax: everything except numbers, booleans and arrays is a string.
std::string toml_value(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  const bool is_number = !text.empty() && *end == '\0';
  return is_number || text == "true" || text == "false" || text.starts_with("[") ? text : "\"" + text + "\"";
}

std::string experiment_text(const Options& options, const std::string& controller, const std::string& scenario,
                            int trials) {
  std::string text = fmt::format(
      "[experiment]\nname = \"bench\"\nseed = 1\ntrials = {}\n"
      "plugins = [\"libdmrp_planners.so\", \"libdmrp_controllers.so\", \"libdmrp_pedestrians.so\"]\n"
      "[[scenario]]\nuse = \"{}\"\n[[global_planner]]\nuse = \"dmrp.planner.cbs\"\n"
      "[[pedestrian_model]]\nuse = \"dmrp.pedestrian.social_force\"\n"
      "[simulation]\ntracking = \"visible\"\n[[local_controller]]\nuse = \"{}\"\n",
      trials, scenario, controller);
  if (!options.parameters.empty())
    text += fmt::format("params_file = \"{}\"\n", fs::absolute(options.parameters).string());
  text += "params = {";
  for (std::size_t i = 0; i < options.settings.size(); ++i) {
    const std::string& setting = options.settings[i];
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) throw std::runtime_error("--set needs key=value, not " + setting);
    text +=
        fmt::format("{} {} = {}", i == 0 ? "" : ",", setting.substr(0, equals), toml_value(setting.substr(equals + 1)));
  }
  return text + " }\n";
}

host::Experiment load(const std::string& text) {
  const fs::path file = fs::temp_directory_path() / fmt::format("bench_controllers_{}.toml", getpid());
  std::ofstream(file) << text;
  const auto read_descriptors = [](const fs::path& library_file, const host::VisiblePaths&) {
    const host::Library library(library_file);
    return host::Probe{library.plugins(), library.warnings(), library.objects(), ""};
  };
  try {
    host::Experiment experiment = host::load_experiment(file, 0, read_descriptors);
    fs::remove(file);
    return experiment;
  } catch (...) {
    fs::remove(file);
    throw;
  }
}

void add_trial(const bench::TrialUnderTest& trial, host::InstancePool& pool, int replays, Measured& measured) {
  const bench::RecordedTrial recorded = bench::record(trial, pool);
  measured.robots += static_cast<std::uint32_t>(recorded.tapes.size());
  measured.arrived += recorded.arrived;
  for (std::uint32_t robot = 0; robot < recorded.tapes.size(); ++robot) {
    const bench::Tape& tape = recorded.tapes[robot];
    // the minimum time of each call: the work is the same in every replay, only disturbances differ
    std::vector<double> least_ms(tape.size(), 1e9);
    for (int i = 0; i < replays; ++i) {
      const bench::Replay replay = bench::replay(trial, pool, robot, tape, false);
      for (std::size_t k = 0; k < tape.size(); ++k) least_ms[k] = std::min(least_ms[k], replay.call_ms[k]);
      for (std::size_t k = warm_up_calls; i == 0 && k < tape.size(); ++k) {
        measured.allocations += replay.allocations[k];
        ++measured.calls;
      }
    }
    measured.call_ms.insert(measured.call_ms.end(), least_ms.begin(), least_ms.end());
    const bench::Replay told = bench::replay(trial, pool, robot, tape, true);
    measured.iterations = std::accumulate(told.iterations.begin(), told.iterations.end(), measured.iterations);
    measured.annotated += told.iterations.size();
  }
}

Measured measure(const Options& options, const std::string& controller, const std::string& scenario, int trials) {
  const host::Experiment experiment = load(experiment_text(options, controller, scenario, trials));
  const host::VariantWorld variant(experiment, experiment.scenarios[0]);
  host::CallNote note{};
  host::CallGuard guard(note);
  const std::uint64_t before = bench::allocations();
  host::InstancePool pool(experiment.libraries, guard, [](std::int32_t, const std::string&, const std::string&) {});
  pool.get(experiment.local_controllers[0], 0);
  if (bench::allocations() == before) throw std::runtime_error("allocations of plugins are not counted");
  Measured measured;
  for (int k = 0; k < trials; ++k)
    add_trial({experiment, variant, host::trial_seed(experiment, static_cast<std::uint64_t>(k))}, pool,
              options.quick ? 1 : 3, measured);
  return measured;
}

void add_rows(const std::string& name, const Measured& measured, std::vector<bench::Row>& rows) {
  rows.push_back({name + "/median", quantile(measured.call_ms, 0.5), "ms"});
  rows.push_back({name + "/p99", quantile(measured.call_ms, 0.99), "ms"});
}

std::vector<bench::Row> rows_of(const Options& options, const std::string& controller) {
  std::vector<bench::Row> rows;
  const std::string name = "controller/" + controller;
  const Measured mall = measure(options, controller, "mall", options.quick ? 1 : 3);
  add_rows(name + "/cycle", mall, rows);
  const Measured crowd = measure(options, controller, DMRP_BENCH_FOLDER "/crowd/scenario.toml", 1);
  add_rows(name + "/crowd", crowd, rows);
  rows.push_back({name + "/allocations",
                  static_cast<double>(mall.allocations) / std::max(1.0, static_cast<double>(mall.calls)), "1"});
  if (mall.annotated > 0)
    rows.push_back({name + "/iterations", mall.iterations / static_cast<double>(mall.annotated), "1"});
  std::fprintf(stderr, "%s: mall %u of %u home, %zu cycles; crowd %u of %u, %zu cycles\n", controller.c_str(),
               mall.arrived, mall.robots, mall.call_ms.size(), crowd.arrived, crowd.robots, crowd.call_ms.size());
  return rows;
}

// All controllers of the library; used if none is chosen.
std::vector<std::string> known_controllers() {
  std::vector<std::string> ids;
  const host::Library library(host::find_library("libdmrp_controllers.so", ""));
  for (const host::PluginInfo& plugin : library.plugins()) ids.push_back(plugin.id);
  return ids;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Measures a cycle of local controllers on recorded trials.");
  app.add_option("--controller", options.controllers, "only this one (its id)")->allow_extra_args(false);
  app.add_option("--set", options.settings, "a parameter: key=value")->allow_extra_args(false);
  app.add_option("--params", options.parameters, "a parameter set (TOML)")->check(CLI::ExistingFile);
  app.add_flag("--quick", options.quick, "one trial, every call timed once");
  app.add_flag("--json", options.output.json, "a list of name, value, unit");
  app.add_option("--csv", options.output.csv, "append the values to this file")->type_name("FILE");
  CLI11_PARSE(app, argc, argv);
  try {
    std::vector<bench::Row> rows;
    for (const std::string& id : options.controllers.empty() ? known_controllers() : options.controllers) {
      const std::vector<bench::Row> more = rows_of(options, id);
      rows.insert(rows.end(), more.begin(), more.end());
    }
    bench::write_rows(rows, options.output);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_controllers: %s\n", error.what());
    return 1;
  }
  return 0;
}
