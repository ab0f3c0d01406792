// SPDX-License-Identifier: MIT
// discrimination.hpp: can a set of tasks tell its entries apart? A test of the benchmark, not of the entries.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/results/summary_layout.hpp"
#include "host/results/trial_record.hpp"
#include "tests/bench/discrimination/blocks.hpp"

namespace dmrp::bench {

// The smallest differences of interest: of the share, and of the time relative to the slower entry's.
inline constexpr double least_share_difference = 0.05;
inline constexpr double least_time_ratio = 0.05;

// What a set of tasks must reach; fixed before any result was seen.
struct DiscriminationBars {
  double mean_low = 0.3;  // of the share over all entries
  double mean_high = 0.9;
  double ceiling = 0.98;  // an entry at or above it has no room left; at most half of them
  double separated_pairs = 0.5;
  double effect = 0.14;      // partial eta squared, tasks as blocks
  double effect_low = 0.06;  // the lower end of its interval
  double half_agreement = 0.7;
};

struct DiscriminationEntry {
  std::string name;
  double share = 0.0;
  double time = 0.0;             // s/m; NaN if nothing arrived
  std::vector<double> shares{};  // by task, of the tasks that every entry has
};

struct Discrimination {
  std::string scenario;
  std::uint32_t robots = 0;
  std::uint32_t tasks = 0;  // with every entry; the observations
  std::vector<DiscriminationEntry> entries;
  double mean_share = 0.0;
  std::uint32_t at_ceiling = 0;  // entries
  std::uint32_t pairs = 0;       // of entries
  std::uint32_t separated =
      0;  // of pairs: p < 0.05 by Holm over all pairs and both criteria, and by more than the least
  BlockEffect share_effect{};
  BlockEffect time_effect{};  // over the tasks in which robots arrived with every entry
  // Kendall's tau of the entries' order over two halves of the tasks, the mean over 100 random halvings.
  double half_agreement = 0.0;
  double median_deviation = 0.0;              // of the paired differences of the share
  std::optional<std::uint64_t> tasks_needed;  // to find the least difference of the share with 80 %, at 5 %

  double separated_share() const { return pairs > 0 ? static_cast<double>(separated) / pairs : 0.0; }
};

// One for each scenario and number of robots of the trials, for entries that met all its tasks. Empty if nothing can be
// compared.
std::vector<Discrimination> discriminations(const host::SummaryLayout& layout,
                                            std::span<const host::MetricColumn> metrics,
                                            std::span<const host::TrialRecord> trials);

// Of several runs that have two or more entries in common: does it depend on the run how these entries differ?
struct RunInteraction {
  std::vector<std::string> entries;
  std::vector<std::string> runs;
  BlockEffect effect;
  // Of two entries in two runs: by how much more the second run raises the first entry's share than the second's; its
  // interval is a bootstrap over tasks.
  std::optional<double> difference;
  core::Interval interval{};
};

// How discriminations() must find the planners of several runs named.
std::string planner_in_run(const std::string& planner, const std::string& run);

// None with one run, or if fewer than two entries are in all of them.
std::optional<RunInteraction> run_interaction(const Discrimination& result, std::span<const std::string> runs);

// The second entry's share minus the first's, paired by task: its interval is a bootstrap over tasks, p of sign flips.
struct EntryContrast {
  double difference = 0.0;
  core::Interval interval{};
  double p = 1.0;
};

// None if there is no entry of one of these names.
std::optional<EntryContrast> contrast(const Discrimination& result, const std::string& first,
                                      const std::string& second);

// What it misses, in words; empty: it passes. The effect that counts was declared before: of the share, or of the time.
std::vector<std::string> misses(const Discrimination& result, bool declared_time, const DiscriminationBars& bars = {});

}  // namespace dmrp::bench
