// SPDX-License-Identifier: MIT
// Measures the stored traces of a run, with its own metrics or others.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "host/commands/commands.hpp"
#include "host/errors/input_error.hpp"
#include "host/evaluate/evaluation.hpp"
#include "host/evaluate/measure_process.hpp"
#include "host/files/atomic_file.hpp"
#include "host/results/csv.hpp"
#include "host/results/database.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

void tell(const std::string& line) {
  fmt::print(stderr, "{}\n", line);
}

std::string plural(std::size_t n) {
  return fmt::format("{} trial{}", n, n == 1 ? "" : "s");
}

void check_csv_file(const fs::path& file) {
  if (file.empty()) return;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (std::error_code ignored; !fs::is_directory(folder, ignored))
    throw InputError(fmt::format("--csv {}: there is no folder {}", file.string(), folder.string()));
  if (std::error_code ignored; fs::is_directory(file, ignored))
    throw InputError(fmt::format("--csv {}: is a folder", file.string()));
}

// The trials to look at, as the run has them.
std::vector<TrialRecord> chosen_trials(const EvaluateOptions& options) {
  const fs::path database = options.run_directory / "results.sqlite";
  if (std::error_code ignored; !fs::is_regular_file(database, ignored))
    throw InputError(
        fmt::format("{}: is no run directory (there is no results.sqlite)", options.run_directory.string()));
  std::vector<TrialRecord> trials = ResultsDatabase::open_read_only(database).trials();
  if (trials.empty()) throw InputError(fmt::format("{}: has no finished trial", options.run_directory.string()));
  for (const std::uint64_t id : options.trials)
    if (std::none_of(trials.begin(), trials.end(), [&](const TrialRecord& trial) { return trial.id == id; }))
      throw InputError(fmt::format("--trial {}: {} has {}, from {} to {}", id, options.run_directory.string(),
                                   plural(trials.size()), trials.front().id, trials.back().id));
  if (!options.trials.empty())
    std::erase_if(trials, [&](const TrialRecord& trial) {
      return std::find(options.trials.begin(), options.trials.end(), trial.id) == options.trials.end();
    });
  return trials;
}

// Which trials can be measured; of the others it is told why they cannot.
class TraceSearch {
 public:
  TraceSearch(const fs::path& run_directory, RecordTraces recorded)
      : folder_(run_directory / "traces"), recorded_(recorded) {}

  std::vector<StoredTrial> among(const std::vector<TrialRecord>& trials) {
    std::vector<StoredTrial> stored;
    for (const TrialRecord& trial : trials) {
      const fs::path trace = folder_ / fmt::format("trial_{:06}.mcap", trial.id);
      if (trial.outcome == trial_outcome::skipped || trial.outcome == trial_outcome::fault)
        ++unfinished_;
      else if (std::error_code ignored; fs::is_regular_file(trace, ignored))
        stored.push_back({trial.id, trial.seed, trace});
      else if (recorded_ == RecordTraces::none ||
               (recorded_ == RecordTraces::failed && trial.outcome == trial_outcome::succeeded))
        ++unrecorded_;
      else
        missing_.push_back(fmt::format("trial {}: {} is missing", trial.id, trace.string()));
    }
    return stored;
  }

  void tell_rest() const {
    if (unfinished_ > 0) tell(fmt::format("{} ended in a fault: nothing to measure", plural(unfinished_)));
    if (unrecorded_ > 0)
      tell(fmt::format("{} without a trace: the run has [record] traces = \"{}\"", plural(unrecorded_),
                       recorded_ == RecordTraces::none ? "none" : "failed"));
    for (const std::string& line : missing_) tell(line);
  }

  bool incomplete() const { return !missing_.empty(); }

 private:
  fs::path folder_;
  RecordTraces recorded_;
  std::size_t unfinished_ = 0;
  std::size_t unrecorded_ = 0;  // as the run was asked to
  std::vector<std::string> missing_;
};

// The results have no negative zero: SQLite knows none.
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

}  // namespace

int evaluate_command(const EvaluateOptions& options) {
  check_csv_file(options.csv);
  const std::vector<TrialRecord> trials = chosen_trials(options);
  const Evaluation evaluation = plan_evaluation(
      {options.run_directory, options.metric, options.plugins, options.settings, options.parameter_file});
  for (const std::string& warning : evaluation.warnings) tell("warning: " + warning);
  TraceSearch search(options.run_directory, evaluation.traces);
  const std::vector<StoredTrial> stored = search.among(trials);
  search.tell_rest();
  if (stored.empty()) throw InputError(fmt::format("{}: nothing to evaluate", options.run_directory.string()));

  bool failures = search.incomplete();
  CsvWriter csv;
  for (const char* name : {"trial", "metric", "subject_kind", "subject", "coordinate", "value"}) csv.field(name);
  csv.end_line();
  measure_stored(
      evaluation, stored,
      {[&](const StoredTrial& trial, const MetricResult& result) { write_values(csv, trial.id, result.values); },
       [&](const StoredTrial& trial, const std::string& text) {
         failures = true;
         tell(fmt::format("trial {}: {}", trial.id, text));
       }});
  if (options.csv.empty())
    fmt::print("{}", csv.text());
  else
    write_file_atomically(options.csv, csv.text());
  return failures ? exit_status::faults : exit_status::done;
}

}  // namespace dmrp::host
