// SPDX-License-Identifier: MIT
#include "controllers/teb/band_optimizer.hpp"

#include <cmath>

namespace dmrp::controllers::teb {

namespace {

// An outer iteration ends early where its iterations gain less than this share of the cost.
constexpr double least_decrease = 1e-3;

}  // namespace

void BandOptimizer::reserve(std::size_t poses) {
  problem_.reserve(poses);
  solver_.reserve(4 * poses);
}

bool BandOptimizer::optimise(TimedElasticBand& band, const Scene& scene, const BandTuning& tuning) {
  LevenbergMarquardtSettings settings;
  settings.iterations = tuning.no_inner_iterations;
  settings.least_decrease = least_decrease;
  double obstacle_factor = 1.0;
  for (int outer = 0; outer < tuning.no_outer_iterations; ++outer) {
    resize(band, tuning);
    problem_.begin(band, scene, tuning, obstacle_factor);
    const LevenbergMarquardtResult result = solver_.minimise(problem_, settings);
    iterations_ += result.iterations;
    if (!result.is_finite) return false;
    obstacle_factor *= tuning.weight_adapt_factor;
  }
  return true;
}

double BandOptimizer::cost(TimedElasticBand& band, const Scene& scene, const BandTuning& tuning,
                           const CostScales& scales) {
  problem_.begin(band, scene, tuning, 1.0);
  return problem_.cost(scales);
}

}  // namespace dmrp::controllers::teb
