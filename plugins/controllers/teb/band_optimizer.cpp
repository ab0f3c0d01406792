// SPDX-License-Identifier: MIT
#include "controllers/teb/band_optimizer.hpp"

namespace dmrp::controllers::teb {

namespace {

// An outer iteration ends early once an inner iteration lowers the cost by less than this fraction.
constexpr double least_decrease = 1e-3;

}  // namespace

void BandOptimizer::reserve(std::size_t poses) {
  problem_.reserve(poses);
  solver_.reserve(4 * poses);
}

bool BandOptimizer::optimise(TimedElasticBand& band, const Scene& scene, const Parameters& parameters) {
  LevenbergMarquardtSettings settings;
  settings.iterations = static_cast<int>(parameters.no_inner_iterations);
  settings.least_decrease = least_decrease;
  double obstacle_factor = 1.0;
  for (std::size_t outer = 0; outer < parameters.no_outer_iterations; ++outer) {
    resize(band, parameters);
    problem_.begin(band, scene, parameters, obstacle_factor);
    const LevenbergMarquardtResult result = solver_.minimise(problem_, settings);
    iterations_ += result.iterations;
    if (!result.is_finite) return false;
    obstacle_factor *= parameters.weight_adapt_factor;
  }
  return true;
}

double BandOptimizer::cost(TimedElasticBand& band, const Scene& scene, const Parameters& parameters,
                           const CostScales& scales) {
  problem_.begin(band, scene, parameters, 1.0);
  return problem_.cost(scales);
}

}  // namespace dmrp::controllers::teb
