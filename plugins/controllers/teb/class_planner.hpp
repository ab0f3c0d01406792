// SPDX-License-Identifier: MIT
// class_planner.hpp: plans one band per homotopy class from the robot to its local goal, and chooses the best.
//
// Roesmann, Hoffmann, Bertram: Integrated online trajectory planning and optimization in distinctive topologies,
// Robotics and Autonomous Systems 88 (2017).
#pragma once

#include <cstdint>
#include <dmrp/toolkit/random.hpp>
#include <vector>

#include "controllers/teb/band_optimizer.hpp"
#include "controllers/teb/roadmap.hpp"

namespace dmrp::controllers::teb {

// The input of one control cycle. Does not own what it refers to.
struct Task {
  std::int64_t t_ns = 0;
  Pose start = {0.0, 0.0, 0.0};
  Pose goal = {0.0, 0.0, 0.0};
  const std::vector<Vec2>* path = nullptr;  // points from near the start to the goal
  Scene scene;
};

struct Candidate {
  TimedElasticBand band;
  Signature signature = 0;
  double cost = 0.0;
  bool is_usable = true;
  bool is_initial_plan = false;  // of the class of the band along the path
  bool was_best = false;         // the last choice
};

class ClassPlanner {
 public:
  // Resets all state.
  void start(const Parameters& parameters, std::uint64_t seed);

  // Drops all bands: the next plan() starts with new ones.
  void clear();

  // Updates the bands, adds bands of new classes, optimises all bands and chooses one.
  void plan(const Task& task);

  // The chosen band; nullptr if there is none.
  const TimedElasticBand* best() const { return best_ < count_ ? &candidates_[best_].band : nullptr; }

  // Drops the chosen band and chooses among the others.
  void drop_best();

  // Solver iterations of the last plan().
  int iterations() const { return optimizer_.iterations(); }

  std::size_t size() const { return count_; }
  const TimedElasticBand& band(std::size_t i) const { return candidates_[i].band; }

 private:
  bool goal_has_jumped(const Pose& goal) const;
  void renew();
  void explore(const Task& task);
  void lay_out_band(const Task& task, const std::vector<Vec2>& points);
  Candidate* find(Signature signature);
  Candidate* add();
  void optimise(const Task& task);
  void remove_unusable();
  void choose(std::int64_t t_ns);
  void drop_detours();

  Parameters parameters_;
  BandOptimizer optimizer_;
  Roadmap roadmap_;
  toolkit::Stream random_{0, "teb.roadmap"};
  std::vector<Candidate> candidates_;  // the first count_ are in use; the others keep their buffers
  std::size_t count_ = 0;
  std::size_t best_ = 0;
  Candidate laid_out_;               // a new band, before its class is known to be new
  std::vector<Vec2> route_;          // a path through the roadmap
  std::vector<Vec2> no_via_points_;  // stays empty
  std::vector<Mark> marks_;          // of this cycle's obstacles
  Pose last_goal_ = {0.0, 0.0, 0.0};
  std::int64_t switched_ns_ = 0;  // when the choice last changed to another class
  bool has_switched_ = false;
};

}  // namespace dmrp::controllers::teb
