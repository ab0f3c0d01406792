// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/statistics/best_set.hpp"
#include "core/statistics/level_effects.hpp"
#include "core/statistics/mean_of_tasks.hpp"
#include "core/statistics/rank_correlation.hpp"
#include "core/statistics/signed_rank.hpp"
#include "tests/bench/calibration/rows.hpp"
#include "tests/bench/calibration/truths.hpp"

namespace dmrp::bench {
namespace {

using toolkit::Stream;

constexpr double most_false = 0.06;

Row level(const std::string& procedure, const std::string& truth, std::size_t n,
          std::function<Outcome(Stream&)> benchmark) {
  return {procedure, truth, n, Measure::false_positives, most_false, std::move(benchmark)};
}

core::Resampling one_world(std::size_t tasks, std::uint32_t resamples) {
  return {std::vector<std::uint32_t>(tasks, 0), core::Scope::these_worlds, resamples};
}

std::vector<double> differences_of_first_two(const Values& values) {
  return core::differences_of(values)(0, 1);
}

void add_paired_tests(std::vector<Row>& rows, std::size_t n) {
  rows.push_back(level("signed rank", "equal entries' times", n, [n](Stream& random) {
    return Outcome{core::signed_rank_test(differences_of_first_two(drawn_times(random, 2, n))).p < core::significance};
  }));
  rows.push_back(level("mean, shares", "equal entries' shares", n, [n](Stream& random) {
    const std::vector<double> differences = differences_of_first_two(drawn_shares(random, 2, n));
    return Outcome{core::difference_of_tasks(differences, core::share_bounds, one_world(n, 0)).p < core::significance};
  }));
  rows.push_back(level("mean, times", "equal entries' times", n, [n](Stream& random) {
    const std::vector<double> differences = differences_of_first_two(drawn_times(random, 2, n));
    return Outcome{core::difference_of_tasks(differences, {}, one_world(n, 2000)).p < core::significance};
  }));
  rows.push_back(level("mean's interval without 0", "+.05 (90 %), -.45 (10 %)", n, [n](Stream& random) {
    std::vector<double> differences(n);
    for (double& value : differences) value = random.chance(0.1) ? -0.45 : 0.05;
    const core::Interval interval =
        core::difference_of_tasks(differences, core::share_bounds, one_world(n, 0)).interval;
    return Outcome{interval.low > 0.0 || interval.high < 0.0};
  }));
}

// Differences that are worse by the margin, or by what the rule of three allows where that is more.
void add_non_inferiority(std::vector<Row>& rows, std::size_t n) {
  const auto shares = [n](const std::vector<double>& differences) {
    const core::Criterion criterion{{}, true, core::PairedScore::mean, 0.05, core::share_bounds};
    return Outcome{core::non_inferior(differences, criterion, one_world(n, 0))};
  };
  rows.push_back(level("not inferior", "a loss of all in 1 of 20 tasks", n, [n, shares](Stream& random) {
    const double rarely = std::fmax(0.05, core::rule_of_three(static_cast<std::uint32_t>(n)));
    std::vector<double> differences(n);
    for (double& value : differences) value = random.chance(rarely) ? -1.0 : 0.0;
    return shares(differences);
  }));
  rows.push_back(level("not inferior", "a loss of half in 1 of 10 tasks", n, [n, shares](Stream& random) {
    const double rarely = std::fmax(0.1, core::rule_of_three(static_cast<std::uint32_t>(n)));
    std::vector<double> differences(n);
    for (double& value : differences) value = random.chance(rarely) ? -0.5 : 0.0;
    return shares(differences);
  }));
  rows.push_back(level("not inferior", "people lose half a second more", n, [n](Stream& random) {
    Values delays = drawn_delays(random, 2, n);
    for (double& delay : delays[1]) delay += 0.5;
    const core::Criterion criterion{{}, false, core::PairedScore::ranks, 0.5, {}};
    return Outcome{core::non_inferior(differences_of_first_two(delays), criterion, one_world(n, 0))};
  }));
}

// How often equal entries are called as safe: at least in half of the benchmarks.
Row as_safe(double arrives, const std::string& words) {
  constexpr std::size_t tasks = 60;
  constexpr int robots = 8;
  return {"as safe", words, tasks, Measure::power, 0.5, [arrives](Stream& random) {
            std::vector<double> differences(tasks, 0.0);
            for (double& value : differences)
              for (int robot = 0; robot < robots; ++robot)
                value += ((random.chance(arrives) ? 1.0 : 0.0) - (random.chance(arrives) ? 1.0 : 0.0)) / robots;
            const core::Criterion criterion{{}, true, core::PairedScore::mean, 0.05, core::share_bounds};
            return Outcome{core::non_inferior(differences, criterion, one_world(tasks, 0)), true};
          }};
}

// Levels that are alike.
void add_level_effects(std::vector<Row>& rows, std::size_t n) {
  for (const std::size_t levels : {2u, 4u})
    rows.push_back(level("main effect", fmt::format("{} equal levels' shares", levels), n, [=](Stream& random) {
      const auto effects = core::level_effects(drawn_shares(random, levels, n));
      return Outcome{std::any_of(effects.begin(), effects.end(),
                                 [](const core::LevelEffect& one) { return one.p <= core::significance; })};
    }));
}

void add_correlations(std::vector<Row>& rows, std::size_t n) {
  for (const double agreement : {0.6, 0.9})
    rows.push_back(level(
        "rank correlation",
        agreement < 0.7 ? "4 entries, .6 of the variance is the task's" : "4 entries, .9 of the variance is the task's",
        n, [n, agreement](Stream& random) {
          const Values x = drawn_normals(random, 4, n, agreement);
          const Values y = drawn_normals(random, 4, n, agreement);
          return Outcome{core::task_rank_correlation(x, y, one_world(n, 0)).p < core::significance};
        }));
}

}  // namespace

std::vector<Row> test_rows() {
  std::vector<Row> rows;
  for (const std::size_t n : {std::size_t{10}, std::size_t{40}}) add_paired_tests(rows, n);
  for (const std::size_t n : {std::size_t{10}, std::size_t{40}, std::size_t{100}}) add_non_inferiority(rows, n);
  rows.push_back(as_safe(0.9, "2 equal entries, 8 robots, .9 arrive"));
  rows.push_back(as_safe(0.95, "2 equal entries, 8 robots, .95 arrive"));
  for (const std::size_t n : {std::size_t{10}, std::size_t{20}, std::size_t{40}}) add_level_effects(rows, n);
  for (const std::size_t n : {std::size_t{6}, std::size_t{20}}) add_correlations(rows, n);
  return rows;
}

}  // namespace dmrp::bench
