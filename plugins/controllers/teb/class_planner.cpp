// SPDX-License-Identifier: MIT
#include "controllers/teb/class_planner.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <utility>

namespace dmrp::controllers::teb {

namespace {

// The buffers' first sizes: poses of a band.
constexpr std::size_t usual_poses = 128;

// Legs of the roadmap tell classes apart: bands round the corners behind them, so that they need less than the whole
// room for the robot.
constexpr double leg_share = 0.5;

// The direction in which a band begins: to its first pose that far on.
Vec2 beginning(const TimedElasticBand& band, double length_m) {
  const Vec2 start = band.position(0);
  for (std::size_t i = 1; i < band.size(); ++i)
    if (toolkit::distance(start, band.position(i)) >= length_m) return band.position(i) - start;
  return band.position(band.size() - 1) - start;
}

}  // namespace

void ClassPlanner::start(const BandTuning& band, const ClassTuning& classes, const ReinitTuning& reinit,
                         std::uint64_t seed) {
  band_tuning_ = band;
  class_tuning_ = classes;
  reinit_ = reinit;
  random_ = toolkit::Stream(seed, "teb.roadmap");
  optimizer_.reserve(usual_poses);
  roadmap_.reserve(classes);
  candidates_.resize(classes.max_number_classes);
  for (Candidate& candidate : candidates_) candidate.band.reserve(usual_poses);
  laid_out_.band.reserve(usual_poses);
  marks_.reserve(512);
  has_switched_ = false;
  clear();
}

void ClassPlanner::clear() {
  count_ = 0;
  best_ = 0;
}

void ClassPlanner::plan(const Task& task) {
  if (count_ > 0 && goal_has_jumped(task.goal)) clear();
  last_goal_ = task.goal;
  set_marks(*task.scene.obstacles, toolkit::position(task.goal) - toolkit::position(task.start), marks_);
  for (std::size_t i = 0; i < count_; ++i)
    move_ends(candidates_[i].band, task.start, task.goal, band_tuning_.min_samples);
  if (class_tuning_.enable_homotopy_class_planning) {
    renew();
    explore(task);
  } else if (count_ == 0) {
    lay_out_way(task, *task.path);
    std::swap(*add(), laid_out_);
  }
  optimise(task);
  choose(task.t_ns);
  if (class_tuning_.delete_detours_backwards) drop_detours();
}

bool ClassPlanner::goal_has_jumped(const Pose& goal) const {
  return toolkit::distance(toolkit::position(goal), toolkit::position(last_goal_)) >
             reinit_.force_reinit_new_goal_dist ||
         std::abs(toolkit::difference(goal.theta, last_goal_.theta)) > reinit_.force_reinit_new_goal_angular;
}

// One band a class: that chosen last, else the first.
void ClassPlanner::renew() {
  if (best_ < count_) std::swap(candidates_[0], candidates_[best_]);
  best_ = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    Candidate& candidate = candidates_[i];
    candidate.signature = band_signature(candidate.band, marks_);
    candidate.is_initial_plan = false;
    candidate.is_usable = find(candidate.signature) == &candidate;
  }
  remove_unusable();
}

// The way along the path, then ways through the roadmap, as long as there is room for more classes.
void ClassPlanner::explore(const Task& task) {
  lay_out_way(task, *task.path);
  Candidate* initial = find(laid_out_.signature);
  if (!initial) {
    // it is never left out: the costliest other one makes room
    if (count_ == candidates_.size() && count_ > 1) {
      std::iter_swap(std::max_element(candidates_.begin() + 1, candidates_.end(),
                                      [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; }),
                     candidates_.end() - 1);
      --count_;
    }
    initial = add();
    if (initial) std::swap(*initial, laid_out_);
  }
  if (initial) initial->is_initial_plan = true;
  if (count_ == candidates_.size()) return;

  RoadmapQuery query;
  query.start = toolkit::position(task.start);
  query.goal = toolkit::position(task.goal);
  query.v_max = task.scene.limits->v_max;
  query.clearance_m = leg_share * task.scene.footprint->inscribed_radius_m + band_tuning_.min_obstacle_dist;
  query.obstacles = task.scene.obstacles;
  query.marks = &marks_;
  roadmap_.search(query, class_tuning_, random_);
  for (std::size_t i = 0; i < roadmap_.size() && count_ < candidates_.size(); ++i) {
    roadmap_.way(i, way_);
    lay_out_way(task, way_);
    if (!find(laid_out_.signature)) std::swap(*add(), laid_out_);
  }
}

void ClassPlanner::lay_out_way(const Task& task, const std::vector<Vec2>& points) {
  lay_out(laid_out_.band, task.start, task.goal, points, *task.scene.limits, band_tuning_, task.scene.preferred_turn);
  laid_out_.signature = band_signature(laid_out_.band, marks_);
  laid_out_.is_usable = true;
  laid_out_.is_initial_plan = false;
  laid_out_.was_best = false;
}

Candidate* ClassPlanner::find(Signature signature) {
  for (std::size_t i = 0; i < count_; ++i)
    if (candidates_[i].is_usable && candidates_[i].signature == signature) return &candidates_[i];
  return nullptr;
}

Candidate* ClassPlanner::add() {
  return count_ < candidates_.size() ? &candidates_[count_++] : nullptr;
}

void ClassPlanner::optimise(const Task& task) {
  const CostScales scales = {class_tuning_.selection_obst_cost_scale, class_tuning_.selection_viapoint_cost_scale,
                             class_tuning_.selection_alternative_time_cost};
  Scene unguided = task.scene;
  unguided.via_points = &no_via_points_;
  optimizer_.reset_iterations();
  for (std::size_t i = 0; i < count_; ++i) {
    Candidate& candidate = candidates_[i];
    const bool is_guided = class_tuning_.viapoints_all_candidates || candidate.is_initial_plan;
    const Scene& scene = is_guided ? task.scene : unguided;
    candidate.is_usable = optimizer_.optimise(candidate.band, scene, band_tuning_);
    if (candidate.is_usable) candidate.cost = optimizer_.cost(candidate.band, scene, band_tuning_, scales);
  }
  remove_unusable();
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

// The cheapest, with a preference for that chosen last and for the way along the path.
void ClassPlanner::choose(std::int64_t t_ns) {
  const auto counted_cost = [this](const Candidate& candidate) {
    return candidate.cost * (candidate.was_best ? class_tuning_.selection_cost_hysteresis : 1.0) *
           (candidate.is_initial_plan ? class_tuning_.selection_prefer_initial_plan : 1.0);
  };
  std::size_t last = count_;
  best_ = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    if (candidates_[i].was_best) last = i;
    if (counted_cost(candidates_[i]) < counted_cost(candidates_[best_])) best_ = i;
  }
  if (last < count_ && best_ != last) {
    if (has_switched_ && seconds(t_ns - switched_ns_) < class_tuning_.switching_blocking_period) {
      best_ = last;
    } else {
      has_switched_ = true;
      switched_ns_ = t_ns;
    }
  }
  for (std::size_t i = 0; i < count_; ++i) candidates_[i].was_best = i == best_;
}

// Ways that begin backward as seen from the best, or take far longer.
void ClassPlanner::drop_detours() {
  if (best_ >= count_) return;
  const TimedElasticBand& best = candidates_[best_].band;
  const double reach_m = class_tuning_.length_start_orientation_vector;
  const Vec2 ahead = toolkit::normalized(beginning(best, reach_m));
  const double longest_s = best.duration_s() * class_tuning_.max_ratio_detours_duration_best_duration;
  for (std::size_t i = 0; i < count_; ++i) {
    if (i == best_) continue;
    const Vec2 begin = toolkit::normalized(beginning(candidates_[i].band, reach_m));
    const bool is_backward = toolkit::dot(ahead, begin) < std::cos(class_tuning_.detours_orientation_tolerance);
    candidates_[i].is_usable = !is_backward && candidates_[i].band.duration_s() <= longest_s;
  }
  remove_unusable();
  for (std::size_t i = 0; i < count_; ++i)
    if (candidates_[i].was_best) best_ = i;
}

void ClassPlanner::drop_best() {
  if (best_ >= count_) return;
  candidates_[best_].is_usable = false;
  remove_unusable();
  choose(switched_ns_);
}

}  // namespace dmrp::controllers::teb
