// SPDX-License-Identifier: MIT
#include "host/commands/trial_trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <vector>

#include "host/commands/command_output.hpp"
#include "host/errors/input_error.hpp"
#include "host/results/database.hpp"
#include "host/results/trace_path.hpp"

namespace dmrp::host {

namespace fs = std::filesystem;

namespace {

std::string title_of(const fs::path& run_directory, const TrialRecord& trial) {
  const fs::path run = fs::absolute(run_directory).lexically_normal();
  std::string title = fmt::format(
      "{}, trial {}: {}", (run.has_filename() ? run : run.parent_path()).filename().string(), trial.id, trial.scenario);
  const char* before = ", ";
  for (const std::string& plugin : {trial.global_planner, trial.local_controller, trial.pedestrian_model}) {
    if (plugin.empty()) continue;
    title += before + plugin;
    before = " + ";
  }
  return title;
}

}  // namespace

TrialTrace trace_of(const fs::path& run_directory, const char* option, std::uint64_t trial) {
  const fs::path database = run_directory / "results.sqlite";
  if (std::error_code ignored; !fs::is_regular_file(database, ignored))
    throw InputError(fmt::format("{}: is no run directory (there is no results.sqlite)", run_directory.string()));
  const std::vector<TrialRecord> trials = ResultsDatabase::open_read_only(database).trials_with_events_of("");
  const auto row = std::find_if(trials.begin(), trials.end(), [&](const TrialRecord& one) { return one.id == trial; });
  if (row == trials.end())
    throw InputError(fmt::format("{} {}: {} has {}, from {} to {}", option, trial, run_directory.string(),
                                 plural(trials.size(), "finished trial"), trials.empty() ? 0 : trials.front().id,
                                 trials.empty() ? 0 : trials.back().id));
  const fs::path trace = trace_path(run_directory, trial);
  if (std::error_code ignored; !fs::is_regular_file(trace, ignored))
    throw InputError(fmt::format("{} {}: no trace was recorded (traces = \"all\" in [record])", option, trial));
  if (!is_trace_of(*row, trace))
    throw InputError(fmt::format("{} {}: {} was changed after the run", option, trial, trace.string()));
  return {trace, title_of(run_directory, *row)};
}

}  // namespace dmrp::host
