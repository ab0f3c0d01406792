// SPDX-License-Identifier: MIT
// run_results.hpp: the tables and the report of a run, from its database.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "host/findings/summary.hpp"
#include "host/results/arrivals_by_type.hpp"
#include "host/results/database.hpp"
#include "host/results/manifest.hpp"
#include "host/results/summary_layout.hpp"

namespace dmrp::host {

// The whole database, but events of other metrics than the layout's `arrived`.
struct RunResults {
  std::vector<MetricColumn> metrics;
  std::vector<TrialRecord> trials;
  std::vector<MetricColumn> summarised;  // the metrics, and places between bounds (host/ranking/bounds.hpp)
  std::vector<CombinationSummary> summaries;
};
// The database is finished and closed. `directory`: the run's.
RunResults read_results(ResultsDatabase database, const SummaryLayout& layout, const std::filesystem::path& directory);

// trials.csv and summary.csv.
void write_tables(const RunResults& results, const std::filesystem::path& directory);

// Writes report.html. False if that fails, with a warning on standard error: the results stand without it. Failures of
// the machine are thrown.
bool try_to_report(const RunResults& results, const std::filesystem::path& directory);

// Prints the table, the closing line, the arrivals by type of robot if there are several types, and the files.
// A run of tests with levels alone has a table of their thresholds instead.
void print_results(const RunResults& results, const SummaryLayout& layout, const std::filesystem::path& directory,
                   bool reported, std::span<const ScenarioFacts> scenarios = {});

// Prints the trials' outcomes, the answer and the means of all combinations as JSON.
void print_results_as_json(const RunResults& results, const SummaryLayout& layout,
                           const std::filesystem::path& directory);

}  // namespace dmrp::host
