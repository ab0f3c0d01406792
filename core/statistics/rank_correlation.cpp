// SPDX-License-Identifier: MIT
#include "core/statistics/rank_correlation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <dmrp/toolkit/random.hpp>
#include <numeric>
#include <utility>

namespace dmrp::core {
namespace {

constexpr std::uint64_t permutations = 5'000;

using Ranks = std::vector<std::int64_t>;

// One metric of an entry's pairs. A value's place among the distinct values, so that ranks follow by counting.
struct RankedValues {
  std::vector<std::size_t> place;
  Ranks ranks;  // centred
};

// The pairs of one entry, and how often a resample holds each.
struct EntryPairs {
  std::vector<std::size_t> tasks;
  RankedValues x;
  RankedValues y;
  std::vector<std::int64_t> count;
};

RankedValues ranked_values(const std::vector<double>& values) {
  std::vector<double> distinct = values;
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  RankedValues ranked{{}, Ranks(values.size())};
  for (const double value : values)
    ranked.place.push_back(
        static_cast<std::size_t>(std::lower_bound(distinct.begin(), distinct.end(), value) - distinct.begin()));
  return ranked;
}

// Doubled midranks minus their mean, of values with multiplicities: integers, so that sums of products are exact.
void rank_by_counts(const std::vector<std::int64_t>& count, RankedValues& values) {
  std::vector<std::int64_t> at(count.size(), 0);  // the number of each distinct value, then its rank
  for (std::size_t i = 0; i < count.size(); ++i) at[values.place[i]] += count[i];
  const std::int64_t total = std::accumulate(at.begin(), at.end(), std::int64_t{0});
  std::int64_t below = 0;
  for (std::int64_t& here : at) {
    const std::int64_t number = here;
    here = 2 * below + number - total;
    below += number;
  }
  for (std::size_t i = 0; i < count.size(); ++i) values.ranks[i] = at[values.place[i]];
}

std::vector<EntryPairs> pairs_of(std::span<const std::vector<double>> x, std::span<const std::vector<double>> y) {
  std::vector<EntryPairs> entries;
  for (std::size_t entry = 0; entry < x.size(); ++entry) {
    EntryPairs pairs;
    std::vector<double> of_x;
    std::vector<double> of_y;
    for (std::size_t task = 0; task < x[entry].size(); ++task) {
      if (std::isnan(x[entry][task]) || std::isnan(y[entry][task])) continue;
      pairs.tasks.push_back(task);
      of_x.push_back(x[entry][task]);
      of_y.push_back(y[entry][task]);
    }
    pairs.x = ranked_values(of_x);
    pairs.y = ranked_values(of_y);
    pairs.count.assign(of_x.size(), 1);
    entries.push_back(std::move(pairs));
  }
  return entries;
}

std::vector<std::size_t> tasks_of(std::span<const EntryPairs> entries) {
  std::vector<std::size_t> tasks;
  for (const EntryPairs& one : entries) tasks.insert(tasks.end(), one.tasks.begin(), one.tasks.end());
  std::sort(tasks.begin(), tasks.end());
  tasks.erase(std::unique(tasks.begin(), tasks.end()), tasks.end());
  return tasks;
}

// Of the ranks by the pairs' counts.
double correlation_of(std::vector<EntryPairs>& entries) {
  std::int64_t xx = 0;
  std::int64_t xy = 0;
  std::int64_t yy = 0;
  for (EntryPairs& one : entries) {
    rank_by_counts(one.count, one.x);
    rank_by_counts(one.count, one.y);
    for (std::size_t i = 0; i < one.count.size(); ++i) {
      xx += one.count[i] * one.x.ranks[i] * one.x.ranks[i];
      xy += one.count[i] * one.x.ranks[i] * one.y.ranks[i];
      yy += one.count[i] * one.y.ranks[i] * one.y.ranks[i];
    }
  }
  if (xx == 0 || yy == 0) return undefined;
  const double spread = std::sqrt(static_cast<double>(xx)) * std::sqrt(static_cast<double>(yy));
  return std::clamp(static_cast<double>(xy) / spread, -1.0, 1.0);
}

double ties_share_of(std::span<const EntryPairs> entries) {
  std::uint64_t tied = 0;
  std::uint64_t pairs = 0;
  for (const EntryPairs& one : entries)
    for (std::size_t i = 0; i < one.tasks.size(); ++i)
      for (std::size_t j = 0; j < i; ++j, ++pairs)
        if (one.x.place[i] == one.x.place[j] || one.y.place[i] == one.y.place[j]) ++tied;
  return pairs == 0 ? undefined : static_cast<double>(tied) / static_cast<double>(pairs);
}

// The sum of products of x with y in the order of `tasks`; tasks that an entry has no pair for are skipped.
std::int64_t permuted_product(std::span<const EntryPairs> entries, const std::vector<std::vector<std::size_t>>& pair_of,
                              const std::vector<std::size_t>& tasks) {
  std::int64_t sum = 0;
  for (std::size_t entry = 0; entry < entries.size(); ++entry) {
    const Ranks& y = entries[entry].y.ranks;
    auto next = entries[entry].x.ranks.begin();
    for (const std::size_t task : tasks)
      if (const std::size_t own = pair_of[entry][task]; own < y.size()) sum += *next++ * y[own];
  }
  return sum;
}

double permutation_p(std::span<const EntryPairs> entries, std::vector<std::size_t> tasks, std::uint64_t seed) {
  std::vector<std::vector<std::size_t>> pair_of;  // [entry][task]; as many as there are pairs: none
  for (const EntryPairs& one : entries) {
    pair_of.emplace_back(tasks.back() + 1, one.tasks.size());
    for (std::size_t i = 0; i < one.tasks.size(); ++i) pair_of.back()[one.tasks[i]] = i;
  }
  const std::int64_t observed = std::abs(permuted_product(entries, pair_of, tasks));
  toolkit::Stream random(seed, "statistics.rank_correlation");
  std::uint64_t as_far = 1;
  for (std::uint64_t i = 0; i < permutations; ++i) {
    random.shuffle(tasks);
    if (std::abs(permuted_product(entries, pair_of, tasks)) >= observed) ++as_far;
  }
  return static_cast<double>(as_far) / static_cast<double>(permutations + 1);
}

}  // namespace

RankCorrelation task_rank_correlation(std::span<const std::vector<double>> x, std::span<const std::vector<double>> y,
                                      const Resampling& resampling, std::uint64_t seed) {
  assert(x.size() == y.size());
  std::vector<EntryPairs> entries = pairs_of(x, y);
  const std::vector<std::size_t> tasks = tasks_of(entries);
  RankCorrelation result;
  result.n = static_cast<std::uint32_t>(tasks.size());
  if (tasks.size() < fewest_for_correlation) return result;
  result.ties_share = ties_share_of(entries);
  result.rho = correlation_of(entries);
  if (std::isnan(result.rho)) return result;
  result.p = permutation_p(entries, tasks, seed);

  std::vector<double> resampled;
  for (std::size_t i = 0; i < resampling.resamples(); ++i) {
    for (EntryPairs& one : entries)
      for (std::size_t k = 0; k < one.count.size(); ++k)
        one.count[k] = resampling.counts(i)[resampling.observation_of_task(one.tasks[k])];
    resampled.push_back(correlation_of(entries));
  }
  result.interval = percentile_interval(std::move(resampled));
  return result;
}

}  // namespace dmrp::core
