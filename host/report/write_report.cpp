// SPDX-License-Identifier: MIT
#include "host/report/write_report.hpp"

#include <algorithm>

#include "host/errors/input_error.hpp"
#include "host/files/atomic_file.hpp"
#include "host/program/executable.hpp"
#include "host/report/data/report_data.hpp"
#include "host/report/replay/replays.hpp"
#include "host/report/report_page.hpp"
#include "host/results/database.hpp"

namespace dmrp::host {

namespace {

void check_replayed(const std::vector<std::uint64_t>& replayed, const ReportRun& run, const std::string& directory) {
  for (const std::uint64_t id : replayed)
    if (std::none_of(run.trials.begin(), run.trials.end(), [id](const auto& trial) { return trial.id == id; }))
      throw InputError("--replay: " + directory + " has no trial " + std::to_string(id) + " (its trials: " +
                       std::to_string(run.trials.front().id) + " to " + std::to_string(run.trials.back().id) + ")");
}

}  // namespace

void write_report(const std::filesystem::path& run_directory, const std::vector<std::uint64_t>& replayed) {
  const ReportLayouts layouts = read_report_layouts(shared_data_path() / "layouts");
  const ReportRun run = read_report_run(run_directory, layouts.summary.arrived);
  if (run.trials.empty()) throw InputError(run_directory.string() + ": no trial is finished, so there is no report");
  check_replayed(replayed, run, run_directory.string());
  ReplayPolicy policy = layouts.report.replays;
  policy.asked = replayed;
  const ResultsDatabase database = ResultsDatabase::open_read_only(run_directory / "results.sqlite");
  const Replays chosen = encode_replays(run_directory, run.trials, run.metrics, policy,
                                        [&](std::uint64_t trial) { return database.events(trial); });
  ReplayIndex index{{}, chosen.omitted};
  std::vector<EmbeddedReplay> embedded;
  for (const Replay& replay : chosen.replays) {
    const std::string element = "dmrp-replay-" + std::to_string(replay.trial);
    index.replays.push_back({replay.trial, replay.why, element});
    embedded.push_back({element, replay.packed});
  }
  const std::string data = report_data_json(run, layouts, index);
  write_file_atomically(run_directory / "report.html",
                        report_page(shared_data_path() / "report", "page", data, embedded));
}

}  // namespace dmrp::host
