// SPDX-License-Identifier: MIT
// Runs some trials of a run or bundle again, and compares them to the bit.
#include <fmt/format.h>

#include <cstdlib>
#include <dmrp/toolkit/random.hpp>
#include <numeric>
#include <system_error>

#include "host/bundle/bundle.hpp"
#include "host/commands/command.hpp"
#include "host/commands/command_output.hpp"
#include "host/errors/input_error.hpp"
#include "host/files/temporary_folder.hpp"
#include "host/guests/probe.hpp"
#include "host/results/database.hpp"
#include "host/run/run_description.hpp"
#include "host/run/run_directory.hpp"
#include "host/verify/stored_digests.hpp"
#include "host/verify/trial_differences.hpp"
#include "host/workers/open_trial.hpp"
#include "host/workers/stored_plan.hpp"
#include "host/workers/supervisor.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

struct VerifyOptions {
  fs::path directory;       // of a run, or a bundle of one
  std::size_t trials = 10;  // at most
  std::uint64_t seed = 1;   // chooses the trials and their order
  unsigned jobs = default_jobs();
  bool trust = false;  // plugins of a bundle
};

// What ended by a fault or by a wall-clock limit may end otherwise.
bool is_comparable(const TrialRecord& trial) {
  return trial.repeatable && trial.faults.empty() && trial.outcome != trial_outcome::skipped;
}

// Whether the rows are those of the run: each where the experiment has it, and none missing.
bool has_its_rows(const Experiment& experiment, const Shard& shard, std::span<const TrialRecord> trials) {
  bool whole = true;
  std::uint64_t found = 0;
  const std::uint64_t all = combinations(experiment).size() * experiment.trials;
  const auto is_of_shard = [&](std::uint64_t trial) {
    return trial < all && (shard.count == 0 || trial % shard.count == shard.index);
  };
  for (const TrialRecord& trial : trials) {
    const std::string why =
        is_of_shard(trial.id) ? misplacement(trial, row_of(experiment, trial.id)) : "is none of this run";
    if (!why.empty()) fmt::print("trial {}: {}\n", trial.id, why);
    if (!why.empty()) whole = false;
    if (is_of_shard(trial.id) && trial.outcome != trial_outcome::skipped) ++found;
  }
  std::uint64_t planned = 0;
  for (std::uint64_t trial = 0; trial < all; ++trial)
    if (is_of_shard(trial)) ++planned;
  if (found < planned) fmt::print("{} of {} trials are missing\n", planned - found, planned);
  return whole && found == planned;
}

// In random order: results must not depend on what a worker ran before.
std::vector<TrialRecord> chosen(std::vector<TrialRecord> trials, std::size_t count, std::uint64_t seed) {
  toolkit::Stream stream(seed, "verify");
  for (std::size_t i = trials.size(); i > 1; --i) std::swap(trials[i - 1], trials[stream.below(i)]);
  if (trials.size() > count) trials.resize(count);
  return trials;
}

// Runs them in the order given, with the plans that the run has stored.
class Rerun {
 public:
  Rerun(const Experiment& experiment, const fs::path& before, unsigned jobs)
      : experiment_(experiment), before_(before), jobs_(jobs) {}

  RunEnding run(const std::vector<TrialRecord>& trials) {
    if (experiment_.traces != RecordTraces::none) fs::create_directories(folder_.path() / "traces");
    ResultsDatabase database = ResultsDatabase::create(folder_.path() / "results.sqlite", columns_of(experiment_));
    std::vector<std::uint64_t> numbers;
    const StoredPlans plans(folder_.path());
    const std::vector<Combination> all = combinations(experiment_);
    for (const TrialRecord& trial : trials) {
      numbers.push_back(trial.id);
      plans.copy(before_, plan_name(all[trial_id(trial.id, all.size()).combination], trial.repetition));
    }
    const SupervisorSettings settings = {jobs_, folder_.path(), combinations(experiment_).size() * experiment_.trials};
    const SupervisorSinks sinks = {
        [&](TrialRecord&& trial) { database.write(trial); },
        [&](std::uint64_t trial, const FaultRecord& fault) { database.add_fault(trial, fault); },
        [](const std::string& text) { warn(text); }, [] { return true; }};
    const RunEnding ending = supervise(experiment_, PlannedTrials(std::move(numbers)), settings, sinks);
    for (TrialRecord& trial : database.trials()) trials_.emplace(trial.id, std::move(trial));
    return ending;
  }

  const TrialRecord& trial(std::uint64_t id) const { return trials_.at(id); }
  std::optional<std::string> digest(std::uint64_t id) const { return StoredDigests(folder_.path()).of(id); }

 private:
  const Experiment& experiment_;
  const StoredPlans before_;
  unsigned jobs_;
  TemporaryFolder folder_{"dmrp_verify"};
  std::map<std::uint64_t, TrialRecord> trials_;
};

std::vector<std::string> differences_of(const TrialRecord& before, const std::optional<std::string>& digest_before,
                                        const Rerun& rerun, std::span<const MetricColumn> metrics) {
  std::vector<std::string> out = trial_differences(before, rerun.trial(before.id), metrics);
  if (!digest_before) return out;  // it kept no trace
  const std::string digest = rerun.digest(before.id).value_or("missing");
  if (digest != *digest_before) out.push_back(fmt::format("the trace's digest is {}, was {}", digest, *digest_before));
  return out;
}

// Prints what the experiment means now and did not mean then.
bool is_same_experiment(const Manifest& before, const Manifest& now) {
  const auto keys = differences(before.identity, now.identity);
  for (const KeyDifference& key : keys) fmt::print("{} is {}, was {}\n", key.key, key.now, key.before);
  for (const std::string& change : differences(before, now)) warn("changed since the run: " + change);
  return keys.empty();
}

int verify_command(const VerifyOptions& options) {
  const fs::path& directory = options.directory;
  const RunDirectory locked = RunDirectory::open_finished(directory, directory.string());
  const ResultsDatabase database = ResultsDatabase::open_read_only(directory / "results.sqlite");
  const StoredDigests digests(directory);
  const Manifest before = read_manifest(directory / "manifest.json");
  if (!options.trust) check_strangers(directory);
  const Experiment experiment = load_experiment(directory / "effective.toml", 0, &probe_library);
  if (!is_same_experiment(before, manifest_of(experiment, {}, 0, {}))) return exit_status::different;

  std::vector<TrialRecord> trials = database.trials_with_events_of("");
  const bool whole = has_its_rows(experiment, before.experiment.shard, trials);
  const std::size_t others = std::erase_if(trials, [](const TrialRecord& trial) { return !is_comparable(trial); });
  if (others > 0) warn(plural(others, "trial") + " with faults, or not repeatable, cannot be compared");
  if (trials.empty()) throw InputError(fmt::format("{}: has no trial to compare", directory.string()));
  trials = chosen(std::move(trials), options.trials, options.seed);
  for (TrialRecord& trial : trials) trial.events = database.events(trial.id);
  Rerun rerun(experiment, directory, options.jobs);
  if (rerun.run(trials) == RunEnding::interrupted) return exit_status::interrupted;

  std::size_t different = 0;
  const std::vector<MetricColumn> metrics = columns_of(experiment);  // not as the file that is judged says
  for (const TrialRecord& trial : trials) {
    const std::vector<std::string> lines = differences_of(trial, digests.of(trial.id), rerun, metrics);
    for (const std::string& line : lines) fmt::print("trial {}: {}\n", trial.id, line);
    if (!lines.empty()) ++different;
  }
  if (different == 0)
    fmt::print("{}: {} run again, equal to the bit\n", directory.string(), plural(trials.size(), "trial"));
  else
    fmt::print("{}: {} of {} differ\n", directory.string(), different, plural(trials.size(), "trial"));
  return different == 0 && whole ? exit_status::done : exit_status::different;
}

}  // namespace

void add_verify(CLI::App& app) {
  const auto options = std::make_shared<VerifyOptions>();
  CLI::App* command = app.add_subcommand("verify", "run some trials again, and compare them to the bit");
  command->add_option("directory", options->directory, "run directory, or bundle of one")
      ->required()
      ->type_name("RUN_DIR|BUNDLE");
  command->add_option("--trials", options->trials, "number of trials, drawn at random; all if there are fewer")
      ->check(CLI::Range(1, 1'000'000'000))
      ->type_name("K")
      ->capture_default_str();
  command->add_option("--seed", options->seed, "seed of the draw, and of the order")
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--jobs", options->jobs, "worker processes (default: one per core)")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  command->add_flag("--trust", options->trust, trust_help);
  finish_command(command, "dmrp-host verify runs/quickstart --trials 2",
                 [options] { return verify_command(*options); });
}

}  // namespace dmrp::host
