// SPDX-License-Identifier: MIT
// timed_elastic_band.hpp: a trajectory as a sequence of poses and the time intervals between them.
//
// Roesmann, Feiten, Woesch, Hoffmann, Bertram: Trajectory modification considering dynamic constraints of autonomous
// robots, ROBOTIK 2012; Efficient trajectory optimization using a sparse model, ECMR 2013.
#pragma once

#include <cstddef>
#include <dmrp/cpp/local_controller.hpp>
#include <vector>

#include "controllers/teb/parameters.hpp"

namespace dmrp::controllers::teb {

// The turning direction if both are possible.
enum class Turn { any, left, right };

// size() poses from the robot to the goal, and the time interval from each to the next. Copying between reserved bands
// does not allocate.
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

  // Inserts a pose half-way between pose i and the next.
  void split(std::size_t i);
  // Removes pose i; its interval is added to the following one, or to the previous one if there is none.
  void remove(std::size_t i);

  std::vector<double> x;      // m
  std::vector<double> y;      // m
  std::vector<double> theta;  // rad
  std::vector<double> dt;     // s; one fewer
};

// Creates a band from `start` along the points to `goal` at full speed. `points` may be empty; the last
// pose is `goal`.
void lay_out(TimedElasticBand& band, const Pose& start, const Pose& goal, const std::vector<Vec2>& points,
             const Limits& limits, const Parameters& parameters);

// Drops the poses that the robot has passed, then moves the ends to `start` and `goal`.
void move_ends(TimedElasticBand& band, const Pose& start, const Pose& goal, std::size_t min_samples);

// Inserts and removes poses so that the intervals approach dt_ref, within the hysteresis.
void resize(TimedElasticBand& band, const Parameters& parameters);

}  // namespace dmrp::controllers::teb
