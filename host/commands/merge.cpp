// SPDX-License-Identifier: MIT
// Joins runs of parts of one experiment; the result is as one run of the whole experiment.
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <system_error>

#include "host/commands/command.hpp"
#include "host/commands/command_output.hpp"
#include "host/errors/input_error.hpp"
#include "host/files/atomic_file.hpp"
#include "host/files/open_log.hpp"
#include "host/files/read_file.hpp"
#include "host/files/shell_word.hpp"
#include "host/process/descriptor.hpp"
#include "host/program/executable.hpp"
#include "host/program/version.hpp"
#include "host/results/database.hpp"
#include "host/results/manifest.hpp"
#include "host/results/summary_layout.hpp"
#include "host/results/trace_path.hpp"
#include "host/run/run_directory.hpp"
#include "host/run/run_results.hpp"
#include "host/workers/stored_plan.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

struct MergeOptions {
  fs::path out;
  std::vector<fs::path> runs;
};

struct Part {
  RunDirectory directory;
  std::string shown;
  StoredPlans plans;
  std::string experiment{};  // the text of experiment.toml
  std::string effective{};   // and of effective.toml
  Manifest manifest{};
  std::vector<MetricColumn> metrics{};
  std::optional<ResultsDatabase> database{};
  std::vector<TrialRecord> trials{};  // without skipped ones, and without events
};

Part read_part(const fs::path& path) {
  Part part = {RunDirectory::open_finished(path, path.string()), path.string(), StoredPlans(path)};
  part.experiment = read_file(path / "experiment.toml", (path / "experiment.toml").string());
  part.effective = read_file(path / "effective.toml", (path / "effective.toml").string());
  part.manifest = read_manifest(path / "manifest.json");
  part.database = ResultsDatabase::open_read_only(path / "results.sqlite");
  part.metrics = part.database->metrics();
  part.trials = part.database->trials_with_events_of("");
  std::erase_if(part.trials, [](const TrialRecord& trial) { return trial.outcome == trial_outcome::skipped; });
  return part;
}

// Results can only be joined if one run would have given the same bits.
void check_same(const Part& first, const Part& other) {
  if (const auto keys = differences(first.manifest.identity, other.manifest.identity); !keys.empty())
    throw InputError(fmt::format("{}: is a run of another experiment than {}: {} is {}, not {}{}", other.shown,
                                 first.shown, keys[0].key, keys[0].now, keys[0].before, and_others(keys.size())));
  const std::uint32_t repetitions = first.manifest.experiment.repetitions;
  if (const std::uint32_t others = other.manifest.experiment.repetitions; others != repetitions)
    throw InputError(
        fmt::format("{}: has {} trials of each combination, but {} has {}: the smaller can be continued "
                    "with --resume --trials {}",
                    other.shown, others, first.shown, repetitions, std::max(others, repetitions)));
  if (const auto reasons = differences(first.manifest, other.manifest); !reasons.empty())
    throw InputError(fmt::format("{}: cannot be joined with {}: {}", other.shown, first.shown, reasons.front()));
}

void check_apart(const std::vector<Part>& parts) {
  std::map<std::uint64_t, const Part*> owners;
  for (const Part& part : parts)
    for (const TrialRecord& trial : part.trials)
      if (const auto [owner, is_new] = owners.emplace(trial.id, &part); !is_new)
        throw InputError(fmt::format("{}: trial {} is in {} already", part.shown, trial.id, owner->second->shown));
}

// Trial k is repetition k / C of combination k % C: all trials of a combination carry its labels, and all of a scenario in
// a repetition the seed. A row that does not was changed after its run.
void check_rows(const std::vector<Part>& parts) {
  std::uint64_t planned = 0;
  for (const Part& part : parts) planned += part.manifest.experiment.trials_planned;
  const std::uint64_t count = planned / parts.front().manifest.experiment.repetitions;  // of combinations
  if (count == 0) return;
  std::map<std::uint64_t, const TrialRecord*> first;
  std::map<std::pair<std::string, std::uint32_t>, std::uint64_t> seeds;
  for (const Part& part : parts)
    for (const TrialRecord& trial : part.trials) {
      const auto [known, is_new] = first.emplace(trial.id % count, &trial);
      TrialRecord place = *known->second;
      place.repetition = static_cast<std::uint32_t>(trial.id / count);
      place.seed = seeds.emplace(std::pair(trial.scenario, place.repetition), trial.seed).first->second;
      if (const std::string why = misplacement(trial, place); !why.empty())
        throw InputError(fmt::format("{}: trial {} does not fit trial {}, one of them was changed after its run: {}",
                                     part.shown, trial.id, known->second->id, why));
    }
}

// A shard that is missing would look like an experiment with fewer repetitions.
void check_whole(const std::vector<Part>& parts) {
  const Part& first = parts.front();
  const std::uint64_t count = first.manifest.experiment.shard.count;
  std::map<std::uint64_t, const Part*> found;
  for (const Part& part : parts) {
    const Shard& shard = part.manifest.experiment.shard;
    if (shard.count != count)
      throw InputError(fmt::format("{}: is {}, but {} is {}", part.shown, shard_text(shard), first.shown,
                                   shard_text(first.manifest.experiment.shard)));
    if (count == 0) continue;  // unknown
    if (const auto [other, is_new] = found.emplace(shard.index, &part); !is_new)
      throw InputError(fmt::format("{}: is {}, as is {}", part.shown, shard_text(shard), other->second->shown));
  }
  std::vector<std::string> missing;
  for (std::uint64_t i = 0; i < count && missing.size() < 10; ++i)
    if (!found.contains(i)) missing.push_back(fmt::format("{}/{}", i, count));
  if (!missing.empty())
    throw InputError(fmt::format("{} {} missing: {}", missing.size() == 1 ? "a shard" : "shards",
                                 missing.size() == 1 ? "is" : "are", fmt::join(missing, ", ")));
}

// Trials of one plan can be in several parts: which must have made the same one.
void check_plans(const std::vector<Part>& parts) {
  std::map<std::string, const Part*> owners;
  for (const Part& part : parts)
    for (const std::string& name : part.plans.names()) {
      const auto [owner, is_new] = owners.emplace(name, &part);
      if (is_new) continue;
      const StoredPlan first = owner->second->plans.read_call(name);
      const StoredPlan other = part.plans.read_call(name);
      if (outcome_of(first) == outcome_of(other)) continue;
      const std::string difference =
          fmt::format("{}: plan {} is another than that of {}", part.shown, name, owner->second->shown);
      if (first.timing.empty() && other.timing.empty()) throw InputError(difference);
      warn(difference + ": the planner depends on timing, and trials of this plan are not comparable");
    }
}

Manifest joined_manifest(const std::vector<Part>& parts) {
  Manifest manifest = parts.front().manifest;
  manifest.command_line = command_line();
  manifest.experiment.shard = {};
  manifest.not_repeatable.clear();
  for (const Part& part : parts) {
    count_unrepeatable(manifest.not_repeatable, part.trials);
    if (&part == &parts.front()) continue;
    manifest.experiment.trials_planned += part.manifest.experiment.trials_planned;
    manifest.started_at = std::min(manifest.started_at, part.manifest.started_at);  // ISO 8601 sorts by time
  }
  return manifest;
}

// Links the files if the file system can: traces are large, and never written again.
void copy_traces(const Part& part, const fs::path& out) {
  if (std::error_code ignored; !fs::is_directory(part.directory.path() / "traces", ignored)) return;
  fs::create_directories(out / "traces");
  for (const TrialRecord& trial : part.trials) {
    const fs::path from = trace_path(part.directory.path(), trial.id);
    const fs::path to = trace_path(out, trial.id);
    std::error_code error;
    if (!fs::is_regular_file(from, error)) continue;
    fs::create_hard_link(from, to, error);
    if (error) fs::copy_file(from, to);
  }
}

// By number. The events of one trial are in memory at a time.
void copy_results(std::vector<Part>& parts, ResultsDatabase& to) {
  std::map<std::uint64_t, std::pair<TrialRecord*, const ResultsDatabase*>> all;
  for (Part& part : parts)
    for (TrialRecord& trial : part.trials) all[trial.id] = {&trial, &*part.database};
  for (const auto& [id, place] : all) {
    const auto& [trial, from] = place;
    trial->events = from->events(id);
    to.write(*trial);
    trial->events = std::vector<MetricEvent>();  // {} would keep the room
  }
}

void append_log(const Part& part, const fs::path& out) {
  const fs::path log = part.directory.path() / "log.txt";
  if (std::error_code ignored; !fs::is_regular_file(log, ignored)) return;
  const std::string text = read_file(log, log.string(), UINTMAX_MAX);
  if (text.empty()) return;
  if (!Descriptor(open_log(out / "log.txt")).write(text))
    throw std::system_error(errno, std::generic_category(), out / "log.txt");
}

int merge_command(const MergeOptions& options) {
  std::vector<Part> parts;
  for (const fs::path& path : options.runs) parts.push_back(read_part(path));
  for (const Part& part : parts) check_same(parts.front(), part);
  check_apart(parts);
  check_whole(parts);
  check_rows(parts);
  check_plans(parts);
  if (std::error_code ignored; fs::exists(options.out, ignored) && !fs::is_empty(options.out, ignored))
    throw InputError(fmt::format("{}: exists already and is not empty", options.out.string()));
  const RunDirectory made = RunDirectory::make(options.out, "");
  const fs::path& out = made.path();

  const Manifest manifest = joined_manifest(parts);
  write_file_atomically(out / "experiment.toml", parts.front().experiment);
  write_file_atomically(out / "effective.toml", parts.front().effective);
  write_file_atomically(out / "manifest.json", to_json_text(manifest));
  ResultsDatabase database = ResultsDatabase::create(out / "results.sqlite", parts.front().metrics);
  copy_results(parts, database);
  for (const Part& part : parts) {
    copy_traces(part, out);
    for (const std::string& name : part.plans.names()) StoredPlans(out).copy(part.plans, name);
    append_log(part, out);
  }

  const SummaryLayout layout = read_summary_layout(shared_data_path() / "layouts/summary.json");
  const RunResults results = read_results(std::move(database), layout, out);
  write_tables(results, out);
  print_results(results, layout, out, try_to_report(results, out));
  if (results.trials.size() < manifest.experiment.trials_planned)
    fmt::print(stderr, "{} of {} trials are finished: continue with dmrp-host run {} --resume --out {}\n",
               results.trials.size(), manifest.experiment.trials_planned, shell_word((out / "effective.toml").string()),
               shell_word(out.string()));
  return exit_status::done;
}

}  // namespace

void add_merge(CLI::App& app) {
  const auto options = std::make_shared<MergeOptions>();
  CLI::App* command = app.add_subcommand("merge", "join runs of parts of one experiment (--shard)");
  command->add_option("out", options->out, "run directory to create")->required()->type_name("OUT");
  command->add_option("runs", options->runs, "run directories")->required()->type_name("RUN_DIR");
  finish_command(command, "dmrp-host merge runs/whole runs/part_0 runs/part_1",
                 [options] { return merge_command(*options); });
}

}  // namespace dmrp::host
