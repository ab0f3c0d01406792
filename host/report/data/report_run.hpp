// SPDX-License-Identifier: MIT
// report_run.hpp: reads the parts of a run directory that a report needs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/results/manifest.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

struct ReportRun {
  Manifest manifest;
  std::string manifest_json;  // the whole file
  std::string effective_toml;
  std::string conditions;  // in words
  std::vector<MetricColumn> metrics;
  std::vector<TrialRecord> trials;  // by id; an interrupted run lacks some
};

// `event_metric`: trials have the events of this metric alone. Throws InputError if it is no run directory, SqliteError or std::runtime_error if a file is damaged.
ReportRun read_report_run(const std::filesystem::path& directory, const std::string& event_metric = "");

}  // namespace dmrp::host
