// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <set>

#include "host/commands/command_output.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/run_directory.hpp"
#include "host/commands/run_results.hpp"
#include "host/errors/input_error.hpp"
#include "host/experiment/experiment.hpp"
#include "host/files/atomic_file.hpp"
#include "host/files/read_file.hpp"
#include "host/files/sync_directory.hpp"
#include "host/plan/check_planners.hpp"
#include "host/plugins/check_descriptor.hpp"
#include "host/process/box.hpp"
#include "host/program/executable.hpp"
#include "host/program/version.hpp"
#include "host/results/database.hpp"
#include "host/results/manifest.hpp"
#include "host/results/summary_layout.hpp"
#include "host/terminal/progress.hpp"
#include "host/workers/supervisor.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

// The type of each robot; empty if all are of one type.
std::vector<std::string> types_of_robots(const ScenarioVariant& variant) {
  std::vector<std::string> types = core::drawn_types(variant.drawn_types, variant.drawn_robots);
  for (const core::RobotTask& task : variant.scenario.robots) types.push_back(task.type);
  for (std::string& type : types)
    if (type.empty()) type = "default";
  if (std::all_of(types.begin(), types.end(), [&](const std::string& type) { return type == types[0]; })) return {};
  return types;
}

std::vector<MetricColumn> columns_of(const Experiment& experiment) {
  std::vector<MetricColumn> columns;
  for (const PluginUse& use : experiment.metrics)
    for (const MetricValueSpec& value : use.info.values)
      columns.push_back({value.name, value.unit, value.direction, value.wall_clock, value.description,
                         !is_reserved_id(use.info.id) && !value.curve});
  return columns;
}

std::vector<std::uint64_t> trials_of_shard(std::uint64_t count, const Shard& shard) {
  std::vector<std::uint64_t> trials;
  for (std::uint64_t k = shard.index; k < count; k += shard.count) trials.push_back(k);
  return trials;
}

// "quickstart · mall · 4 robots, 12 people · 3 trials"
std::string heading(const Experiment& experiment, std::size_t trials) {
  std::string out = experiment.name;
  if (experiment.scenarios.size() == 1) {
    const core::Scenario& scenario = experiment.scenarios[0].scenario;
    const std::uint32_t robots = robot_count(experiment.scenarios[0]);
    out += fmt::format(" · {} · {}", scenario.name, robots == 0 ? "no robots" : plural(robots, "robot"));
    const auto people = core::person_count(scenario);
    out += people == 0 ? ", no people" : fmt::format(", {} {}", people, people == 1 ? "person" : "people");
  } else {
    out += " · " + plural(experiment.scenarios.size(), "scenario");
  }
  return out + " · " + plural(trials, "trial");
}

// A line for the terminal.
std::string fault_note(std::uint64_t trial, const FaultRecord& fault) {
  std::string note = fmt::format("trial {}: {}", trial, fault.kind);
  if (!fault.plugin.empty()) note += fmt::format(" in {} {}()", fault.plugin, fault.function);
  if (fault.robot >= 0) note += fmt::format(", robot {}", fault.robot);
  return note + ": " + fault.detail;
}

// "" if the trial has none.
std::string fault_note(const TrialRecord& trial) {
  return trial.faults.empty() ? "" : fault_note(trial.id, trial.faults.front());
}

ExperimentFacts facts_of(const Experiment& experiment, const Shard& shard, std::uint64_t trials_planned) {
  ExperimentFacts facts{experiment.name, experiment.seed, experiment.trials, shard, trials_planned, {}};
  for (const ScenarioVariant& variant : experiment.scenarios) {
    const core::Scenario& scenario = variant.scenario;
    const double time_limit_s = experiment.time_limit_set
                                    ? static_cast<double>(experiment.simulation.time_limit_ns) / 1e9
                                    : scenario.time_limit_s;
    const Grade& grade = variant.grade;
    facts.scenarios.push_back({scenario.name, scenario.title, scenario.description, robot_count(variant),
                               core::person_count(scenario), time_limit_s, types_of_robots(variant), grade.series,
                               grade.quantity, grade.unit, grade.harder_when_higher, grade.level});
  }
  return facts;
}

// The files and settings that the run depends on, beside the experiment's text.
Manifest manifest_of(const Experiment& experiment, const Shard& shard, std::uint64_t trials_planned,
                     const std::vector<std::string>& command_line) {
  Manifest manifest = new_manifest(version, command_line, std::chrono::system_clock::now());
  manifest.experiment = facts_of(experiment, shard, trials_planned);
  for (const LibraryUse& library : experiment.libraries)
    manifest.files.push_back(hashed_file("plugin library", library.file));
  std::set<fs::path> scenarios;
  for (const ScenarioVariant& variant : experiment.scenarios) {
    scenarios.insert(variant.file);
    scenarios.insert(variant.files.begin(), variant.files.end());
  }
  for (const fs::path& file : scenarios) manifest.files.push_back(hashed_file("scenario", file));
  std::set<fs::path> parameters;
  for (const auto* uses :
       {&experiment.global_planners, &experiment.local_controllers, &experiment.pedestrian_models, &experiment.metrics})
    for (const PluginUse& use : *uses) {
      if (!use.parameter_file.empty()) parameters.insert(use.parameter_file);
      for (const ParameterValue& value : use.parameters)
        if (value.type == DMRP_PARAM_PATH && !value.text.empty()) parameters.insert(value.text);
    }
  for (const fs::path& file : parameters) manifest.files.push_back(hashed_file("parameter", file));
  return manifest;
}

class RunFiles {
 public:
  RunFiles(const RunOptions& options, const Experiment& experiment, const Manifest& manifest)
      : directory_(options.resume ? RunDirectory::reopen(options.out)
                                  : RunDirectory::make(options.out, experiment.name)) {
    if (fs::exists(database()))
      check_same(experiment, manifest);
    else
      begin(experiment, manifest);
  }

  const fs::path& directory() const { return directory_.path(); }
  fs::path database() const { return directory() / "results.sqlite"; }

 private:
  void begin(const Experiment& experiment, const Manifest& manifest) const {
    if (experiment.traces != RecordTraces::none) fs::create_directories(directory() / "traces");
    write_file_atomically(directory() / "experiment.toml", experiment.text);
    write_file_atomically(directory() / "effective.toml", effective_toml(experiment));
    write_file_atomically(directory() / "manifest.json", to_json_text(manifest));
    // last, and whole: a run that is killed before has not begun
    const fs::path unfinished = directory() / "results.new";
    for (const char* rest : {"", "-wal", "-shm", "-journal"}) fs::remove(unfinished.string() + rest);
    ResultsDatabase::create(unfinished, columns_of(experiment));
    fs::rename(unfinished, database());
    sync_directory(directory());
  }

  // A run can only be continued if that gives the same bits.
  void check_same(const Experiment& experiment, const Manifest& manifest) const {
    const fs::path effective = directory() / "effective.toml";
    if (read_file(effective, effective.string()) != effective_toml(experiment))
      throw InputError(
          fmt::format("--out {}: was run with another experiment (effective.toml differs)", directory().string()));
    const Manifest before = read_manifest(directory() / "manifest.json");
    if (const Shard& shard = before.experiment.shard; shard.count > 0 && !(shard == manifest.experiment.shard))
      throw InputError(fmt::format("--out {}: is a run of {}, not of {}", directory().string(), shard_text(shard),
                                   shard_text(manifest.experiment.shard)));
    const auto reasons = differences(before, manifest);
    if (!reasons.empty())
      throw InputError(fmt::format("--out {}: cannot be continued: {}", directory().string(), reasons.front()));
  }

  RunDirectory directory_;
};

}  // namespace

int run_command(const RunOptions& options, const std::vector<std::string>& command_line) {
  const Experiment experiment = load_experiment(options.experiment, options.trials);
  check_planners(experiment, options.experiment);
  if (!options.quiet)
    for (const std::string& warning : experiment.warnings) warn(warning);
  if (const std::string gaps = box::gaps(); !options.quiet && !gaps.empty()) warn(gaps);

  const SummaryLayout layout = read_summary_layout(shared_data_path() / "layouts/summary.json");
  const std::uint64_t count = combinations(experiment).size() * experiment.trials;
  std::vector<std::uint64_t> trials = trials_of_shard(count, options.shard);
  const RunFiles files(options, experiment, manifest_of(experiment, options.shard, trials.size(), command_line));
  ResultsDatabase database = ResultsDatabase::open(files.database());
  const auto finished = database.finished_trials(options.retry_faults ? ResultsDatabase::Finished::without_faults
                                                                      : ResultsDatabase::Finished::all);
  std::erase_if(trials, [&](std::uint64_t k) { return std::binary_search(finished.begin(), finished.end(), k); });

  Progress progress(heading(experiment, trials.size()), trials.size(), options.quiet || options.json);
  const SupervisorSettings settings = {options.jobs, files.directory(), count};
  const SupervisorSinks sinks = {[&](TrialRecord&& trial) {
                                   database.write(trial);
                                   progress.add(fault_note(trial));
                                 },
                                 [&](std::uint64_t trial, const FaultRecord& fault) {
                                   database.add_fault(trial, fault);
                                   progress.note(fault_note(trial, fault));
                                 },
                                 [&](const std::string& text) { progress.note("warning: " + text); },
                                 [&] { progress.refresh(); }};
  const RunEnding ending = supervise(experiment, trials, settings, sinks);
  progress.finish();
  const RunResults results = read_results(std::move(database), layout);
  write_tables(results, files.directory());
  const bool reported = try_to_report(results, files.directory());
  if (options.json)
    print_results_as_json(results, layout, files.directory());
  else if (!options.quiet)
    print_results(results, layout, files.directory(), reported, facts_of(experiment, options.shard, count).scenarios);
  if (ending == RunEnding::interrupted) {
    fmt::print(stderr, "interrupted: finished trials are kept; continue with --resume --out {}\n",
               files.directory().string());
    return exit_status::interrupted;
  }
  const bool faults = std::any_of(results.trials.begin(), results.trials.end(),
                                  [](const TrialRecord& trial) { return !trial.faults.empty(); });
  return faults ? exit_status::faults : exit_status::done;
}

}  // namespace dmrp::host
