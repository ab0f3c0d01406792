// SPDX-License-Identifier: MIT
// band_optimizer.hpp: optimises a band: outer iterations resize it and associate obstacles, inner iterations solve.
#pragma once

#include "controllers/motion/levenberg_marquardt.hpp"
#include "controllers/teb/band_problem.hpp"

namespace dmrp::controllers::teb {

// Reuses its buffers from one band to the next.
class BandOptimizer {
 public:
  void reserve(std::size_t poses);

  // False if the optimisation fails with a cost that is not finite; the band cannot be used then.
  bool optimise(TimedElasticBand& band, const Scene& scene, const Parameters& parameters);

  // Solver iterations since the last reset.
  int iterations() const { return iterations_; }
  void reset_iterations() { iterations_ = 0; }

  // The cost of a band.
  double cost(TimedElasticBand& band, const Scene& scene, const Parameters& parameters, const CostScales& scales);

 private:
  BandProblem problem_;
  LevenbergMarquardt<band_width> solver_;
  int iterations_ = 0;
};

}  // namespace dmrp::controllers::teb
