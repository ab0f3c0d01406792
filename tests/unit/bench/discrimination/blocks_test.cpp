// SPDX-License-Identifier: MIT
// Entries that met the same tasks: shares of variance, and the agreement of two orders.
#include "tests/bench/discrimination/blocks.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>

namespace blocks_test {

using namespace dmrp::bench;

TEST_CASE("partial eta squared takes the differences between tasks out") {
  // by hand: the entries' means are 2 and 4, the tasks' 2, 3 and 4; of entries: 3 * (1 + 1) = 6
  const std::vector<std::vector<double>> values = {{1, 3, 2}, {3, 3, 6}};
  const BlockEffect effect = block_effect(values);
  // rests of the first entry: 1-2-2+3 = 0, 3-2-3+3 = 1, 2-2-4+3 = -1; so is the second's, negative: 4 in all
  CHECK(effect.partial_eta_squared == Approx(0.6));
  CHECK(effect.df_entries == 1.0);
  CHECK(effect.df_rest == 2.0);
  CHECK(effect.f == Approx(3.0));
  // tasks that are harder for all change nothing
  const std::vector<std::vector<double>> shifted = {{1, 103, 52}, {3, 103, 56}};
  CHECK(block_effect(shifted).partial_eta_squared == Approx(0.6));
  CHECK(std::isnan(block_effect(std::vector<std::vector<double>>{{1, 1}, {1, 1}}).partial_eta_squared));
  CHECK(std::isnan(block_effect(std::vector<std::vector<double>>{{1, 2}}).partial_eta_squared));
}

TEST_CASE("the interaction of two factors is what their sums do not explain") {
  // by hand, two tasks: cell means 1, 2 | 2, 5, so that rows have 1.5 and 3.5, columns 1.5 and 3.5, all 2.5: each cell is
  // 0.5 off their sum, 2 * 4 * 0.25 = 2; the second task is 2 harder throughout, but 2 more in the last cell:
  // rests are 0.25 in three cells and 0.75 in the last, each twice: 2 * (3 * 0.0625 + 0.5625) = 1.5
  const std::vector<std::vector<std::vector<double>>> table = {{{0, 2}, {1, 3}}, {{1, 3}, {3, 7}}};
  const BlockEffect effect = interaction_effect(table);
  CHECK(effect.df_entries == 1.0);
  CHECK(effect.df_rest == 3.0);
  CHECK(effect.partial_eta_squared == Approx(2.0 / 3.5));
  CHECK(effect.f == Approx(2.0 / (1.5 / 3.0)));
  // what the factors add up to is no interaction
  const std::vector<std::vector<std::vector<double>>> sums = {{{0, 2}, {1, 2}}, {{5, 7}, {6, 7}}};
  CHECK(interaction_effect(sums).partial_eta_squared == Approx(0.0).margin(1e-12));
  CHECK(std::isnan(interaction_effect(std::vector<std::vector<std::vector<double>>>{{{1, 2}, {2, 1}}}).f));
}

TEST_CASE("the interval of the noncentrality inverts the distribution of F, here simulated") {
  // F with 2 and 40 degrees of freedom
  constexpr double f = 5.0;
  const dmrp::core::Interval interval = noncentrality_interval(f, 2.0, 40.0);
  CHECK(interval.low > 0.0);
  CHECK(interval.high > interval.low);
  const auto share_below = [&](double noncentrality) {
    dmrp::toolkit::Stream stream(5, "test.noncentral");
    int below = 0;
    constexpr int draws = 20000;
    for (int i = 0; i < draws; ++i) {
      const double first = stream.normal() + std::sqrt(noncentrality);
      const double second = stream.normal();
      double rest = 0.0;
      for (int k = 0; k < 40; ++k) {
        const double one = stream.normal();
        rest += one * one;
      }
      below += ((first * first + second * second) / 2.0) / (rest / 40.0) < f;
    }
    return static_cast<double>(below) / draws;
  };
  CHECK(share_below(interval.low) == Approx(0.975).margin(0.005));
  CHECK(share_below(interval.high) == Approx(0.025).margin(0.005));
  CHECK(noncentrality_interval(0.5, 2.0, 40.0).low == 0.0);
}

TEST_CASE("Kendall's tau counts the pairs in the same order") {
  const std::vector<double> x = {1, 2, 3, 4};
  CHECK(kendall_tau(x, std::vector<double>{10, 20, 30, 40}) == 1.0);
  CHECK(kendall_tau(x, std::vector<double>{4, 3, 2, 1}) == -1.0);
  CHECK(kendall_tau(x, std::vector<double>{1, 2, 4, 3}) == Approx(4.0 / 6.0));
  // one tie: 5 pairs of 6 are untied, all agree
  CHECK(kendall_tau(x, std::vector<double>{1, 2, 3, 3}) == Approx(5.0 / std::sqrt(30.0)));
  CHECK(std::isnan(kendall_tau(x, std::vector<double>{1, 1, 1, 1})));
}

}  // namespace blocks_test
