// SPDX-License-Identifier: MIT
#include "host/commands/run_results.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "host/report/write_report.hpp"
#include "host/results/atomic_file.hpp"
#include "host/results/closing_line.hpp"
#include "host/results/summary.hpp"
#include "host/results/summary_table.hpp"
#include "host/results/trials_csv.hpp"
#include "host/terminal/progress.hpp"

namespace dmrp::host {

namespace fs = std::filesystem;

void write_tables(const ResultsDatabase& database, const SummaryLayout& layout, const fs::path& directory) {
  const auto metrics = database.metrics();
  const auto trials = database.trials();
  write_file_atomically(directory / "trials.csv", trials_csv(metrics, trials));
  write_file_atomically(directory / "summary.csv",
                        summary_csv(metrics, summarise(metrics, trials, layout.counts_failures)));
}

bool try_to_report(const ResultsDatabase& database, const fs::path& directory) {
  if (database.finished_trials().empty()) return false;
  try {
    write_report(directory);
    return true;
  } catch (const std::exception& error) {
    fmt::print(stderr, "warning: no report.html: {}\n", error.what());
    return false;
  }
}

void print_results(const ResultsDatabase& database, const SummaryLayout& layout, const fs::path& directory,
                   bool reported) {
  const auto metrics = database.metrics();
  const auto trials = database.trials();
  TableStyle style;
  style.width = terminal_width();
  style.ansi = style.width > 0;
  fmt::print("\n{}\n  {}\n", summary_table(layout, metrics, summarise(metrics, trials, layout.counts_failures), style),
             closing_line(layout, trials));
  std::vector<std::string> files = {"results.sqlite"};
  if (reported) files.insert(files.begin(), "report.html");
  if (std::error_code ignored; fs::is_directory(directory / "traces", ignored)) files.push_back("traces/");
  fmt::print("  {}\n", files_line(directory, files));
}

}  // namespace dmrp::host
