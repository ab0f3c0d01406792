// SPDX-License-Identifier: MIT
// bench_calibration: how often the statistics are right about benchmarks whose truth is known. Prints a table, and ends
// with status 1 if a row misses its target by more than three standard errors.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/bench/calibration/examples.hpp"
#include "tests/bench/calibration/rows.hpp"

namespace {

using namespace dmrp::bench;

std::string target_words(const Row& row) {
  if (!row.target) return "–";
  switch (row.measure) {
    case Measure::false_positives:
      return fmt::format("≤ {:.2f}", *row.target);
    case Measure::coverage:
      return fmt::format("≥ {:.2f}", *row.target);
    default:
      return fmt::format("≥ reference - {:.2f}", *row.target);
  }
}

std::string measured_words(const Row& row, const Measured& measured) {
  const std::string share = fmt::format("{:.3f}", measured.share);
  const bool has_reference = row.measure == Measure::power || measured.share_of_reference > 0.0;
  return has_reference ? fmt::format("{} (reference {:.3f})", share, measured.share_of_reference) : share;
}

const char* name_of(Measure measure) {
  return measure == Measure::false_positives ? "false positives" : measure == Measure::coverage ? "coverage" : "power";
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t benchmarks = 400;
  std::string only;
  CLI::App app("How often the statistics are right about benchmarks whose truth is known.", "bench_calibration");
  app.add_option("--benchmarks", benchmarks, "benchmarks a row")
      ->check(CLI::PositiveNumber)
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--procedure", only, "rows of this procedure alone")->type_name("NAME");
  bool fixed = false;
  app.add_flag("--examples", fixed, "print statistics of fixed values instead");
  CLI11_PARSE(app, argc, argv);
  if (fixed) {
    for (const auto& [name, value] : examples()) fmt::print("{} {}\n", name, value);
    return 0;
  }
  int missed = 0;
  fmt::print("| procedure | truth | n | measure | measured | target | mean width |\n|---|---|---|---|---|---|---|\n");
  for (const auto& list : {best_set_rows(), test_rows(), interval_rows()})
    for (const Row& row : list) {
      if (!only.empty() && row.procedure != only) continue;
      const Measured measured = measure(row, benchmarks);
      const bool meets = meets_target(row, measured, benchmarks);
      missed += meets ? 0 : 1;
      fmt::print("| {} | {} | {} | {} | {} | {}{} | {} |\n", row.procedure, row.truth, row.n, name_of(row.measure),
                 measured_words(row, measured), target_words(row), meets ? "" : " **missed**",
                 std::isnan(measured.width) ? "–" : fmt::format("{:.3f}", measured.width));
      std::fflush(stdout);
    }
  return missed == 0 ? 0 : 1;
}
