// SPDX-License-Identifier: MIT
#include "host/report/data/report_run.hpp"

#include "host/errors/input_error.hpp"
#include "host/files/read_file.hpp"
#include "host/findings/conditions.hpp"
#include "host/results/database.hpp"

namespace dmrp::host {

ReportRun read_report_run(const std::filesystem::path& directory, const std::string& event_metric) {
  for (const char* file : {"results.sqlite", "manifest.json", "effective.toml", "experiment.toml"})
    if (std::error_code ignored; !std::filesystem::is_regular_file(directory / file, ignored))
      throw InputError(directory.string() + ": is no run directory (no " + file + ")");
  ReportRun run;
  const std::filesystem::path manifest = directory / "manifest.json";
  run.manifest = read_manifest(manifest);
  run.manifest_json = read_file(manifest, manifest.string());
  run.effective_toml = read_file(directory / "effective.toml", (directory / "effective.toml").string());
  run.conditions = conditions_of_run(directory);
  const ResultsDatabase database = ResultsDatabase::open_read_only(directory / "results.sqlite");
  run.metrics = database.metrics();
  run.trials = database.trials_with_events_of(event_metric);
  return run;
}

}  // namespace dmrp::host
