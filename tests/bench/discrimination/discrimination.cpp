// SPDX-License-Identifier: MIT
#include "tests/bench/discrimination/discrimination.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <map>
#include <utility>

#include "core/statistics/descriptive.hpp"
#include "core/statistics/holm.hpp"
#include "core/statistics/mean_of_tasks.hpp"
#include "core/statistics/sample_size.hpp"
#include "core/statistics/signed_rank.hpp"
#include "host/ranking/measures.hpp"
#include "host/ranking/paired_difference.hpp"

namespace dmrp::bench {

using namespace host;

namespace {

// Intervals of shares need no resamples.
core::Resampling one_world(std::size_t tasks) {
  return {std::vector<std::uint32_t>(tasks), core::Scope::these_worlds, 0};
}

constexpr std::uint64_t halvings = 100;

// The criterion that counts as the share, and the time.
struct Criteria {
  Criterion share;
  std::optional<Criterion> time;
};

// Entries that met the same tasks.
struct Contest {
  const Measures& measures;
  const Observations& observations;
  Findings findings;

  std::vector<std::size_t> trials_of(std::size_t entry) const {
    std::vector<std::size_t> trials;
    for (const auto& of_situation : findings.trials[entry])
      trials.insert(trials.end(), of_situation.begin(), of_situation.end());
    return trials;
  }
  // By task; NaN: undefined.
  std::vector<double> values(std::size_t entry, const Criterion& criterion) const {
    return observation_means(observations, trials_of(entry),
                             [&](std::size_t trial) { return measures.value(trial, criterion); });
  }
  double mean(std::size_t entry, const Criterion& criterion) const {
    return core::mean(defined(values(entry, criterion)));
  }

  // Of the tasks that both met.
  std::vector<double> differences(std::size_t a, std::size_t b, const Criterion& criterion) const {
    return defined(
        joint_findings(findings, observations, std::vector{a, b}, measures.joint(criterion)).differences(0, 1));
  }

  static std::vector<double> defined(std::vector<double> values) {
    std::erase_if(values, [](double value) { return std::isnan(value); });
    return values;
  }
};

std::vector<std::vector<double>> by_task(const Contest& contest, const Criterion& criterion) {
  std::vector<std::vector<double>> table;
  for (std::size_t entry = 0; entry < contest.findings.entries.size(); ++entry)
    table.push_back(contest.values(entry, criterion));
  return table;
}

// The tasks in which every entry has a value.
std::vector<std::vector<double>> complete(const std::vector<std::vector<double>>& table) {
  std::vector<std::vector<double>> out(table.size());
  for (std::size_t task = 0; task < table.front().size(); ++task) {
    if (std::any_of(table.begin(), table.end(), [&](const auto& row) { return std::isnan(row[task]); })) continue;
    for (std::size_t entry = 0; entry < table.size(); ++entry) out[entry].push_back(table[entry][task]);
  }
  return out;
}

// The test of one pair of entries by one criterion.
struct PairTest {
  double p = core::undefined;  // NaN: nothing differs
  bool is_large = false;
};

PairTest test_pair(const Contest& contest, std::size_t a, std::size_t b, const Criterion& criterion) {
  const std::vector<double> differences = contest.differences(a, b, criterion);
  PairTest test;
  if (differences.size() < 2) return test;
  const double least = criterion.share()
                           ? least_share_difference
                           : least_time_ratio * std::fmax(contest.mean(a, criterion), contest.mean(b, criterion));
  test.is_large = std::abs(core::mean(differences)) > least;
  if (std::all_of(differences.begin(), differences.end(), [](double one) { return std::abs(one) < rounding; }))
    return test;
  test.p = criterion.share()
               ? core::difference_of_tasks(differences, core::share_bounds, one_world(differences.size())).p
               : core::signed_rank_test(differences).p;
  return test;
}

void test_pairs(const Contest& contest, const Criteria& criteria, Discrimination& result) {
  std::vector<Criterion> tested = {criteria.share};
  if (criteria.time) tested.push_back(*criteria.time);
  std::vector<PairTest> tests;
  std::vector<double> p_values;
  std::vector<double> deviations;
  for (std::size_t a = 0; a < result.entries.size(); ++a)
    for (std::size_t b = a + 1; b < result.entries.size(); ++b, ++result.pairs) {
      for (const Criterion& criterion : tested) {
        tests.push_back(test_pair(contest, a, b, criterion));
        p_values.push_back(tests.back().p);
      }
      const std::vector<double> differences = contest.differences(a, b, criteria.share);
      if (differences.size() > 1) deviations.push_back(core::sample_sd(differences));
    }
  const std::vector<double> adjusted = core::holm_adjusted(p_values);
  for (std::size_t pair = 0; pair < result.pairs; ++pair) {
    bool apart = false;
    for (std::size_t i = pair * tested.size(); i < (pair + 1) * tested.size(); ++i)
      apart = apart || (tests[i].is_large && adjusted[i] < significant);
    result.separated += apart ? 1 : 0;
  }
  result.median_deviation = deviations.empty() ? core::undefined : core::median(deviations);
  result.tasks_needed = core::pairs_needed(result.median_deviation, least_share_difference, significant);
}

// The entries' scores over some of the tasks: their positions in the order of better ones, equal ones alike.
std::vector<double> positions_over(const Criteria& criteria, const std::vector<std::vector<double>>& shares,
                                   const std::vector<std::vector<double>>& times, const std::vector<char>& chosen) {
  const auto mean_over = [&](const std::vector<double>& row) {
    std::vector<double> values;
    for (std::size_t task = 0; task < row.size(); ++task)
      if (chosen[task] && !std::isnan(row[task])) values.push_back(row[task]);
    return core::mean(values);
  };
  std::vector<Criterion> order = {criteria.share};
  if (criteria.time) order.push_back(*criteria.time);
  std::vector<std::vector<double>> means;
  for (std::size_t entry = 0; entry < shares.size(); ++entry) {
    means.push_back({mean_over(shares[entry])});
    if (criteria.time) means.back().push_back(mean_over(times[entry]));
  }
  std::vector<double> positions;
  for (const auto& one : means)
    positions.push_back(static_cast<double>(
        std::count_if(means.begin(), means.end(), [&](const auto& other) { return is_better(order, other, one); })));
  return positions;
}

double half_agreement(const Criteria& criteria, const std::vector<std::vector<double>>& shares,
                      const std::vector<std::vector<double>>& times) {
  const std::size_t tasks = shares.front().size();
  if (tasks < 2) return core::undefined;
  std::vector<double> found;
  for (std::uint64_t i = 0; i < halvings; ++i) {
    toolkit::Stream stream(i, "discrimination.halves");
    std::vector<std::size_t> order(tasks);
    for (std::size_t task = 0; task < tasks; ++task) order[task] = task;
    stream.shuffle(order);
    std::vector<char> first(tasks, 0);
    for (std::size_t k = 0; k < tasks / 2; ++k) first[order[k]] = 1;
    std::vector<char> second(tasks, 1);
    for (std::size_t task = 0; task < tasks; ++task) second[task] = first[task] ? 0 : 1;
    const double tau =
        kendall_tau(positions_over(criteria, shares, times, first), positions_over(criteria, shares, times, second));
    if (!std::isnan(tau)) found.push_back(tau);
  }
  return core::mean(found);
}

Discrimination discrimination_of(const Contest& contest, const Criteria& criteria) {
  Discrimination result;
  result.scenario = contest.findings.situations.front().cell.scenario;
  result.robots = contest.findings.situations.front().cell.robots;
  const auto shares = by_task(contest, criteria.share);
  const auto times = criteria.time ? by_task(contest, *criteria.time) : std::vector<std::vector<double>>();
  const auto complete_shares = complete(shares);
  result.tasks = static_cast<std::uint32_t>(complete_shares.front().size());
  std::vector<double> means;
  for (std::size_t entry = 0; entry < contest.findings.entries.size(); ++entry) {
    const CombinationLabels& labels = contest.findings.entries[entry];
    result.entries.push_back(
        {labels.global_planner + " + " + labels.local_controller, contest.mean(entry, criteria.share),
         criteria.time ? contest.mean(entry, *criteria.time) : core::undefined, complete_shares[entry]});
    means.push_back(result.entries.back().share);
    result.at_ceiling += means.back() >= DiscriminationBars().ceiling - rounding ? 1 : 0;
  }
  result.mean_share = core::mean(means);
  test_pairs(contest, criteria, result);
  result.share_effect = block_effect(complete_shares);
  if (criteria.time) result.time_effect = block_effect(complete(times));
  result.half_agreement = half_agreement(criteria, shares, times);
  return result;
}

// An entry without its run, and its shares by task in each run (its index).
struct EntryInRuns {
  std::string name;
  std::map<std::size_t, std::vector<double>> shares{};
};

// Those that are in all runs.
std::vector<EntryInRuns> entries_in_all(const Discrimination& result, std::span<const std::string> runs) {
  std::vector<EntryInRuns> found;
  for (const DiscriminationEntry& entry : result.entries)
    for (std::size_t run = 0; run < runs.size(); ++run) {
      const std::string mark = planner_in_run("", runs[run]);
      const std::size_t at = entry.name.find(mark);
      if (at == std::string::npos) continue;
      const std::string name = std::string(entry.name).erase(at, mark.size());
      auto known = std::find_if(found.begin(), found.end(), [&](const auto& one) { return one.name == name; });
      if (known == found.end()) known = found.insert(found.end(), EntryInRuns{name, {}});
      known->shares[run] = entry.shares;
    }
  std::erase_if(found, [&](const EntryInRuns& one) { return one.shares.size() < runs.size(); });
  return found;
}

}  // namespace

std::vector<Discrimination> discriminations(const SummaryLayout& layout, std::span<const MetricColumn> metrics,
                                            std::span<const TrialRecord> trials) {
  const Measures measures(layout, metrics, trials);
  if (measures.criteria().empty()) return {};
  const Observations observations = observations_of(trials);
  Criteria criteria = {measures.criteria().front(), {}};
  if (measures.criteria().back().kind == Criterion::Kind::time) criteria.time = measures.criteria().back();
  std::vector<CombinationLabels> cells;
  for (const TrialRecord& trial : trials) {
    const CombinationLabels cell = {trial.scenario, trial.robots, "", "", trial.pedestrian_model};
    if (trial.robots > 0 && std::find(cells.begin(), cells.end(), cell) == cells.end()) cells.push_back(cell);
  }
  std::vector<Discrimination> all;
  for (const CombinationLabels& cell : cells) {
    const Contest contest{measures, observations, make_findings(trials, observations, [&](std::size_t i) {
                            const auto split = by_planner_and_controller(trials[i]);
                            return split && split->cell == cell ? split : std::nullopt;
                          })};
    if (contest.findings.entries.size() > 1) all.push_back(discrimination_of(contest, criteria));
  }
  return all;
}

std::string planner_in_run(const std::string& planner, const std::string& run) {
  return planner + " (" + run + ")";
}

std::optional<RunInteraction> run_interaction(const Discrimination& result, std::span<const std::string> runs) {
  if (runs.size() < 2) return std::nullopt;
  const std::vector<EntryInRuns> found = entries_in_all(result, runs);
  if (found.size() < 2) return std::nullopt;
  RunInteraction out;
  out.runs.assign(runs.begin(), runs.end());
  std::vector<std::vector<std::vector<double>>> table;  // [entry][run][task]
  for (const EntryInRuns& one : found) {
    out.entries.push_back(one.name);
    auto& row = table.emplace_back();
    for (const auto& of_run : one.shares) row.push_back(of_run.second);
  }
  out.effect = interaction_effect(table);
  if (table.size() != 2 || runs.size() != 2) return out;
  std::vector<double> all;
  for (std::size_t task = 0; task < table[0][0].size(); ++task)
    all.push_back((table[0][1][task] - table[0][0][task]) - (table[1][1][task] - table[1][0][task]));
  const core::MeanOfTasks over_tasks = core::mean_of_tasks(all, core::Interval{-2.0, 2.0}, one_world(all.size()));
  out.difference = over_tasks.mean;
  out.interval = over_tasks.interval;
  return out;
}

std::optional<EntryContrast> contrast(const Discrimination& result, const std::string& first,
                                      const std::string& second) {
  const auto entry = [&](const std::string& name) {
    return std::find_if(result.entries.begin(), result.entries.end(),
                        [&](const auto& one) { return one.name == name; });
  };
  const auto a = entry(first);
  const auto b = entry(second);
  if (a == result.entries.end() || b == result.entries.end()) return std::nullopt;
  std::vector<double> differences;
  for (std::size_t task = 0; task < a->shares.size(); ++task) differences.push_back(b->shares[task] - a->shares[task]);
  const core::MeanOfTasks over_tasks =
      core::difference_of_tasks(differences, core::share_bounds, one_world(differences.size()));
  return EntryContrast{over_tasks.mean, over_tasks.interval, over_tasks.p};
}

std::vector<std::string> misses(const Discrimination& result, bool declared_time, const DiscriminationBars& bars) {
  std::vector<std::string> out;
  if (result.mean_share < bars.mean_low || result.mean_share > bars.mean_high)
    out.push_back(fmt::format("mean {:.2f} outside [{}, {}]", result.mean_share, bars.mean_low, bars.mean_high));
  if (2 * result.at_ceiling > result.entries.size())
    out.push_back(fmt::format("{} of {} entries at the ceiling", result.at_ceiling, result.entries.size()));
  if (result.separated_share() < bars.separated_pairs)
    out.push_back(fmt::format("D {:.2f} below {}", result.separated_share(), bars.separated_pairs));
  const BlockEffect& effect = declared_time ? result.time_effect : result.share_effect;
  if (!(effect.partial_eta_squared >= bars.effect && effect.interval.low > bars.effect_low))
    out.push_back(fmt::format("partial eta squared {:.2f} [{:.2f}, {:.2f}]", effect.partial_eta_squared,
                              effect.interval.low, effect.interval.high));
  if (!(result.half_agreement >= bars.half_agreement))
    out.push_back(fmt::format("tau of halves {:.2f} below {}", result.half_agreement, bars.half_agreement));
  return out;
}

}  // namespace dmrp::bench
