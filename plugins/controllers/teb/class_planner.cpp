// SPDX-License-Identifier: MIT
#include "class_planner.hpp"

#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers::teb {

void ClassPlanner::start(const BandTuning& band, const ClassTuning& classes, const ReinitTuning& reinit,
                         std::uint64_t) {
  band_tuning_ = band;
  class_tuning_ = classes;
  reinit_ = reinit;
  optimizer_.reserve(64);
  candidates_.resize(8);
  for (Candidate& candidate : candidates_) candidate.band.reserve(64);
  clear();
}

void ClassPlanner::clear() {
  count_ = 0;
  best_ = 0;
}

void ClassPlanner::plan(const Task& task) {
  if (count_ > 0 && goal_has_jumped(task.goal)) clear();
  last_goal_ = task.goal;
  for (std::size_t i = 0; i < count_; ++i)
    move_ends(candidates_[i].band, task.start, task.goal, band_tuning_.min_samples);
  if (count_ == 0)
    lay_out(add().band, task.start, task.goal, *task.path, *task.scene.limits, band_tuning_, task.scene.preferred_turn);
  for (std::size_t i = 0; i < count_; ++i) {
    Candidate& candidate = candidates_[i];
    candidate.is_usable = optimizer_.optimise(candidate.band, task.scene, band_tuning_);
    if (candidate.is_usable) candidate.cost = optimizer_.cost(candidate.band, task.scene, band_tuning_, {});
  }
  remove_unusable();
  choose();
}

bool ClassPlanner::goal_has_jumped(const Pose& goal) const {
  return toolkit::distance(toolkit::position(goal), toolkit::position(last_goal_)) >
             reinit_.force_reinit_new_goal_dist ||
         std::abs(toolkit::difference(goal.theta, last_goal_.theta)) > reinit_.force_reinit_new_goal_angular;
}

Candidate& ClassPlanner::add() {
  Candidate& candidate = candidates_[count_++];
  candidate.is_usable = true;
  return candidate;
}

void ClassPlanner::remove_unusable() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    if (!candidates_[i].is_usable) continue;
    if (kept != i) std::swap(candidates_[kept], candidates_[i]);
    ++kept;
  }
  count_ = kept;
}

void ClassPlanner::choose() {
  best_ = 0;
}

void ClassPlanner::drop_best() {
  if (best_ >= count_) return;
  candidates_[best_].is_usable = false;
  remove_unusable();
  choose();
}

}  // namespace dmrp::controllers::teb
