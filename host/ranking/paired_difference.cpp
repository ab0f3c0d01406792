// SPDX-License-Identifier: MIT
#include "host/ranking/paired_difference.hpp"

#include <algorithm>
#include <cmath>

#include "core/statistics/holm.hpp"
#include "core/statistics/signed_rank.hpp"

namespace dmrp::host {

PairedDifference paired_difference(std::span<const double> by_task, PairedTest test, const core::Bounds& bounds,
                                   const core::Resampling& resampling) {
  constexpr double rounding = 1e-9;
  std::vector<double> defined;
  for (const double one : by_task)
    if (!std::isnan(one)) defined.push_back(one);
  PairedDifference result;
  result.over_tasks = core::difference_of_tasks(by_task, bounds, resampling);
  result.equal = std::all_of(defined.begin(), defined.end(), [](double one) { return std::fabs(one) < rounding; });
  if (defined.size() < fewest_observations || result.equal) return result;
  result.p = test == PairedTest::mean ? result.over_tasks.p : core::signed_rank_test(defined).p;
  return result;
}

void adjust_by_holm(std::span<PairedDifference* const> family) {
  std::vector<double> p_values;
  for (const PairedDifference* one : family) p_values.push_back(one->p);
  const std::vector<double> adjusted = core::holm_adjusted(p_values);
  for (std::size_t i = 0; i < adjusted.size(); ++i) family[i]->p_holm = adjusted[i];
}

}  // namespace dmrp::host
