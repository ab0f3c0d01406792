// SPDX-License-Identifier: MIT
// Writes a folder that repeats a run, or an experiment, elsewhere.
#include "host/bundle/bundle.hpp"

#include <fmt/format.h>

#include "host/commands/bundle_run.hpp"
#include "host/commands/command.hpp"
#include "host/commands/command_output.hpp"
#include "host/errors/input_error.hpp"
#include "host/experiment/identity.hpp"
#include "host/files/read_file.hpp"
#include "host/files/shell_word.hpp"
#include "host/guests/probe.hpp"
#include "host/results/database.hpp"
#include "host/results/sqlite.hpp"
#include "host/run/run_description.hpp"
#include "host/run/run_directory.hpp"
#include "host/verify/stored_digests.hpp"
#include "host/workers/stored_plan.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

struct BundleOptions {
  fs::path source;            // a run directory or an experiment
  fs::path out;               // empty: NAME-bundle
  bool with_plugins = false;  // copies those that come with dmrp-host, too
};

// Into a new database: one file, without what a killed run has left in a log beside it. It needs no log when it is read,
// also from a folder that cannot be written.
void copy_results(const fs::path& run, const fs::path& folder) {
  const ResultsDatabase from = ResultsDatabase::open_read_only(run / "results.sqlite");
  const fs::path file = folder / "results.sqlite";
  {
    ResultsDatabase to = ResultsDatabase::create(file, from.metrics());
    for (TrialRecord& trial : from.trials_with_events_of("")) {
      trial.events = from.events(trial.id);  // of one trial at a time
      to.write(trial);
      trial.events = std::vector<MetricEvent>();  // {} would keep the room
    }
  }
  SqliteConnection(file, SqliteMode::read_write).execute("PRAGMA journal_mode = DELETE");
  write_digests(StoredDigests(run), from.finished_trials(), folder);
}

// Writes the bundle, or leaves nothing.
template <class Write>
void write_whole(const fs::path& folder, Write&& write) {
  check_new_bundle(folder);
  fs::create_directories(folder);
  try {
    write();
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    throw;
  }
}

fs::path folder_of(const BundleOptions& options, const std::string& name) {
  return options.out.empty() ? fs::path(name + "-bundle") : options.out;
}

void bundle_experiment(const BundleOptions& options) {
  const Experiment experiment = load_experiment(options.source, 0, &probe_library);
  const std::uint64_t trials = combinations(experiment).size() * experiment.trials;
  const fs::path folder = folder_of(options, experiment.name);
  const Manifest manifest = manifest_of(experiment, {}, trials, {});
  write_whole(folder, [&] {
    write_bundle(experiment, experiment.text, manifest, BundleLayout(experiment, manifest, options.with_plugins),
                 folder);
  });
  fmt::print("{}: run it by dmrp-host {}\n", folder.string(), shell_word((folder / "experiment.toml").string()));
}

}  // namespace

void check_new_bundle(const fs::path& out) {
  if (std::error_code ignored;
      fs::exists(out, ignored) && !(fs::is_directory(out, ignored) && fs::is_empty(out, ignored)))
    throw InputError(fmt::format("{}: exists already: a bundle is written to a new folder", out.string()));
}

void bundle_run(const fs::path& run, const fs::path& out, bool with_plugins) {
  const Experiment experiment = load_experiment(run / "effective.toml", 0, &probe_library);
  const std::string original = read_file(run / "experiment.toml", (run / "experiment.toml").string());
  const Manifest manifest = read_manifest(run / "manifest.json");
  if (const auto keys = differences(manifest.identity, identity_of(experiment)); !keys.empty())
    throw InputError(fmt::format("{}: cannot be bundled, its files have changed since: {} was {}, is {} now{}",
                                 run.string(), keys[0].key, keys[0].before, keys[0].now, and_others(keys.size())));
  for (const std::string& change : differences(manifest, manifest_of(experiment, {}, 0, {})))
    warn("changed since the run: " + change);
  write_whole(out, [&] {
    write_bundle(experiment, original, manifest, BundleLayout(experiment, manifest, with_plugins), out);
    copy_results(run, out);
    const StoredPlans plans(run);
    for (const std::string& name : plans.names()) StoredPlans(out).copy(plans, name);
  });
}

namespace {

int bundle_command(const BundleOptions& options) {
  if (std::error_code ignored; !fs::is_directory(options.source, ignored)) {
    bundle_experiment(options);
    return exit_status::done;
  }
  const RunDirectory locked = RunDirectory::open_finished(options.source, options.source.string());
  const fs::path folder = folder_of(options, fs::canonical(options.source).filename());
  bundle_run(options.source, folder, options.with_plugins);
  fmt::print("{}: run it by dmrp-host {}, compare by dmrp-host verify {}\n", folder.string(),
             shell_word((folder / "experiment.toml").string()), shell_word(folder.string()));
  return exit_status::done;
}

}  // namespace

void add_bundle(CLI::App& app) {
  const auto options = std::make_shared<BundleOptions>();
  CLI::App* command = app.add_subcommand("bundle", "write a folder that repeats a run or an experiment elsewhere");
  command->add_option("source", options->source, "run directory, or experiment file")
      ->required()
      ->type_name("RUN_DIR|EXPERIMENT.toml");
  command->add_option("--out", options->out, "folder to create (default: NAME-bundle)")->type_name("DIR");
  command->add_flag("--with-plugins", options->with_plugins, "copy the libraries that come with dmrp-host, too");
  finish_command(command, "dmrp-host bundle runs/quickstart --out quickstart-bundle",
                 [options] { return bundle_command(*options); });
}

}  // namespace dmrp::host
