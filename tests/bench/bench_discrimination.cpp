// SPDX-License-Identifier: MIT
// bench_discrimination: whether the tasks of a run tell its entries apart. Several runs of the same tasks (with other
// settings) count as one.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "host/errors/input_error.hpp"
#include "host/program/executable.hpp"
#include "host/report/data/report_run.hpp"
#include "host/results/summary_layout.hpp"
#include "tests/bench/discrimination/discrimination.hpp"

namespace {

using namespace dmrp;
using namespace dmrp::bench;
using namespace dmrp::host;

struct Options {
  std::vector<std::filesystem::path> runs;  // of the same tasks
  std::string declared = "success";         // the effect that counts, declared beforehand: or "time"
  std::string factor;                       // not empty: prints a row of a Markdown table, with this name of the factor
  std::vector<std::string> contrast;        // not empty: two entries; prints their difference instead
};

// The trials of all runs; with several, a planner's name says its run.
struct AllRuns {
  std::vector<MetricColumn> metrics;
  std::vector<TrialRecord> trials;
  std::vector<std::string> names;
  std::vector<ScenarioFacts> scenarios;
};

AllRuns read_all(const std::vector<std::filesystem::path>& directories) {
  AllRuns all;
  for (const std::filesystem::path& directory : directories) {
    ReportRun run = read_report_run(directory);
    all.names.push_back(run.manifest.experiment.name);
    if (directories.size() > 1)
      for (TrialRecord& trial : run.trials)
        trial.global_planner = planner_in_run(trial.global_planner, all.names.back());
    all.trials.insert(all.trials.end(), run.trials.begin(), run.trials.end());
    const auto& scenarios = run.manifest.experiment.scenarios;
    all.scenarios.insert(all.scenarios.end(), scenarios.begin(), scenarios.end());
    if (all.metrics.empty()) all.metrics = run.metrics;
  }
  return all;
}

std::string effect_words(const BlockEffect& effect) {
  if (std::isnan(effect.partial_eta_squared)) return "–";
  return fmt::format("{:.2f} [{:.2f}, {:.2f}]", effect.partial_eta_squared, effect.interval.low, effect.interval.high);
}

std::string joined(const std::vector<std::string>& words) {
  return words.empty() ? "passes" : fmt::format("misses: {}", fmt::join(words, "; "));
}

std::string interaction_words(const std::optional<RunInteraction>& found) {
  if (!found) return "–";
  std::string words = effect_words(found->effect);
  if (found->difference)
    words += fmt::format(", {:+.0f} points [{:.0f}, {:.0f}]", 100.0 * *found->difference, 100.0 * found->interval.low,
                         100.0 * found->interval.high);
  return words;
}

void print_text(const Discrimination& one, std::span<const std::string> runs, bool declared_time) {
  fmt::print("{}, {} robots: {} tasks, {} entries\n", one.scenario, one.robots, one.tasks, one.entries.size());
  for (const DiscriminationEntry& entry : one.entries)
    fmt::print("  {:<40}  safe_sct {:.3f}  time {:.3f} s/m\n", entry.name, entry.share, entry.time);
  fmt::print("  mean {:.2f}, {} at the ceiling · D {}/{} = {:.2f} · partial eta squared {} (time {}) · halves {:.2f}\n",
             one.mean_share, one.at_ceiling, one.separated, one.pairs, one.separated_share(),
             effect_words(one.share_effect), effect_words(one.time_effect), one.half_agreement);
  if (one.tasks_needed)
    fmt::print("  {} points would show from {} tasks on (paired deviation {:.3f})\n",
               std::lround(100.0 * least_share_difference), *one.tasks_needed, one.median_deviation);
  if (const auto interaction = run_interaction(one, runs)) {
    fmt::print("  interaction of {} with the run ({}): partial eta squared {}\n", fmt::join(interaction->entries, ", "),
               fmt::join(interaction->runs, ", "), interaction_words(interaction));
    if (interaction->difference)
      fmt::print("    points: by how much more {} raises {} than {}\n", interaction->runs[1], interaction->entries[0],
                 interaction->entries[1]);
  }
  fmt::print("  {}\n\n", joined(misses(one, declared_time)));
}

// "12"; "12, 60" if the runs differ.
std::string people_words(const Discrimination& one, std::span<const ScenarioFacts> scenarios) {
  std::set<std::uint32_t> numbers;
  for (const ScenarioFacts& facts : scenarios)
    if (facts.name == one.scenario && facts.robots == one.robots) numbers.insert(facts.people);
  return fmt::format("{}", fmt::join(numbers, ", "));
}

// A row of docs/discrimination.md.
void print_row(const Discrimination& one, const AllRuns& all, const Options& options) {
  const bool time = options.declared == "time";
  fmt::print("| {} | {} | {} | {} | {} | {} | {:.2f} | {}/{} | {:.2f} | {} | {} | {:.2f} | {} | {} | {} |\n",
             one.scenario, one.robots, people_words(one, all.scenarios), options.factor, options.declared, one.tasks,
             one.mean_share, one.at_ceiling, one.entries.size(), one.separated_share(), effect_words(one.share_effect),
             effect_words(one.time_effect), one.half_agreement,
             one.tasks_needed ? std::to_string(*one.tasks_needed) : "–",
             interaction_words(run_interaction(one, all.names)), joined(misses(one, time)));
}

// "mall 40 +56.9 [50.3, 63.1] 0.0001": world, tasks, points of the share, its interval, p.
void print_contrast(const Discrimination& one, const std::vector<std::string>& entries) {
  const auto found = contrast(one, entries[0], entries[1]);
  if (!found)
    throw InputError(
        fmt::format("--contrast: scenario '{}' has no entries '{}' and '{}'", one.scenario, entries[0], entries[1]));
  fmt::print("{} {} {:+.1f} [{:.1f}, {:.1f}] {:.2g}\n", one.scenario, one.tasks, 100.0 * found->difference,
             100.0 * found->interval.low, 100.0 * found->interval.high, found->p);
}

void print(const Options& options) {
  const AllRuns run = read_all(options.runs);
  const auto layout = read_summary_layout(shared_data_path() / "layouts/summary.json");
  const std::vector<Discrimination> found = discriminations(layout, run.metrics, run.trials);
  if (found.empty())
    throw InputError(fmt::format("{}: nothing to compare: needs two entries that met the same tasks, and {}",
                                 options.runs.front().string(), layout.answer.shares.front()));
  for (const Discrimination& one : found)
    if (!options.contrast.empty())
      print_contrast(one, options.contrast);
    else if (options.factor.empty())
      print_text(one, run.names, options.declared == "time");
    else
      print_row(one, run, options);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Whether the tasks of a run tell its entries apart.", "bench_discrimination");
  app.add_option("run", options.runs, "run directories of the same tasks")->required()->type_name("RUN_DIR");
  app.add_option("--declared", options.declared, "the effect that was declared to count: success or time")
      ->check(CLI::IsMember({"success", "time"}))
      ->type_name("CRITERION")
      ->capture_default_str();
  CLI::Option* row =
      app.add_option("--row", options.factor, "print a row of a Markdown table, for this factor")->type_name("FACTOR");
  app.add_option("--contrast", options.contrast, "print how much more the second entry arrives than the first")
      ->type_name("ENTRY ENTRY")
      ->expected(2)
      ->excludes(row);
  CLI11_PARSE(app, argc, argv);
  try {
    print(options);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_discrimination: {}\n", error.what());
    return 2;
  }
}
