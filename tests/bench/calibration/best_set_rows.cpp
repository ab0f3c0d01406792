// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include "core/statistics/best_set.hpp"
#include "core/statistics/descriptive.hpp"
#include "core/statistics/holm.hpp"
#include "core/statistics/signed_rank.hpp"
#include "tests/bench/calibration/rows.hpp"
#include "tests/bench/calibration/truths.hpp"

namespace dmrp::bench {
namespace {

using core::PairedScore;
using toolkit::Stream;

// The criteria of an answer, from values that outlive it. A difference of five points, or of half a second, decides
// nothing.
struct Benchmark {
  Values shares;  // each may be empty: not a criterion
  Values delays;
  Values times;
  std::vector<std::uint32_t> world_of_task;
  core::Scope scope = core::Scope::these_worlds;

  std::size_t entries() const { return std::max({shares.size(), delays.size(), times.size()}); }
  std::vector<core::Criterion> criteria() const {
    std::vector<core::Criterion> found;
    if (!shares.empty())
      found.push_back({core::differences_of(shares), true, PairedScore::mean, 0.05, core::share_bounds});
    if (!delays.empty()) found.push_back({core::differences_of(delays), false, PairedScore::mean, 0.5, {}});
    if (!times.empty()) found.push_back({core::differences_of(times), false, PairedScore::ranks, 0.0, {}});
    return found;
  }
};

Benchmark benchmark_of(Values shares, Values delays, Values times) {
  Benchmark one{std::move(shares), std::move(delays), std::move(times), {}};
  const std::size_t tasks = (one.shares.empty() ? one.times : one.shares).front().size();
  one.world_of_task.assign(tasks, 0);
  return one;
}

using Excluded = std::vector<bool>;  // by entry

Excluded excluded_by_best_set(const Benchmark& benchmark) {
  const core::Resampling resampling(benchmark.world_of_task, benchmark.scope, 0);
  const core::BestSet set = core::best_set(benchmark.entries(), benchmark.criteria(), resampling);
  Excluded excluded;
  for (const auto& one : set.excluded) excluded.push_back(one.has_value());
  return excluded;
}

// The reference: the order by means, then paired tests against its first, corrected by Holm over these and all criteria;
// the first significant criterion decides. Its level holds for two entries; with more, the first is selected unseen.
Excluded excluded_by_first(const Benchmark& benchmark) {
  const std::vector<core::Criterion> criteria = benchmark.criteria();
  const auto gains = [&](const core::Criterion& criterion, std::size_t first, std::size_t other) {
    std::vector<double> found = criterion.differences(first, other);
    if (!criterion.higher_is_better) std::transform(found.begin(), found.end(), found.begin(), std::negate<>());
    return found;
  };
  std::size_t first = 0;
  for (std::size_t entry = 1; entry < benchmark.entries(); ++entry)
    for (const core::Criterion& criterion : criteria) {
      const double gain = core::mean(gains(criterion, first, entry));
      if (std::abs(gain) < 1e-9) continue;
      if (gain > 0.0) first = entry;
      break;
    }
  std::vector<double> p_values;
  std::vector<double> means;
  for (std::size_t entry = 0; entry < benchmark.entries(); ++entry)
    for (const core::Criterion& criterion : criteria) {
      const std::vector<double> differences = gains(criterion, first, entry);
      const bool equal =
          std::all_of(differences.begin(), differences.end(), [](double x) { return std::abs(x) < 1e-9; });
      const core::Resampling one_world(std::vector<std::uint32_t>(differences.size()), core::Scope::these_worlds, 0);
      const double p = criterion.score == PairedScore::ranks
                           ? core::signed_rank_test(differences).p
                           : core::difference_of_tasks(differences, core::share_bounds, one_world).p;
      p_values.push_back(equal ? core::undefined : p);
      means.push_back(core::mean(differences));
    }
  const std::vector<double> adjusted = core::holm_adjusted(p_values);
  Excluded excluded(benchmark.entries(), false);
  for (std::size_t i = adjusted.size(); i-- > 0;)  // an earlier criterion overrules
    if (adjusted[i] < core::significance) excluded[i / criteria.size()] = means[i] < 0.0;
  return excluded;
}

// Whether any of the first entries is excluded.
bool any(const Excluded& excluded, std::size_t first) {
  return std::any_of(excluded.begin(), excluded.begin() + static_cast<std::ptrdiff_t>(first),
                     [](bool one) { return one; });
}

// A false positive: one of the best, the first `best` entries, is excluded. The reference is quick by ranks alone.
Outcome false_positive(const Benchmark& benchmark, std::size_t best) {
  return {any(excluded_by_best_set(benchmark), best),
          benchmark.shares.empty() && any(excluded_by_first(benchmark), best)};
}

// Found: the last entry is excluded.
Outcome found(const Benchmark& benchmark) {
  return {excluded_by_best_set(benchmark).back(), excluded_by_first(benchmark).back()};
}

Row level(const std::string& truth, std::size_t n, std::optional<double> target,
          std::function<Outcome(Stream&)> benchmark) {
  return {"best set", truth, n, Measure::false_positives, target, std::move(benchmark)};
}

Row power(const std::string& truth, std::size_t n, std::optional<double> below,
          std::function<Outcome(Stream&)> benchmark) {
  return {"best set", truth, n, Measure::power, below, std::move(benchmark)};
}

constexpr double most_false = 0.06;

void add_levels(std::vector<Row>& rows) {
  for (const auto& [entries, tasks] : {std::pair{2, 10}, {2, 40}, {8, 10}, {8, 40}, {12, 40}})
    rows.push_back(level(std::to_string(entries) + " equal entries, all arrive", tasks, most_false,
                         [entries = entries, tasks = tasks](Stream& random) {
                           return false_positive(benchmark_of({}, {}, drawn_times(random, entries, tasks)), entries);
                         }));
  for (const auto& [entries, tasks] : {std::pair{2, 10}, {2, 40}, {8, 40}})
    rows.push_back(level(std::to_string(entries) + " equal entries, three criteria", tasks, most_false,
                         [entries = entries, tasks = tasks](Stream& random) {
                           Values shares = drawn_shares(random, entries, tasks);
                           Values delays = drawn_delays(random, entries, tasks);
                           return false_positive(
                               benchmark_of(std::move(shares), std::move(delays), drawn_times(random, entries, tasks)),
                               entries);
                         }));
  for (const std::size_t tasks : {std::size_t{4}, std::size_t{8}})
    rows.push_back(level("4 equal entries, 10 seeds a task, task x entry", tasks, most_false, [tasks](Stream& random) {
      return false_positive(benchmark_of({}, {}, drawn_times_by_seeds(random, 4, tasks, 10)), 4);
    }));
  for (const std::size_t worlds : {std::size_t{5}, std::size_t{8}})
    rows.push_back(level("in general: 4 equal entries, world x entry", worlds, most_false, [worlds](Stream& random) {
      constexpr std::size_t tasks = 5;
      Benchmark one = benchmark_of({}, {}, drawn_times_in_worlds(random, 4, worlds, tasks));
      for (std::size_t i = 0; i < one.world_of_task.size(); ++i)
        one.world_of_task[i] = static_cast<std::uint32_t>(i / tasks);
      one.scope = core::Scope::in_general;
      return false_positive(one, 4);
    }));
  rows.push_back(level("7 equal entries, 1 slower by 10 %", 40, most_false, [](Stream& random) {
    return false_positive(benchmark_of({}, {}, drawn_times(random, 8, 40, 0.1)), 7);
  }));
  for (const std::size_t tasks : {std::size_t{10}, std::size_t{40}, std::size_t{100}})
    rows.push_back(
        level("the other is 20 % faster, but 10 points less safe", tasks, most_false, [tasks](Stream& random) {
          Values shares = drawn_shares(random, 2, tasks, 0.117);
          std::swap(shares[0], shares[1]);  // the first is less safe; the last, which is best, is slower
          const Benchmark one = benchmark_of(std::move(shares), {}, drawn_times(random, 2, tasks, 0.2));
          return Outcome{excluded_by_best_set(one).back()};
        }));
}

// Of shares whose difference is `often` in most tasks and makes up for that in the rest, which `rarely` says.
Benchmark skewed_shares(Stream& random, std::size_t tasks, double often, double rarely) {
  Values shares(2, std::vector<double>(tasks, 0.5));
  for (double& share : shares[1]) share += random.chance(rarely) ? -often * (1.0 - rarely) / rarely : often;
  return benchmark_of(shares, {}, {});
}

void add_skewed_levels(std::vector<Row>& rows) {
  for (const std::size_t tasks : {std::size_t{10}, std::size_t{40}}) {
    rows.push_back(level("shares: +.05 (90 %), -.45 (10 %)", tasks, most_false, [tasks](Stream& random) {
      return false_positive(skewed_shares(random, tasks, 0.05, 0.1), 2);
    }));
    rows.push_back(level("shares: +.08 (86 %), -.49 (14 %)", tasks, std::nullopt, [tasks](Stream& random) {
      return false_positive(skewed_shares(random, tasks, 0.08, 0.14), 2);
    }));
  }
}

void add_powers(std::vector<Row>& rows) {
  constexpr double less = 0.05;
  for (const auto& [tasks, slower] : {std::pair{10, 0.25}, {20, 0.12}, {40, 0.08}})
    rows.push_back(power("2 entries, all arrive, " + std::to_string(std::lround(100.0 * slower)) + " % slower", tasks,
                         less, [tasks = tasks, slower = slower](Stream& random) {
                           return found(benchmark_of({}, {}, drawn_times(random, 2, tasks, slower)));
                         }));
  for (const auto& [tasks, worse] : {std::pair{10, 0.4}, {20, 0.25}, {40, 0.15}})
    rows.push_back(power("2 entries, " + std::to_string(std::lround(100.0 * worse)) + " % of arrivals less", tasks,
                         less, [tasks = tasks, worse = worse](Stream& random) {
                           Values shares = drawn_shares(random, 2, tasks, worse);
                           return found(benchmark_of(std::move(shares), drawn_delays(random, 2, tasks),
                                                     drawn_times(random, 2, tasks)));
                         }));
  for (const std::size_t entries : {std::size_t{3}, std::size_t{8}})
    rows.push_back(power(
        std::to_string(entries) + " entries, all arrive, 10 % slower", 40, std::nullopt,
        [entries](Stream& random) { return found(benchmark_of({}, {}, drawn_times(random, entries, 40, 0.1))); }));
  for (const std::size_t tasks : {std::size_t{40}, std::size_t{200}})
    rows.push_back(power("2 entries, as safe in the mean, 10 % slower", tasks, std::nullopt, [tasks](Stream& random) {
      return found(benchmark_of(drawn_shares(random, 2, tasks), {}, drawn_times(random, 2, tasks, 0.1)));
    }));
}

}  // namespace

std::vector<Row> best_set_rows() {
  std::vector<Row> rows;
  add_levels(rows);
  add_skewed_levels(rows);
  add_powers(rows);
  return rows;
}

}  // namespace dmrp::bench
