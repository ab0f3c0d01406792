// SPDX-License-Identifier: MIT
// band_problem.hpp: a band's residuals as one least-squares problem with banded normal equations.
//
// The variables run pose by pose, x, y, theta, dt, so that no residual spans more than 11 of them in a row: the normal
// matrix has 10 entries beside its diagonal. The first and the last pose are held.
#ifndef DMRP_CONTROLLERS_TEB_BAND_PROBLEM_HPP
#define DMRP_CONTROLLERS_TEB_BAND_PROBLEM_HPP

#include <array>
#include <vector>

#include "controllers/teb/normal_equations.hpp"
#include "controllers/teb/obstacle_links.hpp"
#include "controllers/teb/residuals.hpp"
#include "controllers/teb/timed_elastic_band.hpp"

namespace dmrp::controllers::teb {

// What a band is optimised in: one control cycle's.
struct Scene {
  const Limits* limits = nullptr;
  const Footprint* footprint = nullptr;
  const std::vector<Obstacle>* obstacles = nullptr;
  const std::vector<Vec2>* via_points = nullptr;
  Twist start_velocity = {0.0, 0.0, 0.0};
  bool stops_at_goal = false;  // else the velocity there is free
  Turn preferred_turn = Turn::any;
};

// How much the parts of a cost count when bands are compared.
struct CostScales {
  double obstacles = 1.0;
  double via_points = 1.0;
  bool whole_duration = false;  // the time it takes, instead of the sum of squared intervals
};

// A Problem for LevenbergMarquardt; see there for linearise(), try_step(), keep() and restore(). Works on a band of
// somebody else's.
class BandProblem {
 public:
  void reserve(std::size_t poses);

  // The band to work on until the next begin(). Links it to the obstacles and via-points as it lies now.
  // `obstacle_factor`: of the obstacles' weights.
  void begin(TimedElasticBand& band, const Scene& scene, const BandTuning& tuning, double obstacle_factor);

  double linearise(BandedMatrix<band_width>& hessian, std::vector<double>& gradient);
  double try_step(const std::vector<double>& step);
  void keep() { kept_ = *band_; }
  void restore() { *band_ = kept_; }

  // The sum of weighted squares. Where two poses lie farther apart than the footprint reaches, the obstacles' part also
  // counts places between them: no band is cheap for having jumped over something.
  double cost(const CostScales& scales = {});

 private:
  template <bool with_derivatives>
  double evaluate(const NormalEquations& normal, const CostScales& scales);
  template <bool with_derivatives>
  void add_intervals(WeightedSquares<with_derivatives>& squares, bool count_time) const;
  template <bool with_derivatives>
  void add_accelerations(WeightedSquares<with_derivatives>& squares) const;
  template <bool with_derivatives>
  void add_obstacles(WeightedSquares<with_derivatives>& squares) const;
  template <bool with_derivatives>
  void add_closeness(WeightedSquares<with_derivatives>& squares, const ObstacleLink& link, double distance_m,
                     std::array<double, 3> by) const;
  double cost_of_jumps() const;
  template <bool with_derivatives>
  void add_via_points(WeightedSquares<with_derivatives>& squares) const;
  template <bool with_derivatives>
  void add_preferred_turn(WeightedSquares<with_derivatives>& squares) const;

  const Scene* scene_ = nullptr;
  const BandTuning* tuning_ = nullptr;
  TimedElasticBand* band_ = nullptr;
  TimedElasticBand kept_;
  double obstacle_factor_ = 1.0;
  std::vector<DirectedPose> poses_;
  std::vector<Motion> motions_;
  ObstacleLinker linker_;
  std::vector<ObstacleLink> links_;
  std::vector<ViaPointLink> via_links_;
};

}  // namespace dmrp::controllers::teb

#endif
