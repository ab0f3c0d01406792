// SPDX-License-Identifier: MIT
#include "core/statistics/rank_correlation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <dmrp/toolkit/random.hpp>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "core/statistics/descriptive.hpp"
#include "core/statistics/ranks.hpp"

namespace dmrp::core {
namespace {

constexpr std::size_t most_exact_points = 8;
constexpr std::uint64_t permutations = 5'000;
constexpr std::uint32_t resamples = 1'000;

using Ranks = std::vector<std::int64_t>;

// Doubled midranks minus their mean, n + 1: integers, so that sums of products are exact.
Ranks centered_ranks(std::span<const double> values) {
  Ranks ranks = doubled_midranks(values);
  for (std::int64_t& rank : ranks) rank -= static_cast<std::int64_t>(values.size()) + 1;
  return ranks;
}

std::int64_t product(const Ranks& a, const Ranks& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), std::int64_t{0});
}

// Clamped to [-1, 1] against rounding.
double correlation_of(std::int64_t xx, std::int64_t xy, std::int64_t yy) {
  if (xx == 0 || yy == 0) return undefined;
  const double spread = std::sqrt(static_cast<double>(xx)) * std::sqrt(static_cast<double>(yy));
  return std::clamp(static_cast<double>(xy) / spread, -1.0, 1.0);
}

double exact_p(const Ranks& x, Ranks y) {
  const std::int64_t observed = std::abs(product(x, y));
  std::vector<std::size_t> order(y.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::uint64_t as_far = 0;
  std::uint64_t orders = 0;
  do {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[order[i]];
    if (std::abs(sum) >= observed) ++as_far;
    ++orders;
  } while (std::next_permutation(order.begin(), order.end()));
  return static_cast<double>(as_far) / static_cast<double>(orders);
}

// The observations of each block, as indices into the whole.
std::vector<std::vector<std::size_t>> members_of(std::size_t n, std::span<const std::uint32_t> block) {
  std::map<std::uint32_t, std::vector<std::size_t>> found;
  for (std::size_t i = 0; i < n; ++i) found[block.empty() ? 0 : block[i]].push_back(i);
  std::vector<std::vector<std::size_t>> blocks;
  for (auto& [id, members] : found) blocks.push_back(std::move(members));
  return blocks;
}

// The sum over blocks. All ranks are centred in their block, so its mean over all permutations within blocks is zero.
std::int64_t product(const std::vector<Ranks>& a, const std::vector<Ranks>& b) {
  std::int64_t sum = 0;
  for (std::size_t block = 0; block < a.size(); ++block) sum += product(a[block], b[block]);
  return sum;
}

double drawn_p(const std::vector<Ranks>& x, std::vector<Ranks> y, std::uint64_t seed) {
  const std::int64_t observed = std::abs(product(x, y));
  toolkit::Stream random(seed, "statistics.rank_correlation");
  std::uint64_t as_far = 1;
  for (std::uint64_t draw = 0; draw < permutations; ++draw) {
    for (Ranks& of_block : y) random.shuffle(of_block);
    if (std::abs(product(x, y)) >= observed) ++as_far;
  }
  return static_cast<double>(as_far) / static_cast<double>(permutations + 1);
}

// The index of each value among the distinct values; the ranks of a resample then follow by counting.
std::vector<std::uint32_t> places(std::span<const double> values) {
  std::vector<double> distinct(values.begin(), values.end());
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  std::vector<std::uint32_t> found;
  for (const double value : values)
    found.push_back(
        static_cast<std::uint32_t>(std::lower_bound(distinct.begin(), distinct.end(), value) - distinct.begin()));
  return found;
}

// Centred doubled midranks of values with multiplicities `count`.
void rank_by_counts(const std::vector<std::uint32_t>& place, const std::vector<std::uint32_t>& count, Ranks& ranks) {
  std::vector<std::int64_t> at(place.size() + 1, 0);  // the number of each distinct value
  for (std::size_t i = 0; i < place.size(); ++i) at[place[i]] += count[i];
  std::int64_t below = 0;
  const std::int64_t total = std::accumulate(at.begin(), at.end(), std::int64_t{0});
  for (std::int64_t& here : at) {
    const std::int64_t number = here;
    here = 2 * below + number + 1 - (total + 1);
    below += number;
  }
  for (std::size_t i = 0; i < place.size(); ++i) ranks[i] = at[place[i]];
}

// A block in a resample: the place of each value, how often the resample holds it, and its rank there.
struct ResampledBlock {
  std::vector<std::size_t> members;
  std::vector<std::uint32_t> place_x;
  std::vector<std::uint32_t> place_y;
  std::vector<std::uint32_t> count;
  Ranks x;
  Ranks y;
};

double weighted_correlation(const std::vector<ResampledBlock>& blocks) {
  std::int64_t xx = 0;
  std::int64_t xy = 0;
  std::int64_t yy = 0;
  for (const ResampledBlock& block : blocks) {
    for (std::size_t i = 0; i < block.count.size(); ++i) {
      xx += block.count[i] * block.x[i] * block.x[i];
      xy += block.count[i] * block.x[i] * block.y[i];
      yy += block.count[i] * block.y[i] * block.y[i];
    }
  }
  return correlation_of(xx, xy, yy);
}

// The index of each observation's cluster, counted from 0.
std::vector<std::uint32_t> indices_of(std::span<const std::uint64_t> cluster) {
  std::map<std::uint64_t, std::uint32_t> index_of;
  for (const std::uint64_t id : cluster) index_of.emplace(id, 0);
  std::uint32_t next = 0;
  for (auto& [id, index] : index_of) index = next++;
  std::vector<std::uint32_t> indices;
  for (const std::uint64_t id : cluster) indices.push_back(index_of.at(id));
  return indices;
}

std::vector<double> selected(std::span<const double> values, const std::vector<std::size_t>& members) {
  std::vector<double> found;
  for (const std::size_t i : members) found.push_back(values[i]);
  return found;
}

Interval bootstrap(std::span<const double> x, std::span<const double> y, std::span<const std::uint64_t> cluster,
                   const std::vector<std::vector<std::size_t>>& members, std::uint64_t seed) {
  const std::vector<std::uint32_t> cluster_of = indices_of(cluster);
  const std::size_t clusters = 1 + *std::max_element(cluster_of.begin(), cluster_of.end());
  if (clusters < 2) return {undefined, undefined};
  std::vector<ResampledBlock> blocks;
  for (const auto& of_block : members) {
    const std::size_t n = of_block.size();
    blocks.push_back({of_block, places(selected(x, of_block)), places(selected(y, of_block)),
                      std::vector<std::uint32_t>(n), Ranks(n), Ranks(n)});
  }
  const BootstrapDraws drawn(clusters, {resamples, seed});
  std::vector<std::uint32_t> of_cluster(clusters);
  std::vector<double> correlations;
  for (std::size_t i = 0; i < drawn.resamples(); ++i) {
    std::fill(of_cluster.begin(), of_cluster.end(), 0);
    for (const std::uint32_t draw : drawn.resample(i)) ++of_cluster[draw];
    for (ResampledBlock& block : blocks) {
      for (std::size_t k = 0; k < block.count.size(); ++k) block.count[k] = of_cluster[cluster_of[block.members[k]]];
      rank_by_counts(block.place_x, block.count, block.x);
      rank_by_counts(block.place_y, block.count, block.y);
    }
    correlations.push_back(weighted_correlation(blocks));
  }
  return percentile_interval(std::move(correlations));
}

// Undefined without a pair.
double share_of_ties(std::span<const double> x, std::span<const double> y,
                     const std::vector<std::vector<std::size_t>>& members) {
  std::uint64_t tied = 0;
  std::uint64_t pairs = 0;
  for (const auto& of_block : members) {
    for (auto i = of_block.begin(); i != of_block.end(); ++i)
      for (auto j = of_block.begin(); j != i; ++j, ++pairs)
        if (x[*i] == x[*j] || y[*i] == y[*j]) ++tied;
  }
  return pairs == 0 ? undefined : static_cast<double>(tied) / static_cast<double>(pairs);
}

}  // namespace

RankCorrelation rank_correlation(std::span<const double> x, std::span<const double> y,
                                 std::span<const std::uint64_t> cluster, std::span<const std::uint32_t> block,
                                 std::uint64_t seed) {
  assert(y.size() == x.size() && cluster.size() == x.size() && (block.empty() || block.size() == x.size()));
  RankCorrelation result{
      static_cast<std::uint32_t>(x.size()), undefined, {undefined, undefined}, undefined, true, undefined};
  if (x.size() < 2) return result;
  const std::vector<std::vector<std::size_t>> members = members_of(x.size(), block);
  result.ties_share = share_of_ties(x, y, members);
  std::vector<Ranks> ranks_x;
  std::vector<Ranks> ranks_y;
  for (const auto& of_block : members) {
    ranks_x.push_back(centered_ranks(selected(x, of_block)));
    ranks_y.push_back(centered_ranks(selected(y, of_block)));
  }
  result.rho = correlation_of(product(ranks_x, ranks_x), product(ranks_x, ranks_y), product(ranks_y, ranks_y));
  if (std::isnan(result.rho)) return result;
  result.exact = x.size() <= most_exact_points && members.size() == 1;
  result.p = result.exact ? exact_p(ranks_x[0], ranks_y[0]) : drawn_p(ranks_x, ranks_y, seed);
  result.interval = bootstrap(x, y, cluster, members, seed);
  return result;
}

namespace {

// The pairs of one entry.
struct EntryPairs {
  std::vector<std::size_t> tasks;
  std::vector<double> x;
  std::vector<double> y;
};

std::vector<EntryPairs> pairs_of(std::span<const std::vector<double>> x, std::span<const std::vector<double>> y) {
  std::vector<EntryPairs> entries;
  for (std::size_t entry = 0; entry < x.size(); ++entry) {
    EntryPairs pairs;
    for (std::size_t task = 0; task < x[entry].size(); ++task) {
      if (std::isnan(x[entry][task]) || std::isnan(y[entry][task])) continue;
      pairs.tasks.push_back(task);
      pairs.x.push_back(x[entry][task]);
      pairs.y.push_back(y[entry][task]);
    }
    if (pairs.tasks.size() > 1) entries.push_back(std::move(pairs));
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

// The place of each task in an entry's pairs; the number of pairs where it has none.
std::vector<std::size_t> places_of_tasks(const EntryPairs& entry, std::size_t tasks) {
  std::vector<std::size_t> places(tasks, entry.tasks.size());
  for (std::size_t i = 0; i < entry.tasks.size(); ++i) places[entry.tasks[i]] = i;
  return places;
}

// The sum of products of x with y in the order of `tasks`; tasks that an entry has no pair for are skipped.
std::int64_t permuted_product(const std::vector<Ranks>& x, const std::vector<Ranks>& y,
                              const std::vector<std::vector<std::size_t>>& place,
                              const std::vector<std::size_t>& tasks) {
  std::int64_t sum = 0;
  for (std::size_t entry = 0; entry < x.size(); ++entry) {
    std::size_t next = 0;
    for (const std::size_t task : tasks)
      if (const std::size_t own = place[entry][task]; own < x[entry].size()) sum += x[entry][next++] * y[entry][own];
  }
  return sum;
}

}  // namespace

RankCorrelation task_rank_correlation(std::span<const std::vector<double>> x, std::span<const std::vector<double>> y,
                                      const Resampling& resampling, std::uint64_t seed) {
  assert(x.size() == y.size());
  const std::vector<EntryPairs> entries = pairs_of(x, y);
  const std::vector<std::size_t> tasks = tasks_of(entries);
  RankCorrelation result{static_cast<std::uint32_t>(tasks.size()), undefined, {}, undefined, true, undefined};
  if (tasks.size() < fewest_for_correlation) return result;
  std::vector<Ranks> ranks_x;
  std::vector<Ranks> ranks_y;
  std::uint64_t pairs = 0;
  double tied = 0.0;
  std::vector<ResampledBlock> blocks;
  for (const EntryPairs& one : entries) {
    ranks_x.push_back(centered_ranks(one.x));
    ranks_y.push_back(centered_ranks(one.y));
    const std::size_t n = one.x.size();
    std::vector<std::size_t> members(n);
    std::iota(members.begin(), members.end(), std::size_t{0});
    tied += share_of_ties(one.x, one.y, {members}) * static_cast<double>(n * (n - 1) / 2);
    pairs += n * (n - 1) / 2;
    blocks.push_back({one.tasks, places(one.x), places(one.y), std::vector<std::uint32_t>(n), Ranks(n), Ranks(n)});
  }
  result.ties_share = tied / static_cast<double>(pairs);
  result.rho = correlation_of(product(ranks_x, ranks_x), product(ranks_x, ranks_y), product(ranks_y, ranks_y));
  if (std::isnan(result.rho)) return result;

  const std::int64_t observed = std::abs(product(ranks_x, ranks_y));
  std::vector<std::vector<std::size_t>> place;
  for (const EntryPairs& one : entries) place.push_back(places_of_tasks(one, resampling.tasks()));
  std::vector<std::size_t> order = tasks;
  toolkit::Stream random(seed, "statistics.task_rank_correlation");
  std::uint64_t as_far = 1;
  for (std::uint64_t draw = 0; draw < permutations; ++draw) {
    random.shuffle(order);
    if (std::abs(permuted_product(ranks_x, ranks_y, place, order)) >= observed) ++as_far;
  }
  result.exact = false;
  result.p = static_cast<double>(as_far) / static_cast<double>(permutations + 1);

  std::vector<double> correlations;
  for (std::size_t i = 0; i < resampling.resamples(); ++i) {
    for (ResampledBlock& block : blocks) {
      for (std::size_t k = 0; k < block.count.size(); ++k)
        block.count[k] = resampling.counts(i)[resampling.observation_of_task(block.members[k])];
      rank_by_counts(block.place_x, block.count, block.x);
      rank_by_counts(block.place_y, block.count, block.y);
    }
    correlations.push_back(weighted_correlation(blocks));
  }
  result.interval = percentile_interval(std::move(correlations));
  return result;
}

}  // namespace dmrp::core
