// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "host/bundle/bundle.hpp"
#include "host/commands/bundle_run.hpp"
#include "host/commands/command.hpp"
#include "host/commands/command_output.hpp"
#include "host/errors/input_error.hpp"
#include "host/experiment/experiment.hpp"
#include "host/files/atomic_file.hpp"
#include "host/files/shell_word.hpp"
#include "host/files/sync_directory.hpp"
#include "host/guests/probe.hpp"
#include "host/plan/check_plan_files.hpp"
#include "host/plan/check_planners.hpp"
#include "host/process/box.hpp"
#include "host/program/executable.hpp"
#include "host/results/database.hpp"
#include "host/results/manifest.hpp"
#include "host/results/summary_layout.hpp"
#include "host/run/debug_trial.hpp"
#include "host/run/run_cost.hpp"
#include "host/run/run_description.hpp"
#include "host/run/run_directory.hpp"
#include "host/run/run_results.hpp"
#include "host/terminal/progress.hpp"
#include "host/workers/open_trial.hpp"
#include "host/workers/stored_plan.hpp"
#include "host/workers/supervisor.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

struct RunOptions {
  fs::path experiment;
  fs::path out;  // empty: runs/NAME, or runs/NAME-2, ...
  unsigned jobs = default_jobs();
  bool resume = false;
  bool retry_faults = false;  // resume: trials with faults, too
  std::string shard;          // "I/N"; empty: the whole
  std::uint32_t trials = 0;   // 0: as the file says
  bool trust = false;         // plugins of a bundle
  bool quiet = false;
  bool json = false;                      // results as JSON, without progress
  std::string progress;                   // "json": a line a finished trial instead of all else; "": the bar
  fs::path bundle;                        // to be written afterwards; empty: none
  std::optional<std::uint64_t> debugged;  // this trial alone
};

// "quickstart · mall · 4 robots, 12 people · 3 trials"; of a run that goes on, "· 1 of 3 trials left".
std::string heading(const Experiment& experiment, std::size_t left, std::size_t trials) {
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
  return out + " · " + (left < trials ? fmt::format("{} of ", left) : "") + plural(trials, "trial") +
         (left < trials ? " left" : "");
}

// For programs that show progress of their own: a line of JSON at the start, and one for each finished trial.
class ProgressLines {
 public:
  ProgressLines(bool wanted, std::uint64_t total) : wanted_(wanted), total_(total) {}

  void begin(const fs::path& directory) const {
    print({{"run_directory", directory.string()}, {"done", done_}, {"total", total_}});
  }

  void add(std::uint64_t trial, const std::string& outcome) {
    ++done_;
    print({{"trial", trial}, {"outcome", outcome}, {"done", done_}, {"total", total_}});
  }

 private:
  void print(const nlohmann::ordered_json& line) const {
    if (!wanted_) return;
    fmt::print("{}\n", line.dump());
    std::fflush(stdout);
  }

  bool wanted_;
  std::uint64_t total_;
  std::uint64_t done_ = 0;
};

// Writes the rows of all trials that finish within a tenth of a second in one transaction, since small trials take less
// time than the disk. A run that is killed in between repeats them.
class RowWriter {
 public:
  explicit RowWriter(ResultsDatabase& database) : database_(database) {}
  RowWriter(const RowWriter&) = delete;
  RowWriter& operator=(const RowWriter&) = delete;
  ~RowWriter() {
    try {
      flush();
    } catch (const std::exception&) {
      // it is the disk that fails, as in what ends the run
    }
  }

  void add(TrialRecord&& trial) {
    if (rows_.empty()) begun_ = Clock::now();
    rows_.push_back(std::move(trial));
    flush_if_due();
  }

  void flush_if_due() {
    if (Clock::now() - begun_ >= std::chrono::milliseconds(100)) flush();
  }

  void flush() {
    if (!rows_.empty()) database_.write(rows_);
    rows_.clear();
  }

 private:
  using Clock = std::chrono::steady_clock;

  ResultsDatabase& database_;
  std::vector<TrialRecord> rows_;
  Clock::time_point begun_;
};

// A line for the terminal.
std::string fault_note(std::uint64_t trial, const FaultRecord& fault) {
  std::string note = fmt::format("trial {}: {}", trial, fault.kind);
  if (!fault.plugin.empty()) note += fmt::format(" in {} {}()", fault.plugin, fault.function);
  if (fault.robot >= 0) note += fmt::format(", robot {}", fault.robot);
  return note + ": " + fault.detail;
}

// What a trial ran, for the progress.
std::string place_of(const TrialRecord& trial) {
  if (trial.global_planner.empty()) return trial.scenario;
  return fmt::format("{} · {} + {}", trial.scenario, trial.global_planner, trial.local_controller);
}

// "" if the trial has none.
std::string fault_note(const TrialRecord& trial) {
  return trial.faults.empty() ? "" : fault_note(trial.id, trial.faults.front());
}

// Why the exit status is 1, also where nobody sees the progress. False if no trial has a fault.
bool say_faults(std::span<const TrialRecord> trials) {
  const auto first =
      std::find_if(trials.begin(), trials.end(), [](const TrialRecord& trial) { return has_fault(trial); });
  if (first == trials.end()) return false;
  const auto count = std::count_if(first, trials.end(), [](const TrialRecord& trial) { return has_fault(trial); });
  std::fputs(
      fmt::format("dmrp-host: {} of {} with a fault; {}\n", count, plural(trials.size(), "trial"), fault_note(*first))
          .c_str(),
      stderr);
  return true;
}

// Rows that are there must be those of the experiment, with the plans that are there.
void check_rows(const ResultsDatabase& database, const Experiment& experiment, const fs::path& directory) {
  const StoredPlans plans(directory);
  const std::vector<Combination> all = combinations(experiment);
  for (const TrialRecord& trial : database.trials_with_events_of("")) {
    const auto fail = [&](const std::string& why) {
      throw InputError(fmt::format("--out {}: trial {}: {}", directory.string(), trial.id, why));
    };
    if (trial.id >= all.size() * experiment.trials) fail("is none of this experiment");
    if (trial.outcome == trial_outcome::skipped) continue;
    if (const std::string why = misplacement(trial, row_of(experiment, trial.id)); !why.empty()) fail(why);
    const std::string plan = plan_name(all[trial_id(trial.id, all.size()).combination], trial.repetition);
    if (trial.plan_sha256.empty() || !plans.has(plan)) continue;
    if (plans.read_call(plan).paths_sha256 != trial.plan_sha256) fail("had another plan than plans/" + plan + ".csv");
  }
}

class RunFiles {
 public:
  RunFiles(const RunOptions& options, const Experiment& experiment, Manifest manifest)
      : directory_(options.resume ? RunDirectory::reopen(options.out)
                                  : RunDirectory::make(options.out, experiment.name)) {
    if (fs::exists(database()))
      go_on(experiment, std::move(manifest));
    else
      begin(experiment, manifest);
  }

  const fs::path& directory() const { return directory_.path(); }
  fs::path database() const { return directory() / "results.sqlite"; }

 private:
  void begin(const Experiment& experiment, const Manifest& manifest) const {
    if (experiment.traces != RecordTraces::none) fs::create_directories(directory() / "traces");
    describe(experiment, manifest);
    // last, and whole: a run that is killed before has not begun
    const fs::path unfinished = directory() / "results.new";
    for (const char* rest : {"", "-wal", "-shm", "-journal"}) fs::remove(unfinished.string() + rest);
    ResultsDatabase::create(unfinished, columns_of(experiment));
    fs::rename(unfinished, database());
    sync_directory(directory());
  }

  // The manifest last: it decides whether the run has grown.
  void describe(const Experiment& experiment, const Manifest& manifest) const {
    write_file_atomically(directory() / "experiment.toml", experiment.text);
    write_file_atomically(directory() / "effective.toml", effective_toml(experiment));
    write_file_atomically(directory() / "manifest.json", to_json_text(manifest));
  }

  // The run can have moved and grown since it began.
  void go_on(const Experiment& experiment, Manifest manifest) const {
    Manifest before = read_manifest(directory() / "manifest.json");
    if (const std::string why = why_not_same(before, manifest); !why.empty())
      throw InputError(fmt::format("--out {}: {}", directory().string(), why));
    check_rows(ResultsDatabase::open(database()), experiment, directory());
    manifest.started_at = std::move(before.started_at);
    manifest.command_line = std::move(before.command_line);
    manifest.experiment.grown_from = std::move(before.experiment.grown_from);
    if (before.experiment.repetitions < manifest.experiment.repetitions)
      manifest.experiment.grown_from.push_back(before.experiment.repetitions);
    describe(experiment, manifest);
  }

  // Why the run cannot be continued with the same bits; "" if it can.
  static std::string why_not_same(const Manifest& before, const Manifest& now) {
    if (const auto keys = differences(before.identity, now.identity); !keys.empty())
      return fmt::format("was run with another experiment: {} was {}, is {} now{}", keys[0].key, keys[0].before,
                         keys[0].now, and_others(keys.size()));
    if (!(before.experiment.shard == now.experiment.shard))
      return fmt::format("is a run of {}, not of {}", shard_text(before.experiment.shard),
                         shard_text(now.experiment.shard));
    if (before.experiment.repetitions > now.experiment.repetitions)
      return fmt::format("has {0} trials of each combination, not {1}: a run can grow, not shrink (--trials {0})",
                         before.experiment.repetitions, now.experiment.repetitions);
    const auto reasons = differences(before, now);
    return reasons.empty() ? "" : "cannot be continued: " + reasons.front();
  }

  RunDirectory directory_;
};

// The default depends on the number of trials, which can have grown since the run began.
void keep_traces_as_begun(const fs::path& directory, Experiment& experiment) {
  if (experiment.traces_set || !fs::exists(directory / "results.sqlite")) return;
  const Identity begun = read_manifest(directory / "manifest.json").identity;
  const auto found = begun.find("record.traces");
  for (std::size_t i = 0; found != begun.end() && i < trace_choices.size(); ++i)
    if (found->second == fmt::format("\"{}\"", trace_choices[i])) experiment.traces = static_cast<RecordTraces>(i);
}

// The manifest of the first start, with what only the end of a run can tell.
void complete_manifest(const fs::path& directory, std::span<const TrialRecord> trials) {
  Manifest manifest = read_manifest(directory / "manifest.json");
  manifest.not_repeatable.clear();
  count_unrepeatable(manifest.not_repeatable, trials);
  write_file_atomically(directory / "manifest.json", to_json_text(manifest));
}

int run_command(const RunOptions& options) {
  if (options.debugged) return debug_trial(options.experiment, options.trials, *options.debugged);
  signal(SIGPIPE, SIG_IGN);  // results are kept although nobody reads what is printed
  check_new_bundle(options.bundle);
  if (!options.trust) check_strangers(fs::absolute(options.experiment).parent_path());
  Experiment experiment = load_experiment(options.experiment, options.trials, &probe_library);
  if (options.resume) keep_traces_as_begun(options.out, experiment);
  check_planners(experiment, options.experiment);
  const std::vector<std::string> without_plan = check_plan_files(experiment);
  const bool is_silent = options.quiet || !options.progress.empty();
  if (!is_silent)
    for (const std::string& warning : experiment.warnings) warn(warning);
  if (!is_silent)
    for (const std::string& warning : cut_off_warnings(experiment)) warn(warning);
  if (!is_silent)
    for (const std::string& warning : without_plan) warn(warning);
  if (const std::string gaps = box::gaps(); !is_silent && !gaps.empty()) warn(gaps);
  if (!is_silent)
    for (const std::string& id : plugins_watched_for_memory(experiment))
      warn(id + ": the kernel does not hold it to memory_mb: its memory in use is looked at ten times a second");

  const SummaryLayout layout = read_summary_layout(shared_data_path() / "layouts/summary.json");
  const std::uint64_t count = combinations(experiment).size() * experiment.trials;
  Shard shard;
  if (!options.shard.empty()) std::sscanf(options.shard.c_str(), "%lu/%lu", &shard.index, &shard.count);
  const std::uint64_t in_shard = PlannedTrials(shard.index, shard.count, count, {}).all();
  const RunFiles files(options, experiment, manifest_of(experiment, shard, in_shard, command_line()));
  ResultsDatabase database = ResultsDatabase::open(files.database());
  if (options.retry_faults) StoredPlans(files.directory()).delete_faults();
  PlannedTrials trials(shard.index, shard.count, count,
                       database.finished_trials(options.retry_faults ? ResultsDatabase::Finished::without_faults
                                                                     : ResultsDatabase::Finished::all));

  if (!is_silent) std::fputs(map_lines(experiment).c_str(), options.json ? stderr : stdout);
  RunCost cost(experiment, trials.left(), options.jobs, files.directory());
  Progress progress(trials.left(), is_silent || options.json);
  const std::string title = heading(experiment, trials.left(), trials.all());
  if (trials.left() < fewest_trials_with_cost) progress.begin(title);
  const auto begin_progress = [&] {
    if (!progress.has_begun()) progress.begin(title + ": " + cost.words());
  };
  ProgressLines lines(!options.progress.empty(), trials.left());
  lines.begin(files.directory());
  RowWriter rows(database);
  const SupervisorSettings settings = {options.jobs, files.directory(), count};
  const bool is_one = combinations(experiment).size() == 1;
  const SupervisorSinks sinks = {[&](TrialRecord&& trial) {
                                   lines.add(trial.id, trial.outcome);
                                   cost.add(trial);
                                   progress.add(fault_note(trial), is_one ? "" : place_of(trial));
                                   rows.add(std::move(trial));
                                 },
                                 [&](std::uint64_t trial, const FaultRecord& fault) {
                                   rows.flush();
                                   database.add_fault(trial, fault);
                                   progress.note(fault_note(trial, fault));
                                 },
                                 [&](const std::string& text) { progress.note("warning: " + text); },
                                 [&] {
                                   rows.flush_if_due();
                                   if (cost.is_known()) begin_progress();
                                   progress.refresh();
                                   return true;
                                 }};
  const RunEnding ending = supervise(experiment, std::move(trials), settings, sinks);
  rows.flush();
  begin_progress();
  progress.finish();
  const RunResults results = read_results(std::move(database), layout, files.directory());
  write_tables(results, files.directory());
  complete_manifest(files.directory(), results.trials);
  const bool reported = try_to_report(results, files.directory());
  if (options.json)
    print_results_as_json(results, layout, files.directory());
  else if (!is_silent)
    print_results(results, layout, files.directory(), reported, facts_of(experiment, shard, count).scenarios);
  if (ending == RunEnding::interrupted) {
    std::string again = "dmrp-host run " + shell_word(options.experiment.string());
    if (options.trials > 0) again += fmt::format(" --trials {}", options.trials);
    if (!options.shard.empty()) again += " --shard " + options.shard;
    fmt::print(stderr, "interrupted: finished trials are kept; continue with {} --resume --out {}\n", again,
               shell_word(files.directory().string()));
    return exit_status::interrupted;
  }
  if (!options.bundle.empty()) bundle_run(files.directory(), options.bundle, false);
  return say_faults(results.trials) ? exit_status::faults : exit_status::done;
}

std::string check_shard(const std::string& text) {
  unsigned long index = 0;
  unsigned long count = 0;
  const bool plain = text.find_first_not_of("0123456789/") == std::string::npos;  // no sign, no space
  char rest = 0;
  if (plain && std::sscanf(text.c_str(), "%lu/%lu%c", &index, &count, &rest) == 2 && index < count) return "";
  return "needs I/N with 0 <= I < N";
}

}  // namespace

void add_run(CLI::App& app) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand("run", "run an experiment (also: dmrp-host EXPERIMENT.toml)");
  command->add_option("experiment", options->experiment, "experiment file")->required()->type_name("EXPERIMENT.toml");
  command->add_option("--out", options->out, "run directory (default: runs/NAME, or runs/NAME-2, ... if taken)")
      ->type_name("DIR");
  command->add_option("--jobs", options->jobs, "worker processes (default: one per core)")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  CLI::Option* resume =
      command->add_flag("--resume", options->resume, "continue the run in --out: run only the trials that it lacks");
  command->add_flag("--retry-faults", options->retry_faults, "with --resume: run trials with faults again, too")
      ->needs(resume);
  command
      ->add_option("--shard", options->shard,
                   "run only the trials k with k mod N = I; merge joins the parts (docs/cluster.md)")
      ->check(check_shard)
      ->type_name("I/N");
  command->add_option("--trials", options->trials, "repetitions of each combination; overrides the file")
      ->check(CLI::Range(1, 1'000'000))
      ->type_name("K");
  command->add_flag("--trust", options->trust, trust_help);
  CLI::Option* quiet = command->add_flag("--quiet", options->quiet, "print neither progress nor results");
  CLI::Option* json =
      command->add_flag("--json", options->json, "print the results as JSON, and no progress")->excludes(quiet);
  command
      ->add_option("--progress", options->progress,
                   "json: print a line of JSON at the start and for each finished trial, and nothing else")
      ->check(CLI::IsMember({"json"}))
      ->excludes(quiet)
      ->excludes(json)
      ->type_name("json");
  command->add_option("--bundle", options->bundle, "then write a folder that repeats the run elsewhere (see bundle)")
      ->type_name("DIR");
  command
      ->add_option("--debug", options->debugged, "run this trial alone, in this process, without limits: for debuggers")
      ->excludes(resume)
      ->type_name("TRIAL");
  finish_command(command, "dmrp-host run examples/quickstart.toml --out runs/quickstart",
                 [options] { return run_command(*options); });
}

}  // namespace dmrp::host
