// SPDX-License-Identifier: MIT
#include "controllers/motion/detour.hpp"

#include <cassert>
#include <dmrp/toolkit/polyline.hpp>

namespace dmrp::controllers {

namespace {

// The robot's place on the way is looked for up to this distance ahead.
constexpr double ahead_m = 1.0;

// A robot farther from the way than this has strayed.
constexpr double strayed_m = 0.8;

// The way is driven once no more than this remains.
constexpr double driven_m = 0.3;

// A blocked way is joined as far on as possible, at a place no farther from it than this.
constexpr double joint_within_m = 0.6;
constexpr double joint_step_m = 0.2;

// Longer ways allocate: one across a window of usual size, in steps of a lattice, is shorter.
constexpr std::size_t usual_points = 512;

// A shorter gain along the path is none.
constexpr double gain_m = 0.02;

}  // namespace

Detour::Detour() {
  for (std::vector<Vec2>* points : {&points_, &mended_}) points->reserve(usual_points);
  arcs_.reserve(usual_points);
}

void Detour::keep(const std::vector<Vec2>& way, double end_m) {
  assert(way.size() >= 2);
  points_ = way;
  toolkit::arc_lengths(points_, arcs_);
  progress_m_ = 0.0;
  end_m_ = end_m;
}

void Detour::update(Vec2 robot, double path_progress_m) {
  if (points_.empty()) return;
  const toolkit::PathPlace place = toolkit::project(points_, arcs_, robot, progress_m_, progress_m_ + ahead_m);
  progress_m_ = place.arc_m;
  if (path_progress_m >= end_m_ || remaining_m() < driven_m || toolkit::distance(place.point, robot) > strayed_m)
    clear();
}

bool Detour::mend(const Guide& guide, const CostmapView& map) {
  assert(is_kept());
  std::optional<Vec2> joint;
  double joint_m = arcs_.back();
  for (; joint_m > progress_m_; joint_m -= joint_step_m) {
    joint = guide.nearest_reached(map, toolkit::point_at(points_, arcs_, joint_m), joint_within_m);
    if (joint) break;
  }
  if (!joint) return false;
  guide.path_to(map, *joint, mended_);
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (arcs_[i] > joint_m) mended_.push_back(points_[i]);
  if (mended_.size() < 2) return false;
  keep(mended_, end_m_);
  return true;
}

bool Detour::leads_beyond(double arc_m) const {
  return !points_.empty() && end_m_ > arc_m + gain_m;
}

Vec2 Detour::point_ahead(double distance_m) const {
  assert(is_kept());
  return toolkit::point_at(points_, arcs_, progress_m_ + distance_m);
}

}  // namespace dmrp::controllers
