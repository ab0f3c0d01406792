// SPDX-License-Identifier: MIT
#include "controllers/teb/class_planner.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <utility>

namespace dmrp::controllers::teb {

namespace {

// Initial size of buffers: poses of a band.
constexpr std::size_t usual_poses = 128;

// The clearance of the roadmap's legs, relative to the inscribed radius. Legs only distinguish classes; the
// optimisation rounds their corners, so they need less than the robot's clearance.
constexpr double leg_clearance = 0.5;

// The vector from a band's start to its first pose at this distance or farther.
Vec2 beginning(const TimedElasticBand& band, double length_m) {
  const Vec2 start = band.position(0);
  for (std::size_t i = 1; i < band.size(); ++i)
    if (toolkit::distance(start, band.position(i)) >= length_m) return band.position(i) - start;
  return band.position(band.size() - 1) - start;
}

}  // namespace

void ClassPlanner::start(const Parameters& parameters, std::uint64_t seed) {
  parameters_ = parameters;
  random_ = toolkit::Stream(seed, "teb.roadmap");
  optimizer_.reserve(usual_poses);
  roadmap_.reserve(parameters);
  candidates_.resize(parameters.max_number_classes);
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
    move_ends(candidates_[i].band, task.start, task.goal, parameters_.min_samples);
  if (parameters_.enable_homotopy_class_planning) {
    renew();
    explore(task);
  } else if (count_ == 0) {
    lay_out_band(task, *task.path);
    std::swap(*add(), laid_out_);
  }
  optimise(task);
  choose(task.t_ns);
  if (parameters_.delete_detours_backwards) drop_detours();
}

bool ClassPlanner::goal_has_jumped(const Pose& goal) const {
  return toolkit::distance(toolkit::position(goal), toolkit::position(last_goal_)) >
             parameters_.force_reinit_new_goal_dist ||
         std::abs(toolkit::difference(goal.theta, last_goal_.theta)) > parameters_.force_reinit_new_goal_angular;
}

// Keeps one band per class: the last choice, otherwise the first.
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

// Adds the band along the path, then bands through the roadmap, up to the maximum number of classes.
void ClassPlanner::explore(const Task& task) {
  lay_out_band(task, *task.path);
  Candidate* initial = find(laid_out_.signature);
  if (!initial) {
    // the band along the path is always included; it replaces the most expensive one but the last choice
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
  query.clearance_m = leg_clearance * task.scene.footprint->inscribed_radius_m + parameters_.min_obstacle_dist;
  query.obstacles = task.scene.obstacles;
  query.marks = &marks_;
  roadmap_.search(query, parameters_, random_);
  for (std::size_t i = 0; i < roadmap_.size() && count_ < candidates_.size(); ++i) {
    roadmap_.path(i, route_);
    lay_out_band(task, route_);
    if (!find(laid_out_.signature)) std::swap(*add(), laid_out_);
  }
}

void ClassPlanner::lay_out_band(const Task& task, const std::vector<Vec2>& points) {
  lay_out(laid_out_.band, task.start, task.goal, points, *task.scene.limits, parameters_);
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
  const CostScales scales = {parameters_.selection_obst_cost_scale, parameters_.selection_viapoint_cost_scale,
                             parameters_.selection_alternative_time_cost};
  Scene unguided = task.scene;
  unguided.via_points = &no_via_points_;
  optimizer_.reset_iterations();
  for (std::size_t i = 0; i < count_; ++i) {
    Candidate& candidate = candidates_[i];
    const bool is_guided = parameters_.viapoints_all_candidates || candidate.is_initial_plan;
    const Scene& scene = is_guided ? task.scene : unguided;
    candidate.is_usable = optimizer_.optimise(candidate.band, scene, parameters_);
    if (candidate.is_usable) candidate.cost = optimizer_.cost(candidate.band, scene, parameters_, scales);
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

// Chooses the band of lowest cost, with a preference for the last choice and for the band along the path.
void ClassPlanner::choose(std::int64_t t_ns) {
  const auto counted_cost = [this](const Candidate& candidate) {
    return candidate.cost * (candidate.was_best ? parameters_.selection_cost_hysteresis : 1.0) *
           (candidate.is_initial_plan ? parameters_.selection_prefer_initial_plan : 1.0);
  };
  std::size_t last = count_;
  best_ = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    if (candidates_[i].was_best) last = i;
    if (counted_cost(candidates_[i]) < counted_cost(candidates_[best_])) best_ = i;
  }
  if (last < count_ && best_ != last) {
    if (has_switched_ && seconds(t_ns - switched_ns_) < parameters_.switching_blocking_period) {
      best_ = last;
    } else {
      has_switched_ = true;
      switched_ns_ = t_ns;
    }
  }
  for (std::size_t i = 0; i < count_; ++i) candidates_[i].was_best = i == best_;
}

// Drops bands that begin in the opposite direction to the best one, or take far longer.
void ClassPlanner::drop_detours() {
  if (best_ >= count_) return;
  const TimedElasticBand& best = candidates_[best_].band;
  const double reach_m = parameters_.length_start_orientation_vector;
  const Vec2 ahead = toolkit::normalized(beginning(best, reach_m));
  const double longest_s = best.duration_s() * parameters_.max_ratio_detours_duration_best_duration;
  for (std::size_t i = 0; i < count_; ++i) {
    if (i == best_) continue;
    const Vec2 begin = toolkit::normalized(beginning(candidates_[i].band, reach_m));
    const bool is_backward = toolkit::dot(ahead, begin) < std::cos(parameters_.detours_orientation_tolerance);
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
