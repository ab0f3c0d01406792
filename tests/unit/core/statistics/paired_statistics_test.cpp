// SPDX-License-Identifier: MIT
// Against published examples and against brute force: every way to give the differences signs.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <dmrp/toolkit/random.hpp>
#include <limits>
#include <vector>

#include "core/statistics/holm.hpp"
#include "core/statistics/signed_rank.hpp"

namespace paired_statistics_test {

using namespace dmrp::core;

// Hollander, Wolfe: Nonparametric Statistical Methods, table 3.1: depression scale factors of nine patients before and
// after a tranquilizer.
std::vector<double> hollander_wolfe_depression() {
  const std::vector<double> before{1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30};
  const std::vector<double> after{0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29};
  std::vector<double> differences;
  for (std::size_t i = 0; i < before.size(); ++i) differences.push_back(before[i] - after[i]);
  return differences;
}

// Darwin's maize: crossed less self-fertilised plants of fifteen pairs, in eighths of an inch.
const std::vector<double>& darwin_maize() {
  static const std::vector<double> differences{49, -67, 8, 16, 6, 23, 28, 41, 14, 29, 56, 24, 75, 60, -48};
  return differences;
}

// The share of all signs for which |statistic| is at least the observed one.
template <class Statistic>
double brute_force_p(std::vector<double> differences, Statistic statistic) {
  const double observed = std::abs(statistic(differences));
  const std::vector<double> given = differences;
  const std::uint64_t ways = std::uint64_t{1} << given.size();
  std::uint64_t as_far = 0;
  for (std::uint64_t signs = 0; signs < ways; ++signs) {
    for (std::size_t i = 0; i < given.size(); ++i) differences[i] = (signs >> i & 1) != 0 ? -given[i] : given[i];
    if (std::abs(statistic(differences)) >= observed - 1e-9) ++as_far;
  }
  return static_cast<double>(as_far) / static_cast<double>(ways);
}

// T+ - T-, ranks by counting: slow and plain. Zeros are ranked and have no sign.
double signed_rank_sum(const std::vector<double>& differences) {
  double sum = 0.0;
  for (const double difference : differences) {
    double below = 0.0;
    double same = 0.0;
    for (const double other : differences) {
      if (std::abs(other) < std::abs(difference)) ++below;
      if (std::abs(other) == std::abs(difference)) ++same;
    }
    const double rank = below + 0.5 * (same + 1.0);
    sum += difference > 0.0 ? rank : difference < 0.0 ? -rank : 0.0;
  }
  return sum;
}

// Few distinct values: ties and zeros abound.
std::vector<double> drawn_differences(std::uint64_t seed, std::size_t count, double spread) {
  dmrp::toolkit::Stream random(seed, "paired_statistics_test");
  std::vector<double> differences;
  for (std::size_t i = 0; i < count; ++i) differences.push_back(std::round(random.uniform(-spread, spread + 1.0)));
  return differences;
}

TEST_CASE("Wilcoxon's signed-rank test agrees with its textbook examples", "[statistics]") {
  SECTION("Hollander and Wolfe, example 3.1: T+ = 5 of the improvement, P = 0.0195 one-sided") {
    const SignedRankTest test = signed_rank_test(hollander_wolfe_depression());
    CHECK(test.pairs == 9);
    CHECK(test.zeros == 0);
    CHECK(test.positive_rank_sum == 40.0);
    CHECK(test.exact);
    CHECK(test.p == Approx(2.0 * 10.0 / 512.0).epsilon(1e-12));
    CHECK(test.rank_biserial == Approx((40.0 - 5.0) / 45.0).epsilon(1e-12));
  }
  SECTION("Cureton 1967, Darwin's maize: 24 against 96, P = 0.0413") {
    const SignedRankTest test = signed_rank_test(darwin_maize());
    CHECK(test.positive_rank_sum == 96.0);
    CHECK(test.p == Approx(0.041259765625).epsilon(1e-12));
  }
  SECTION("King, Rosopa and Minium, Statistical Reasoning in the Behavioral Sciences: an effect of 0.76, with ties") {
    const std::vector<double> placebo_less_drug{-4, 10, -5, 7, -3, 17, 14, 5, 15, 10};
    const SignedRankTest test = signed_rank_test(placebo_less_drug);
    CHECK(test.positive_rank_sum == 48.5);
    CHECK(test.rank_biserial == Approx(42.0 / 55.0).epsilon(1e-12));
  }
}

TEST_CASE("the signed-rank test is exact with ties and zeros", "[statistics]") {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const std::vector<double> differences = drawn_differences(seed, 1 + seed % 11, 3.0);
    INFO("seed " << seed);
    CHECK(signed_rank_test(differences).p == Approx(brute_force_p(differences, signed_rank_sum)).epsilon(1e-9));
  }
}

TEST_CASE("the signed-rank test at its edges", "[statistics]") {
  CHECK(std::isnan(signed_rank_test({}).p));
  SECTION("all zero: p is 1") {
    const SignedRankTest test = signed_rank_test(std::vector<double>{0, 0, 0});
    CHECK(test.p == 1.0);
    CHECK(test.rank_biserial == 0.0);
    CHECK(test.zeros == 3);
  }
  SECTION("zeros keep their ranks: two differences among eighteen zeros are a small effect") {
    std::vector<double> differences(18, 0.0);
    differences.insert(differences.end(), {1.0, 1.0});
    const SignedRankTest test = signed_rank_test(differences);
    CHECK(test.p == 0.5);
    CHECK(test.rank_biserial == Approx(39.0 / 210.0));
  }
  SECTION("differences that differ by rounding are tied") {
    // 0.3 - 0.2 and 0.4 - 0.3 differ in their last bits
    const SignedRankTest test = signed_rank_test(std::vector<double>{0.3 - 0.2, 0.3 - 0.4, 0.5 - 0.3});
    CHECK(test.positive_rank_sum == 4.5);
  }
  SECTION("many differences use the normal distribution") {
    std::vector<double> differences;
    for (int i = 1; i <= 120; ++i) differences.push_back(i % 3 == 0 ? -i : i);
    const SignedRankTest test = signed_rank_test(differences);
    CHECK_FALSE(test.exact);
    // T- is 3 + 6 + ... + 120 = 2460 of 7260; the variance n (n + 1) (2 n + 1) / 24
    CHECK(test.positive_rank_sum == 4800.0);
    const double z = (4800.0 - 3630.0 - 0.5) / std::sqrt(120.0 * 121.0 * 241.0 / 24.0);
    CHECK(test.p == Approx(std::erfc(z / std::sqrt(2.0))).epsilon(1e-9));
  }
  SECTION("the exact and the normal result agree at the limit") {
    std::vector<double> differences;
    for (int i = 1; i <= 100; ++i) differences.push_back(i % 3 == 0 ? -i : i);
    // T- is 3 + 6 + ... + 99 = 1683 of 5050
    const double z = (3367.0 - 2525.0 - 0.5) / std::sqrt(100.0 * 101.0 * 201.0 / 24.0);
    const SignedRankTest test = signed_rank_test(differences);
    CHECK(test.exact);
    CHECK(test.p == Approx(std::erfc(z / std::sqrt(2.0))).epsilon(0.1));
    differences.push_back(1e-12);  // a zero but for rounding
    CHECK(signed_rank_test(differences).exact);
  }
}

TEST_CASE("the Hodges-Lehmann estimate and its interval", "[statistics]") {
  SECTION("Hollander and Wolfe, examples 3.3 and 3.4: 0.46, from 0.010 to 0.786 at 96.1 %") {
    const HodgesLehmann shift = hodges_lehmann(hollander_wolfe_depression());
    CHECK(shift.estimate == Approx(0.46).epsilon(1e-9));
    CHECK(shift.interval.low == Approx(0.010).epsilon(1e-9));
    CHECK(shift.interval.high == Approx(0.786).epsilon(1e-9));
  }
  SECTION("no interval of 95 % below six differences: 2 / 32 is more than 5 %") {
    const HodgesLehmann five = hodges_lehmann(std::vector<double>{1, 2, 3, 4, 5});
    CHECK(five.estimate == 3.0);
    CHECK(std::isnan(five.interval.low));
    const HodgesLehmann six = hodges_lehmann(std::vector<double>{1, 2, 3, 4, 5, 6});
    CHECK(six.interval.low == 1.0);
    CHECK(six.interval.high == 6.0);
  }
  SECTION("the interval contains exactly the shifts that the test does not reject") {
    const std::vector<double>& differences = darwin_maize();
    const HodgesLehmann shift = hodges_lehmann(differences);
    const auto p_of = [&](double by) {
      std::vector<double> shifted;
      for (const double difference : differences) shifted.push_back(difference - by);
      return signed_rank_test(shifted).p;
    };
    CHECK(p_of(shift.interval.low - 0.01) <= 0.05);
    CHECK(p_of(shift.interval.low + 0.01) > 0.05);
    CHECK(p_of(shift.interval.high - 0.01) > 0.05);
    CHECK(p_of(shift.interval.high + 0.01) <= 0.05);
  }
  SECTION("of many") {
    std::vector<double> differences;
    for (int i = 0; i < 150; ++i) differences.push_back(i);
    const HodgesLehmann shift = hodges_lehmann(differences);
    CHECK(shift.estimate == 74.5);
    CHECK(shift.interval.low + shift.interval.high == Approx(149.0));
    CHECK(shift.interval.low == Approx(74.5 - 1.96 * 150.0 / std::sqrt(12.0 * 150.0)).margin(0.6));
  }
  CHECK(std::isnan(hodges_lehmann({}).estimate));
}

TEST_CASE("Holm's correction", "[statistics]") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  SECTION("the textbook example: 0.01, 0.04, 0.03 and 0.005 at 5 % keep the first and the last") {
    const std::vector<double> adjusted = holm_adjusted(std::vector<double>{0.01, 0.04, 0.03, 0.005});
    CHECK(adjusted[0] == Approx(0.03));
    CHECK(adjusted[1] == Approx(0.06));  // 0.04 itself, but never below the one before
    CHECK(adjusted[2] == Approx(0.06));
    CHECK(adjusted[3] == Approx(0.02));
  }
  SECTION("one test stays as it is, none above 1") {
    CHECK(holm_adjusted(std::vector<double>{0.3})[0] == 0.3);
    CHECK(holm_adjusted(std::vector<double>{0.7, 0.8}) == std::vector<double>{1.0, 1.0});
  }
  SECTION("an undefined p value does not count as a test") {
    const std::vector<double> adjusted = holm_adjusted(std::vector<double>{nan, 0.02, 0.5});
    CHECK(std::isnan(adjusted[0]));
    CHECK(adjusted[1] == 0.04);
    CHECK(adjusted[2] == 0.5);
  }
  CHECK(holm_adjusted({}).empty());
}

}  // namespace paired_statistics_test
