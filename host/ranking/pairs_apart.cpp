// SPDX-License-Identifier: MIT
#include "host/ranking/pairs_apart.hpp"

#include <algorithm>
#include <cmath>

#include "core/statistics/descriptive.hpp"
#include "core/statistics/holm.hpp"
#include "host/ranking/paired_test.hpp"

namespace dmrp::host {
namespace {

// The test of one pair of entries by one criterion.
struct PairTest {
  double p = core::undefined;  // NaN: nothing differs
  bool is_large = false;
};

PairTest test_pair(const std::vector<double>& differences, bool share, double least) {
  PairTest test;
  if (differences.size() < 2) return test;
  test.is_large = std::abs(core::mean(differences)) > least;
  if (std::all_of(differences.begin(), differences.end(), [](double one) { return std::abs(one) < rounding; }))
    return test;
  test.p = paired_test(differences, share ? PairedTest::sign_flip : PairedTest::signed_rank).p;
  return test;
}

double mean_of(const Contest& contest, const Measures& measures, std::size_t contestant, std::size_t criterion) {
  std::vector<std::size_t> trials;
  for (const auto& of_situation : contest.trials[contestant])
    trials.insert(trials.end(), of_situation.begin(), of_situation.end());
  return measures.mean(trials, measures.criteria()[criterion]);
}

}  // namespace

PairsApart pairs_apart(const Contest& contest, const Measures& measures) {
  std::vector<std::size_t> criteria = {0};
  if (!measures.criteria().back().share) criteria.push_back(measures.criteria().size() - 1);
  PairsApart found;
  std::vector<PairTest> tests;
  for (std::size_t a = 0; a < contest.contestants.size(); ++a)
    for (std::size_t b = a + 1; b < contest.contestants.size(); ++b, ++found.pairs)
      for (const std::size_t i : criteria) {
        const bool share = measures.criteria()[i].share;
        const double least =
            share ? least_share_difference
                  : least_time_ratio * std::fmax(mean_of(contest, measures, a, i), mean_of(contest, measures, b, i));
        tests.push_back(test_pair(paired_differences(contest, a, b, measures.difference(i)), share, least));
      }
  std::vector<double> p_values;
  for (const PairTest& test : tests) p_values.push_back(test.p);
  const std::vector<double> adjusted = core::holm_adjusted(p_values);
  for (std::size_t pair = 0; pair < found.pairs; ++pair) {
    bool apart = false;
    for (std::size_t i = pair * criteria.size(); i < (pair + 1) * criteria.size(); ++i)
      apart = apart || (tests[i].is_large && adjusted[i] < significant);
    found.apart += apart ? 1 : 0;
  }
  return found;
}

}  // namespace dmrp::host
