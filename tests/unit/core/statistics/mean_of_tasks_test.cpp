// SPDX-License-Identifier: MIT
#include "core/statistics/mean_of_tasks.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <limits>
#include <vector>

#include "core/statistics/betting.hpp"

namespace mean_of_tasks_test {

using namespace dmrp::core;

Resampling one_world(std::size_t tasks) {
  return {std::vector<std::uint32_t>(tasks, 0), Scope::these_worlds};
}

std::vector<double> ones_of(std::size_t ones, std::size_t n) {
  std::vector<double> values(n, 0.0);
  std::fill_n(values.begin(), ones, 1.0);
  return values;
}

// The probability of k of n at probability p.
double binomial(std::size_t n, std::size_t k, double p) {
  const auto real = [](std::size_t x) { return static_cast<double>(x); };
  return std::exp(std::lgamma(real(n) + 1.0) - std::lgamma(real(k) + 1.0) - std::lgamma(real(n - k) + 1.0) +
                  real(k) * std::log(p) + real(n - k) * std::log1p(-p));
}

TEST_CASE("the betting interval covers every share with 95 %: all outcomes counted", "[statistics]") {
  for (const std::size_t n : {1u, 3u, 10u, 25u, 60u}) {
    std::vector<Interval> intervals;
    for (std::size_t ones = 0; ones <= n; ++ones) intervals.push_back(betting_interval(ones_of(ones, n)));
    for (double p = 0.005; p < 1.0; p += 0.005) {
      double covered = 0.0;
      for (std::size_t ones = 0; ones <= n; ++ones)
        if (intervals[ones].low <= p && p <= intervals[ones].high) covered += binomial(n, ones, p);
      INFO("n " << n << ", p " << p);
      CHECK(covered >= 0.95);
    }
  }
}

TEST_CASE("the betting interval", "[statistics]") {
  SECTION("is mirrored with the values, and does not depend on their order") {
    const std::vector<double> values{0.1, 0.9, 0.4, 1.0, 0.75, 0.3};
    const std::vector<double> turned{0.7, 0.25, 0.0, 0.6, 0.1, 0.9};
    CHECK(betting_interval(turned).low == Approx(1.0 - betting_interval(values).high).epsilon(1e-9));
    CHECK(betting_interval(turned).high == Approx(1.0 - betting_interval(values).low).epsilon(1e-9));
  }
  SECTION("is at most a tenth wider than the exact one where all succeeded") {
    for (const std::size_t n : {5u, 10u, 20u, 40u}) {
      const double exact = std::pow(0.025, 1.0 / static_cast<double>(n));  // Clopper, Pearson
      const double low = betting_interval(ones_of(n, n)).low;
      CHECK(low <= exact);
      CHECK(1.0 - low <= 1.1 * (1.0 - exact));
    }
  }
  SECTION("shrinks with the values' variance and their number") {
    const auto width = [](double spread, std::size_t n) {
      std::vector<double> values;
      for (std::size_t i = 0; i < n; ++i) values.push_back(0.5 + (i % 2 == 0 ? spread : -spread));
      return betting_interval(values).high - betting_interval(values).low;
    };
    CHECK(width(0.1, 100) < 0.6 * width(0.5, 100));
    CHECK(width(0.3, 400) < 0.6 * width(0.3, 100));
  }
  SECTION("of nothing is undefined") {
    CHECK(std::isnan(betting_interval({}).low));
  }
}

TEST_CASE("the mean of tasks", "[statistics]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  SECTION("of bounded values has an interval within the bounds, from one task on") {
    const MeanOfTasks one = mean_of_tasks(std::vector<double>{1.0}, share_bounds, one_world(1));
    CHECK(one.n == 1);
    CHECK(one.interval.low > 0.0);
    CHECK(one.interval.high == 1.0);
    const MeanOfTasks ratio = mean_of_tasks(std::vector<double>{2.0, 4.0, nan}, Interval{0.0, 10.0}, one_world(3));
    CHECK(ratio.n == 2);
    CHECK(ratio.mean == 3.0);
    CHECK(ratio.interval.high < 10.0);
  }
  SECTION("of unbounded values has one from ten tasks on") {
    std::vector<double> values{1, 2, 3, 4, 5, 6, 7, 8, 9};
    CHECK(std::isnan(mean_of_tasks(values, {}, one_world(9)).interval.low));
    values.push_back(10);
    const MeanOfTasks ten = mean_of_tasks(values, {}, one_world(10));
    // Student's: 5.5 and 2.2622 standard errors of 0.9574
    CHECK(ten.interval.low <= Approx(5.5 - 2.2622 * 0.9574).epsilon(1e-4));
    CHECK(ten.interval.high >= Approx(5.5 + 2.2622 * 0.9574).epsilon(1e-4));
    CHECK(ten.interval.high < 5.5 + 3.5 * 0.9574);
    CHECK(std::isnan(mean_of_tasks(std::vector<double>(10, 3.0), {}, one_world(10)).interval.low));  // no spread
  }
  SECTION("of skewed values reaches farther where the tail is") {
    std::vector<double> values;
    for (int i = 0; i < 20; ++i) values.push_back(std::exp(0.2 * i));
    const MeanOfTasks found = mean_of_tasks(values, {}, one_world(20));
    CHECK(found.interval.high - found.mean > 1.2 * (found.mean - found.interval.low));
  }
  SECTION("counts worlds in general") {
    const std::vector<double> values{1.0, 1.0, 1.0, 0.0, 0.5, 0.0};
    const std::vector<std::uint32_t> worlds{0, 0, 0, 0, 1, 2};
    const MeanOfTasks general = mean_of_tasks(values, share_bounds, Resampling(worlds, Scope::in_general));
    CHECK(general.n == 3);
    CHECK(general.mean == Approx((0.75 + 0.5 + 0.0) / 3.0));
    CHECK(mean_of_tasks(values, share_bounds, Resampling(worlds, Scope::these_worlds)).n == 6);
  }
}

TEST_CASE("the difference of tasks", "[statistics]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> differences{0.25, 0.25, nan, -0.5};
  const MeanOfTasks found = difference_of_tasks(differences, share_bounds, one_world(4));
  CHECK(found.n == 3);
  CHECK(found.mean == Approx(0.0).margin(1e-12));
  // Student's of .25, .25, -.5, 1, -1: 2.7764 standard errors of sqrt(2.375 / 4 / 5)
  CHECK(found.interval.high == Approx(2.7764 * std::sqrt(2.375 / 20.0)).epsilon(1e-4));
  CHECK(found.interval.low == Approx(-found.interval.high));

  SECTION("that are the largest there can be stays within its bounds") {
    const MeanOfTasks all = difference_of_tasks(std::vector<double>(3, 1.0), share_bounds, one_world(3));
    CHECK(all.mean == 1.0);
    CHECK(all.interval.high == 1.0);
    CHECK(all.interval.low < 0.0);
  }
}

TEST_CASE("the p value of a mean is of its interval's procedure", "[statistics]") {
  // Fisher, The Design of Experiments, section 17: Darwin's maize, t = 2.148 with 14 degrees of freedom, p = 0.0497
  CHECK(student_two_sided(15, 2.148) == Approx(0.0497).margin(1e-4));
  CHECK(student_two_sided(15, -2.148) == student_two_sided(15, 2.148));
  int significant = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    dmrp::toolkit::Stream random(seed, "test");
    const double shift = 0.5 * random.uniform();
    std::vector<double> values(10 + seed % 7);
    for (double& value : values) value = std::clamp(shift + 0.5 * random.normal(), -1.0, 1.0);
    for (const Bounds& bounds : {Bounds(share_bounds), Bounds()}) {
      const MeanOfTasks found = difference_of_tasks(values, bounds, one_world(values.size()));
      INFO("seed " << seed << ", p " << found.p << " [" << found.interval.low << ", " << found.interval.high << "]");
      // counts of resamples and their quantiles differ by less
      if (std::fabs(found.p - 0.05) > 0.002)
        CHECK((found.p < 0.05) == (found.interval.low > 0.0 || found.interval.high < 0.0));
      significant += found.p < 0.05 ? 1 : 0;
    }
  }
  CHECK((significant > 100 && significant < 500));
}

TEST_CASE("the rule of three", "[statistics]") {
  CHECK(rule_of_three(20) == Approx(0.1391).margin(5e-5));
  CHECK(rule_of_three(100) == Approx(0.03).margin(6e-4));
  CHECK(rule_of_three(0) == 1.0);
}

TEST_CASE("one resampling of tasks", "[statistics]") {
  std::vector<std::uint32_t> worlds;
  for (std::uint32_t i = 0; i < 12; ++i) worlds.push_back(i < 5 ? 0 : 1);
  const auto total = [](const Resampling& resampling, std::size_t resample, std::size_t first, std::size_t last) {
    std::uint32_t sum = 0;
    for (std::size_t i = first; i < last; ++i) sum += resampling.counts(resample)[i];
    return sum;
  };
  SECTION("draws tasks within their worlds") {
    const Resampling within(worlds, Scope::these_worlds, 50);
    for (std::size_t i = 0; i < 50; ++i) {
      CHECK(total(within, i, 0, 5) == 5);
      CHECK(total(within, i, 5, 12) == 7);
    }
  }
  SECTION("draws them from all where a world has fewer than five") {
    worlds.push_back(2);
    const Resampling together(worlds, Scope::these_worlds, 50);
    bool crosses = false;
    for (std::size_t i = 0; i < 50; ++i) {
      CHECK(total(together, i, 0, 13) == 13);
      crosses = crosses || total(together, i, 0, 5) != 5;
    }
    CHECK(crosses);
  }
  SECTION("draws worlds in general") {
    const Resampling general(worlds, Scope::in_general, 50);
    CHECK(general.observations() == 2);
    CHECK(total(general, 7, 0, 2) == 2);
    CHECK(general.observation_of_task(4) == 0);
    CHECK(general.observation_of_task(5) == 1);
  }
  SECTION("is the same to the bit, and changes with the seed") {
    const Resampling first(worlds, Scope::these_worlds, 50);
    const Resampling again(worlds, Scope::these_worlds, 50);
    const Resampling other(worlds, Scope::these_worlds, 50, 2);
    const auto same = [](const Resampling& a, const Resampling& b) {
      for (std::size_t i = 0; i < 50; ++i)
        if (!std::equal(a.counts(i).begin(), a.counts(i).end(), b.counts(i).begin())) return false;
      return true;
    };
    CHECK(same(first, again));
    CHECK_FALSE(same(first, other));
  }
}

}  // namespace mean_of_tasks_test
