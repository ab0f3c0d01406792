// SPDX-License-Identifier: MIT
// run_results.hpp: what a run directory has for people, from all that its database has.
#pragma once

#include <filesystem>
#include <vector>

#include "host/results/database.hpp"
#include "host/results/summary.hpp"
#include "host/results/summary_layout.hpp"

namespace dmrp::host {

// All that the database has when a run ends.
struct RunResults {
  std::vector<MetricColumn> metrics;
  std::vector<TrialRecord> trials;
  std::vector<CombinationSummary> summaries;
};
RunResults read_results(const ResultsDatabase& database, const SummaryLayout& layout);

// trials.csv and summary.csv.
void write_tables(const RunResults& results, const std::filesystem::path& directory);

// report.html. Whether there is one: the results are worth keeping without it; why not is said on standard error.
bool try_to_report(const RunResults& results, const std::filesystem::path& directory);

// The table, the closing line, and where the files are.
void print_results(const RunResults& results, const SummaryLayout& layout, const std::filesystem::path& directory,
                   bool reported);

}  // namespace dmrp::host
