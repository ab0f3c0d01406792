// SPDX-License-Identifier: MIT
#include "host/report/write_report.hpp"

#include "host/executable.hpp"
#include "host/input_error.hpp"
#include "host/report/replays.hpp"
#include "host/report/report_data.hpp"
#include "host/report/report_page.hpp"
#include "host/results/atomic_file.hpp"

namespace dmrp::host {

void write_report(const std::filesystem::path& run_directory) {
  const ReportRun run = read_report_run(run_directory);
  if (run.trials.empty()) throw InputError(run_directory.string() + ": no trial is finished, so there is no report");
  const ReportLayouts layouts = read_report_layouts(shared_data_path() / "layouts");
  const Replays chosen = choose_and_encode_replays(run_directory, run.trials, run.metrics, layouts.report.replays);
  ReplayIndex index{{}, chosen.left_out};
  std::vector<EmbeddedReplay> embedded;
  for (const Replay& replay : chosen.replays) {
    const std::string element = "dmrp-replay-" + std::to_string(replay.trial);
    index.replays.push_back({replay.trial, replay.why, element});
    embedded.push_back({element, replay.packed});
  }
  const std::string data = report_data_json(run, layouts, index);
  write_file_atomically(run_directory / "report.html", report_page(shared_data_path() / "report", data, embedded));
}

}  // namespace dmrp::host
