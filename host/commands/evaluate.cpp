// SPDX-License-Identifier: MIT
// Measures the stored traces of a run, with the run's metrics or others.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/trace/trace_reader.hpp"
#include "host/commands/command.hpp"
#include "host/commands/command_output.hpp"
#include "host/errors/input_error.hpp"
#include "host/errors/machine_error.hpp"
#include "host/evaluate/evaluation.hpp"
#include "host/guests/command_guests.hpp"
#include "host/guests/guest_end.hpp"
#include "host/results/csv.hpp"
#include "host/results/database.hpp"
#include "host/results/trace_path.hpp"
#include "host/results/trial_record.hpp"
#include "host/trial/ask_metric.hpp"
#include "host/trial/kept_trace.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

struct StoredTrial {
  std::uint64_t id = 0;
  std::uint64_t seed = 0;
  double sim_time_s = 0.0;
  fs::path trace;
};

// Receive the results in the order of the trials and, for each trial, of the metrics.
struct MeasureSinks {
  std::function<void(const StoredTrial&, const MetricResult&)> result;
  std::function<void(const StoredTrial&, const std::string& text)> failure;  // of a metric or a trace; one line
};

// Measures stored traces in guests: a metric that crashes, hangs or takes all memory loses its own values of that trial
// only.
class Measurer {
 public:
  Measurer(const Evaluation& evaluation, const MeasureSinks& sinks)
      : evaluation_(evaluation), sinks_(sinks), guests_(evaluation.libraries, evaluation.limits, DMRP_LOG_WARNING) {}

  void measure(const StoredTrial& trial) {
    try {
      core::TraceRecords records(trial.trace);
      KeptTrace kept({}, fs::temp_directory_path() / fmt::format("dmrp-evaluate-{}", getpid()));
      while (const auto record = records.next()) kept.write(0, record->whole);
      const std::uint32_t robots = core::TraceReader(kept.records()).world().robot_count;
      guests_.begin_trial(trial.id, kept.spool_descriptor());
      for (std::uint32_t i = 0; i < evaluation_.metrics.size(); ++i)
        measure_metric(trial, {kept.in_memory(), nullptr, robots, trial.seed, trial.sim_time_s}, i);
    } catch (const MachineError&) {
      throw;
    } catch (const std::exception& error) {
      sinks_.failure(trial, fmt::format("{}: {}", trial.trace.string(), error.what()));
    }
  }

 private:
  void measure_metric(const StoredTrial& trial, const FinishedTrial& finished, std::uint32_t index) {
    const PluginUse& use = evaluation_.metrics[index];
    try {
      sinks_.result(trial, ask_metric(guests_.all(), use, index, finished, evaluation_.limits.step_time_s));
    } catch (const PluginFault& fault) {
      sinks_.failure(trial, words_of(fault));
      if (fault.fatal()) guests_.end(use.library);
    }
  }

  const Evaluation& evaluation_;
  const MeasureSinks& sinks_;
  CommandGuests guests_;
};

struct EvaluateOptions {
  EvaluationChoice choice;
  std::vector<std::uint64_t> trials;  // empty: all
  fs::path csv;                       // empty: standard output
};

// Loads the libraries, creates the metrics and measures every trial as during the run. The metrics' warnings go to
// standard error. Throws std::runtime_error if the libraries cannot be loaded, and MachineError.
void measure_stored(const Evaluation& evaluation, const std::vector<StoredTrial>& trials, const MeasureSinks& sinks) {
  Measurer measurer(evaluation, sinks);
  for (const StoredTrial& trial : trials) measurer.measure(trial);
}

void print_note(const std::string& line) {
  fmt::print(stderr, "{}\n", line);
}

// The records of the trials to evaluate.
std::vector<TrialRecord> chosen_trials(const EvaluateOptions& options) {
  const fs::path database = options.choice.run_directory / "results.sqlite";
  if (std::error_code ignored; !fs::is_regular_file(database, ignored))
    throw InputError(
        fmt::format("{}: is no run directory (there is no results.sqlite)", options.choice.run_directory.string()));
  std::vector<TrialRecord> trials = ResultsDatabase::open_read_only(database).trials_with_events_of("");
  if (trials.empty()) throw InputError(fmt::format("{}: has no finished trial", options.choice.run_directory.string()));
  for (const std::uint64_t id : options.trials)
    if (std::none_of(trials.begin(), trials.end(), [&](const TrialRecord& trial) { return trial.id == id; }))
      throw InputError(fmt::format("--trial {}: {} has {}, from {} to {}", id, options.choice.run_directory.string(),
                                   plural(trials.size(), "trial"), trials.front().id, trials.back().id));
  if (!options.trials.empty())
    std::erase_if(trials, [&](const TrialRecord& trial) {
      return std::find(options.trials.begin(), options.trials.end(), trial.id) == options.trials.end();
    });
  return trials;
}

// Finds the traces of trials, and reports the trials without one.
class TraceSearch {
 public:
  TraceSearch(const fs::path& run_directory, RecordTraces recorded)
      : run_directory_(run_directory), recorded_(recorded) {}

  std::vector<StoredTrial> among(const std::vector<TrialRecord>& trials) {
    std::vector<StoredTrial> stored;
    for (const TrialRecord& trial : trials) {
      const fs::path trace = trace_path(run_directory_, trial.id);
      if (!has_result(trial) || trial.outcome == trial_outcome::fault)
        ++unfinished_;
      else if (std::error_code ignored; fs::is_regular_file(trace, ignored) && !is_trace_of(trial, trace))
        missing_.push_back(fmt::format("trial {}: {} was changed after the run", trial.id, trace.string()));
      else if (fs::is_regular_file(trace, ignored))
        stored.push_back({trial.id, trial.seed, trial.sim_time_s, trace});
      else if (!keeps_trace(recorded_, trial))
        ++unrecorded_;
      else
        missing_.push_back(fmt::format("trial {}: {} is missing", trial.id, trace.string()));
    }
    return stored;
  }

  void report_others() const {
    if (unfinished_ > 0)
      print_note(fmt::format("{} ended in a fault: nothing to measure", plural(unfinished_, "trial")));
    if (unrecorded_ > 0)
      print_note(fmt::format("{} without a trace: the run has [record] traces = \"{}\"", plural(unrecorded_, "trial"),
                             trace_choices[static_cast<std::size_t>(recorded_)]));
    for (const std::string& line : missing_) print_note(line);
  }

  bool incomplete() const { return !missing_.empty(); }

 private:
  fs::path run_directory_;
  RecordTraces recorded_;
  std::size_t unfinished_ = 0;
  std::size_t unrecorded_ = 0;  // because of [record] traces
  std::vector<std::string> missing_;
};

// Without negative zero, as SQLite stores numbers.
double as_stored(double value) {
  return value + 0.0;
}

void write_values(CsvWriter& csv, std::uint64_t trial, const std::vector<MetricValue>& values) {
  for (const MetricValue& value : values) {
    csv.field(trial).field(value.metric).field(subject_kind_names.at(value.subject_kind));
    csv.field(value.subject ? std::to_string(*value.subject) : "");
    for (const std::optional<double>& number : {value.coordinate, value.value})
      csv.field(number ? shortest_number(as_stored(*number)) : "");
    csv.end_line();
  }
}

int evaluate_command(const EvaluateOptions& options) {
  check_output_file("--csv", options.csv);
  const std::vector<TrialRecord> trials = chosen_trials(options);
  const Evaluation evaluation = plan_evaluation(options.choice);
  for (const std::string& warning : evaluation.warnings) warn(warning);
  TraceSearch search(options.choice.run_directory, evaluation.traces);
  const std::vector<StoredTrial> stored = search.among(trials);
  search.report_others();
  if (stored.empty()) throw InputError(fmt::format("{}: nothing to evaluate", options.choice.run_directory.string()));

  bool failures = search.incomplete();
  CsvWriter csv;
  for (const char* name : {"trial", "metric", "subject_kind", "subject", "coordinate", "value"}) csv.field(name);
  csv.end_line();
  measure_stored(
      evaluation, stored,
      {[&](const StoredTrial& trial, const MetricResult& result) { write_values(csv, trial.id, result.values); },
       [&](const StoredTrial& trial, const std::string& text) {
         failures = true;
         print_note(fmt::format("trial {}: {}", trial.id, text));
       }});
  write_output("--csv", options.csv, csv.text());
  return failures ? exit_status::faults : exit_status::done;
}

}  // namespace

void add_evaluate(CLI::App& app) {
  const auto options = std::make_shared<EvaluateOptions>();
  CLI::App* command = app.add_subcommand("evaluate", "measure the stored traces of a run, as CSV");
  command->add_option("run", options->choice.run_directory, "run directory")->required()->type_name("RUN_DIR");
  command->add_option("--metric", options->choice.metric, "metric (default: all metrics of the run and of --plugin)")
      ->type_name("ID");
  command->add_option("--plugin", options->choice.plugins, "additional plugin library, searched before the run's")
      ->type_name("LIB.so")
      ->allow_extra_args(false);
  command->add_option("--set", options->choice.settings, "parameter of the metric (default: as in the run)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command
      ->add_option("--params-file", options->choice.parameter_file,
                   "parameters of the metric: a file, or the name of a shipped set")
      ->type_name("FILE");
  command->add_option("--trial", options->trials, "measure only this trial")->type_name("N")->allow_extra_args(false);
  command->add_option("--csv", options->csv, "output file (default: standard output)")->type_name("FILE");
  finish_command(command, "dmrp-host evaluate runs/quickstart --csv values.csv",
                 [options] { return evaluate_command(*options); });
}

}  // namespace dmrp::host
