// SPDX-License-Identifier: MIT
#include "tests/bench/calibration/examples.hpp"

#include <algorithm>
#include <cstdint>

#include "core/statistics/betting.hpp"
#include "core/statistics/descriptive.hpp"
#include "core/statistics/mean_of_tasks.hpp"
#include "core/statistics/rank_correlation.hpp"
#include "core/statistics/signed_rank.hpp"

namespace dmrp::bench {

std::vector<std::pair<std::string, double>> examples() {
  const std::vector<double> differences{1.5, -0.4, 2.25, 0.75, -1.0, 3.0, 0.1, 1.25, -0.2, 2.0, 0.6, -1.75};
  const std::vector<double> y{3, 1, 4, 1, 5, 9, 2, 6, 5, 3, 5, 8};
  std::vector<double> nine_of_twelve(12, 1.0);
  std::fill_n(nine_of_twelve.begin(), 3, 0.0);
  const core::Resampling resampling(std::vector<std::uint32_t>(12), core::Scope::these_worlds, 0);
  const core::HodgesLehmann shift = core::hodges_lehmann(differences);
  const core::Interval share = core::betting_interval(nine_of_twelve);
  const std::vector<std::vector<double>> of_x{differences};  // one entry
  const std::vector<std::vector<double>> of_y{y};
  const core::RankCorrelation correlation = core::task_rank_correlation(of_x, of_y, resampling);
  return {{"signed_rank_p", core::signed_rank_test(differences).p},
          {"padded_mean_p", core::difference_of_tasks(differences, core::Interval{0.0, 4.0}, resampling).p},
          {"hodges_lehmann", shift.estimate},
          {"spearman_rho", correlation.rho},
          {"spearman_p", correlation.p},
          {"student_975_of_12", core::student_quantile(12, 0.025)},
          {"betting_low", share.low},
          {"betting_high", share.high}};
}

}  // namespace dmrp::bench
