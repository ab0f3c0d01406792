// SPDX-License-Identifier: MIT
// timed_elastic_band.hpp: a trajectory as poses and the times between them.
//
// Roesmann, Feiten, Woesch, Hoffmann, Bertram: Trajectory modification considering dynamic constraints of autonomous
// robots, ROBOTIK 2012; Efficient trajectory optimization using a sparse model, ECMR 2013.
#ifndef DMRP_CONTROLLERS_TEB_TIMED_ELASTIC_BAND_HPP
#define DMRP_CONTROLLERS_TEB_TIMED_ELASTIC_BAND_HPP

#include <cstddef>
#include <dmrp/cpp/local_controller.hpp>
#include <vector>

#include "controllers/teb/tuning.hpp"

namespace dmrp::controllers::teb {

// Which way to turn where both ways would do.
enum class Turn { any, left, right };

// size() poses, the first one the robot's and the last one the goal, and a time from each to the next. Copying between
// two bands that have been reserved allocates nothing.
class TimedElasticBand {
 public:
  void reserve(std::size_t poses);
  void clear();

  std::size_t size() const { return x.size(); }
  bool empty() const { return x.empty(); }
  Pose pose(std::size_t i) const { return {x[i], y[i], theta[i]}; }
  Vec2 position(std::size_t i) const { return {x[i], y[i]}; }
  double duration_s() const;

  void set_pose(std::size_t i, const Pose& pose) { x[i] = pose.x, y[i] = pose.y, theta[i] = pose.theta; }
  void begin(const Pose& start);
  void append(const Pose& pose, double dt_s);  // after begin()

  // A new pose in the middle between pose i and the next.
  void split(std::size_t i);
  // Removes pose i and adds the time to it to the interval that follows, or to the one before where there is none.
  void remove(std::size_t i);

  std::vector<double> x;      // m
  std::vector<double> y;      // m
  std::vector<double> theta;  // rad
  std::vector<double> dt;     // s, one less
};

// A first band from `start` along the points to `goal`, at full speed. A robot that faces away turns in place first,
// the way `turn` says. `points` are any number in between; the goal's heading is taken as it is.
void lay_out(TimedElasticBand& band, const Pose& start, const Pose& goal, const std::vector<Vec2>& points,
             const Limits& limits, const BandTuning& tuning, Turn turn);

// Drops the poses that the robot has passed, then puts the ends to `start` and `goal`.
void move_ends(TimedElasticBand& band, const Pose& start, const Pose& goal, std::size_t min_samples);

// Inserts and removes poses so that the times come near dt_ref, within its hysteresis.
void resize(TimedElasticBand& band, const BandTuning& tuning);

}  // namespace dmrp::controllers::teb

#endif
