// SPDX-License-Identifier: MIT
// class_planner.hpp: bands from the robot to its local goal, one for each homotopy class, and the best of them.
//
// Roesmann, Hoffmann, Bertram: Integrated online trajectory planning and optimization in distinctive topologies,
// Robotics and Autonomous Systems 88 (2017).
#ifndef DMRP_CONTROLLERS_TEB_CLASS_PLANNER_HPP
#define DMRP_CONTROLLERS_TEB_CLASS_PLANNER_HPP

#include <cstdint>
#include <vector>

#include "band_optimizer.hpp"

namespace dmrp::controllers::teb {

// What is to be planned in this cycle.
struct Task {
  std::int64_t t_ns = 0;
  Pose start = {0.0, 0.0, 0.0};
  Pose goal = {0.0, 0.0, 0.0};
  const std::vector<Vec2>* path = nullptr;  // from near the start to the goal
  Scene scene;
};

// When a goal has moved too far for the old bands to lead to it.
struct ReinitTuning {
  double force_reinit_new_goal_dist = 1.0;                        // m
  double force_reinit_new_goal_angular = 1.57079632679489661923;  // rad
};

struct Candidate {
  TimedElasticBand band;
  double cost = 0.0;
  bool is_usable = true;
};

class ClassPlanner {
 public:
  // Forgets everything.
  void start(const BandTuning& band, const ClassTuning& classes, const ReinitTuning& reinit, std::uint64_t seed);

  // Forgets the bands: the next plan() begins anew.
  void clear();

  // Brings the bands up to date and optimises them.
  void plan(const Task& task);

  // The band chosen, nullptr where there is none.
  const TimedElasticBand* best() const { return best_ < count_ ? &candidates_[best_].band : nullptr; }

  // Drops the band chosen and chooses among the others.
  void drop_best();

  std::size_t size() const { return count_; }
  const TimedElasticBand& band(std::size_t i) const { return candidates_[i].band; }

 private:
  bool goal_has_jumped(const Pose& goal) const;
  Candidate& add();
  void remove_unusable();
  void choose();

  BandTuning band_tuning_;
  ClassTuning class_tuning_;
  ReinitTuning reinit_;
  BandOptimizer optimizer_;
  std::vector<Candidate> candidates_;  // the first count_; the others keep their buffers
  std::size_t count_ = 0;
  std::size_t best_ = 0;
  Pose last_goal_ = {0.0, 0.0, 0.0};
};

}  // namespace dmrp::controllers::teb

#endif
