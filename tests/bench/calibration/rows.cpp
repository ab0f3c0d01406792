// SPDX-License-Identifier: MIT
#include "tests/bench/calibration/rows.hpp"

#include <cmath>

namespace dmrp::bench {

Measured measure(const Row& row, std::size_t benchmarks) {
  Measured sum;
  const auto count = static_cast<double>(benchmarks);
  for (std::size_t i = 0; i < benchmarks; ++i) {
    toolkit::Stream random(1, "calibration", row.procedure, row.truth, row.n, i);
    const Outcome outcome = row.benchmark(random);
    sum.share += outcome.is_hit ? 1.0 / count : 0.0;
    sum.share_of_reference += outcome.is_hit_of_reference ? 1.0 / count : 0.0;
    sum.width += outcome.width / count;
  }
  return sum;
}

bool meets_target(const Row& row, const Measured& measured, std::size_t benchmarks) {
  if (!row.target) return true;
  const double target = row.measure == Measure::power ? measured.share_of_reference - *row.target : *row.target;
  const double share = std::fmin(std::fmax(target, 0.0), 1.0);
  const double tolerance = 3.0 * std::sqrt(share * (1.0 - share) / static_cast<double>(benchmarks));
  return row.measure == Measure::false_positives ? measured.share <= target + tolerance
                                                 : measured.share >= target - tolerance;
}

}  // namespace dmrp::bench
