// SPDX-License-Identifier: MIT
// band_optimizer.hpp: brings a band into shape: outer iterations that resize and link it, inner ones that optimise it.
#ifndef DMRP_CONTROLLERS_TEB_BAND_OPTIMIZER_HPP
#define DMRP_CONTROLLERS_TEB_BAND_OPTIMIZER_HPP

#include "controllers/motion/levenberg_marquardt.hpp"
#include "controllers/teb/band_problem.hpp"

namespace dmrp::controllers::teb {

// Keeps its buffers from one band to the next.
class BandOptimizer {
 public:
  void reserve(std::size_t poses);

  // False where the optimisation broke down: a cost that is no number. The band is of no use then.
  bool optimise(TimedElasticBand& band, const Scene& scene, const BandTuning& tuning);

  // Of the solver, since the last reset.
  int iterations() const { return iterations_; }
  void reset_iterations() { iterations_ = 0; }

  // Of a band as it lies.
  double cost(TimedElasticBand& band, const Scene& scene, const BandTuning& tuning, const CostScales& scales);

 private:
  BandProblem problem_;
  LevenbergMarquardt<band_width> solver_;
  int iterations_ = 0;
};

}  // namespace dmrp::controllers::teb

#endif
