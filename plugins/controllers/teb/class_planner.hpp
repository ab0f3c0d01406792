// SPDX-License-Identifier: MIT
// class_planner.hpp: bands from the robot to its local goal, one for each homotopy class, and the best of them.
//
// Roesmann, Hoffmann, Bertram: Integrated online trajectory planning and optimization in distinctive topologies,
// Robotics and Autonomous Systems 88 (2017).
#ifndef DMRP_CONTROLLERS_TEB_CLASS_PLANNER_HPP
#define DMRP_CONTROLLERS_TEB_CLASS_PLANNER_HPP

#include <cstdint>
#include <dmrp/toolkit/random.hpp>
#include <vector>

#include "controllers/teb/band_optimizer.hpp"
#include "controllers/teb/roadmap.hpp"

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
  Signature signature = 0;
  double cost = 0.0;
  bool is_usable = true;
  bool is_initial_plan = false;  // the way along the path
  bool was_best = false;         // chosen last
};

class ClassPlanner {
 public:
  // Forgets everything.
  void start(const BandTuning& band, const ClassTuning& classes, const ReinitTuning& reinit, std::uint64_t seed);

  // Forgets the bands: the next plan() begins anew.
  void clear();

  // Brings the bands up to date, looks for ways that have none yet, and optimises them all.
  void plan(const Task& task);

  // The band chosen, nullptr where there is none.
  const TimedElasticBand* best() const { return best_ < count_ ? &candidates_[best_].band : nullptr; }

  // Drops the band chosen and chooses among the others.
  void drop_best();

  // Of the solver, in the last plan().
  int iterations() const { return optimizer_.iterations(); }

  std::size_t size() const { return count_; }
  const TimedElasticBand& band(std::size_t i) const { return candidates_[i].band; }

 private:
  bool goal_has_jumped(const Pose& goal) const;
  void renew();
  void explore(const Task& task);
  void lay_out_way(const Task& task, const std::vector<Vec2>& points);
  Candidate* find(Signature signature);
  Candidate* add();
  void optimise(const Task& task);
  void remove_unusable();
  void choose(std::int64_t t_ns);
  void drop_detours();

  BandTuning band_tuning_;
  ClassTuning class_tuning_;
  ReinitTuning reinit_;
  BandOptimizer optimizer_;
  Roadmap roadmap_;
  toolkit::Stream random_{0, "teb.roadmap"};
  std::vector<Candidate> candidates_;  // the first count_; the others keep their buffers
  std::size_t count_ = 0;
  std::size_t best_ = 0;
  Candidate laid_out_;  // a new band, before it is known to be of a class of its own
  std::vector<Vec2> way_;
  std::vector<Vec2> no_via_points_;  // stays empty
  std::vector<Mark> marks_;          // of the cycle's obstacles
  Pose last_goal_ = {0.0, 0.0, 0.0};
  std::int64_t switched_ns_ = 0;  // when another way was last chosen
  bool has_switched_ = false;
};

}  // namespace dmrp::controllers::teb

#endif
