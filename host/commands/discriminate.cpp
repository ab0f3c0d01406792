// SPDX-License-Identifier: MIT
// Whether the tasks of a run tell its entries apart. Several runs of the same tasks (with other settings) count as one.
#include <fmt/format.h>

#include <cmath>

#include "host/commands/commands.hpp"
#include "host/errors/input_error.hpp"
#include "host/program/executable.hpp"
#include "host/ranking/discrimination.hpp"
#include "host/report/data/report_run.hpp"
#include "host/results/summary_layout.hpp"

namespace dmrp::host {
namespace {

// The trials of all runs; with several, a planner's name says its run.
ReportRun read_all(const std::vector<std::filesystem::path>& directories) {
  ReportRun all = read_report_run(directories.front());
  const auto name = [&](std::vector<TrialRecord>& trials, const std::string& run) {
    if (directories.size() > 1)
      for (TrialRecord& trial : trials) trial.global_planner += " (" + run + ")";
  };
  name(all.trials, all.manifest.experiment.name);
  for (std::size_t i = 1; i < directories.size(); ++i) {
    ReportRun run = read_report_run(directories[i]);
    name(run.trials, run.manifest.experiment.name);
    all.trials.insert(all.trials.end(), run.trials.begin(), run.trials.end());
  }
  return all;
}

std::string effect_words(const core::BlockEffect& effect) {
  if (std::isnan(effect.partial_eta_squared)) return "–";
  return fmt::format("{:.2f} [{:.2f}, {:.2f}]", effect.partial_eta_squared, effect.interval.low, effect.interval.high);
}

std::string joined(const std::vector<std::string>& words) {
  return words.empty() ? "passes" : fmt::format("misses: {}", fmt::join(words, "; "));
}

void print_text(const Discrimination& one, bool declared_time) {
  fmt::print("{}, {} robots: {} tasks, {} entries\n", one.scenario, one.robots, one.tasks, one.entries.size());
  for (const DiscriminationEntry& entry : one.entries)
    fmt::print("  {:<40}  safe success {:.3f}  time {:.3f} s/m\n", entry.name, entry.share, entry.time);
  fmt::print("  mean {:.2f}, {} at the ceiling · D {}/{} = {:.2f} · partial eta squared {} (time {}) · halves {:.2f}\n",
             one.mean_share, one.at_ceiling, one.separated, one.pairs, one.separated_share(),
             effect_words(one.share_effect), effect_words(one.time_effect), one.half_agreement);
  if (one.tasks_needed)
    fmt::print("  {} points would show from {} tasks on (paired deviation {:.3f})\n",
               std::lround(100.0 * least_share_difference), *one.tasks_needed, one.median_deviation);
  fmt::print("  {}\n\n", joined(misses(one, declared_time)));
}

// A row of docs/discrimination.md.
void print_row(const Discrimination& one, const DiscriminateOptions& options) {
  const bool time = options.declared == "time";
  fmt::print("| {} | {} | {} | {} | {} | {:.2f} | {}/{} | {:.2f} | {} | {} | {:.2f} | {} | {} |\n", one.scenario,
             one.robots, options.factor, options.declared, one.tasks, one.mean_share, one.at_ceiling,
             one.entries.size(), one.separated_share(), effect_words(one.share_effect), effect_words(one.time_effect),
             one.half_agreement, one.tasks_needed ? std::to_string(*one.tasks_needed) : "–", joined(misses(one, time)));
}

}  // namespace

int discriminate_command(const DiscriminateOptions& options) {
  const ReportRun run = read_all(options.runs);
  const auto layout = read_summary_layout(shared_data_path() / "layouts/summary.json");
  const std::vector<Discrimination> found = discriminations(layout, run.metrics, run.trials);
  if (found.empty())
    throw InputError(fmt::format("{}: nothing to compare: needs two entries that met the same tasks, and {}",
                                 options.runs.front().string(), layout.answer.shares.front()));
  for (const Discrimination& one : found)
    if (options.factor.empty())
      print_text(one, options.declared == "time");
    else
      print_row(one, options);
  return exit_status::done;
}

}  // namespace dmrp::host
