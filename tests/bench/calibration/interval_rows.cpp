// SPDX-License-Identifier: MIT
#include <cmath>

#include "core/statistics/mean_of_tasks.hpp"
#include "core/statistics/signed_rank.hpp"
#include "tests/bench/calibration/rows.hpp"
#include "tests/bench/calibration/truths.hpp"

namespace dmrp::bench {
namespace {

using toolkit::Stream;

core::Resampling one_world(std::size_t tasks, std::uint32_t resamples) {
  return {std::vector<std::uint32_t>(tasks, 0), core::Scope::these_worlds, resamples};
}

Outcome covers(const core::Interval& interval, double truth) {
  constexpr double rounding = 1e-9;
  return {interval.low <= truth + rounding && interval.high >= truth - rounding, false, interval.high - interval.low};
}

template <class Value>
std::vector<double> drawn(std::size_t n, Value value) {
  std::vector<double> values(n);
  for (double& one : values) one = value();
  return values;
}

std::vector<double> pair_differences(const Values& entries) {
  std::vector<double> differences(entries[0].size());
  for (std::size_t i = 0; i < differences.size(); ++i) differences[i] = entries[1][i] - entries[0][i];
  return differences;
}

Row row(const std::string& procedure, const std::string& truth, std::size_t n, std::optional<double> target,
        std::function<Outcome(Stream&)> benchmark) {
  return {procedure, truth, n, Measure::coverage, target, std::move(benchmark)};
}

void add_shares(std::vector<Row>& rows) {
  for (const auto& [share, words] : {std::pair{0.99, "share .99"}, {0.8, "share .8"}})
    for (const std::size_t n : {std::size_t{5}, std::size_t{10}, std::size_t{20}, std::size_t{40}})
      rows.push_back(row("mean, bounded", words, n, 0.93, [share = share, n](Stream& random) {
        const auto values = drawn(n, [&] { return random.chance(share) ? 1.0 : 0.0; });
        return covers(core::mean_of_tasks(values, core::share_bounds, one_world(n, 0)).interval, share);
      }));
  for (const std::size_t n : {std::size_t{10}, std::size_t{20}, std::size_t{40}, std::size_t{100}}) {
    rows.push_back(row("difference, bounded", "shares .9 and .9 of one robot", n, 0.93, [n](Stream& random) {
      const auto differences =
          drawn(n, [&] { return (random.chance(0.9) ? 1.0 : 0.0) - (random.chance(0.9) ? 1.0 : 0.0); });
      return covers(core::difference_of_tasks(differences, core::share_bounds, one_world(n, 0)).interval, 0.0);
    }));
    rows.push_back(row("difference, bounded", "-1 in 1 of 20 tasks, else 0", n, 0.93, [n](Stream& random) {
      const auto differences = drawn(n, [&] { return random.chance(0.05) ? -1.0 : 0.0; });
      return covers(core::difference_of_tasks(differences, core::share_bounds, one_world(n, 0)).interval, -0.05);
    }));
    rows.push_back(row("difference, bounded", "shares of five robots, equal", n, 0.93, [n](Stream& random) {
      const auto differences = pair_differences(drawn_shares(random, 2, n));
      return covers(core::difference_of_tasks(differences, core::share_bounds, one_world(n, 0)).interval, 0.0);
    }));
  }
}

void add_unbounded(std::vector<Row>& rows) {
  for (const std::size_t n : {std::size_t{5}, std::size_t{8}})
    rows.push_back(row("difference, unbounded", "equal entries' times", n, 0.93, [n](Stream& random) {
      const auto differences = pair_differences(drawn_times(random, 2, n));
      return covers(core::difference_of_tasks(differences, {}, one_world(n, 0)).interval, 0.0);
    }));
  for (const auto& [n, target] :
       {std::pair{std::size_t{10}, 0.91}, {std::size_t{20}, 0.91}, {std::size_t{40}, 0.92}, {std::size_t{100}, 0.92}}) {
    const auto resampling = one_world(n, 2000);
    rows.push_back(row("mean, unbounded", "lognormal", n, target, [n = n, resampling](Stream& random) {
      const auto values = drawn(n, [&] { return std::exp(random.normal()); });
      return covers(core::mean_of_tasks(values, {}, resampling).interval, std::exp(0.5));
    }));
    rows.push_back(row("difference, unbounded", "equal entries' times", n, target, [n = n, resampling](Stream& random) {
      const auto differences = pair_differences(drawn_times(random, 2, n));
      return covers(core::difference_of_tasks(differences, {}, resampling).interval, 0.0);
    }));
    rows.push_back(row("mean, never negative", "counts, 89 % zeros", n, 0.93, [n = n, resampling](Stream& random) {
      const auto values = drawn(n, [&] { return random.chance(0.11) ? (random.chance(0.5) ? 1.0 : 2.0) : 0.0; });
      const core::MeanOfTasks found = core::mean_of_tasks(values, {}, resampling);
      // where none had any, the rule of three speaks of the share that has
      if (found.mean == 0.0) return Outcome{core::rule_of_three(found.n) >= 0.11};
      return covers(found.interval, 0.11 * 1.5);
    }));
    rows.push_back(row("Hodges-Lehmann", "equal entries' times", n, 0.93, [n = n](Stream& random) {
      const Values times = drawn_times(random, 2, n);
      std::vector<double> differences(n);
      for (std::size_t i = 0; i < n; ++i) differences[i] = times[1][i] - times[0][i];
      return covers(core::hodges_lehmann(differences).interval, 0.0);
    }));
    rows.push_back(
        row("restricted mean", "exponential of mean 40 s, until 60 s", n, 0.93, [n = n, resampling](Stream& random) {
          const auto times = drawn(n, [&] { return std::fmin(60.0, -40.0 * std::log(1.0 - random.uniform())); });
          return covers(core::mean_of_tasks(times, core::Interval{0.0, 60.0}, resampling).interval,
                        40.0 * (1.0 - std::exp(-1.5)));
        }));
  }
}

}  // namespace

std::vector<Row> interval_rows() {
  std::vector<Row> rows;
  add_shares(rows);
  add_unbounded(rows);
  return rows;
}

}  // namespace dmrp::bench
