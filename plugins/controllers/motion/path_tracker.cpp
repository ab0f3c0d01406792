// SPDX-License-Identifier: MIT
#include "controllers/motion/path_tracker.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/polyline.hpp>
#include <limits>

namespace dmrp::controllers {

namespace {

// The search continues past a waypoint if its distance from the robot exceeds that of the position reached by no more
// than this. Less than a planning cell, so that an excursion of one cell is not skipped; enough for a robot that passes
// a person.
constexpr double climb_m = 0.5;

// The search covers this length of the path ahead of the position reached.
constexpr double search_m = 3.0;

}  // namespace

void PathTracker::set_path(Path path) {
  clear();
  for (const Waypoint& waypoint : path) points_.push_back(toolkit::position(waypoint));
  toolkit::arc_lengths(points_, arcs_);
  leads_to_goal_ = !path.is_partial();
}

void PathTracker::clear() {
  points_.clear();
  arcs_.clear();
  fresh_ = true;
  led_in_ = false;
  progress_m_ = 0.0;
  end_m_ = 0.0;
  stop_ = {};
}

void PathTracker::update(const Observation& now) {
  if (empty()) return;
  if (fresh_) lead_in(now);
  fresh_ = false;
  if (!led_in_) progress_m_ = std::clamp(now.progress_m, progress_m_, arcs_.back());
  advance(toolkit::position(now.pose));
  find_end(now);
}

// A path of one waypoint: prepend the robot's position, so that the path is the straight line to the waypoint.
void PathTracker::lead_in(const Observation& now) {
  if (points_.size() != 1) return;
  points_.insert(points_.begin(), toolkit::position(now.pose));
  toolkit::arc_lengths(points_, arcs_);
  led_in_ = true;
}

void PathTracker::advance(Vec2 robot) {
  toolkit::PathPlace best = toolkit::place_at(points_, arcs_, progress_m_);
  double best_distance_m = toolkit::distance(best.point, robot);
  const double last_m = progress_m_ + search_m;
  for (std::size_t i = best.segment; i + 1 < points_.size() && arcs_[i] <= last_m; ++i) {
    // the distance from a point is convex along a segment, so its maximum is at a waypoint
    if (arcs_[i] > progress_m_ && toolkit::distance(points_[i], robot) > best_distance_m + climb_m) break;
    const double from_m = std::max(progress_m_, arcs_[i]);
    const toolkit::PathPlace place = toolkit::project(points_, arcs_, robot, from_m, arcs_[i + 1]);
    if (place.distance_m < best_distance_m) {
      best = place;
      best_distance_m = place.distance_m;
    }
  }
  progress_m_ = std::max(progress_m_, best.arc_m);
}

void PathTracker::find_end(const Observation& now) {
  end_m_ = arcs_.back();
  stop_.position = points_.back();
  stop_.heading = std::numeric_limits<double>::quiet_NaN();
  stop_.tolerance_m = now.goal.tolerance_m;
  stop_.tolerance_rad = now.goal.tolerance_rad;
  stop_.is_goal = leads_to_goal_ && toolkit::distance(points_.back(), toolkit::position(now.goal.pose)) <=
                                        std::max(now.goal.tolerance_m, 1e-3);
  if (stop_.is_goal) {
    stop_.position = toolkit::position(now.goal.pose);
    stop_.heading = now.goal.pose.theta;
  }
  progress_m_ = std::min(progress_m_, end_m_);
}

Vec2 PathTracker::point_at(double arc_m) const {
  assert(!empty());
  return arc_m >= end_m_ ? stop_.position : toolkit::point_at(points_, arcs_, arc_m);
}

double PathTracker::heading_at(double arc_m, double fallback) const {
  return toolkit::heading_at(points_, arcs_, std::min(arc_m, end_m_), fallback);
}

Vec2 PathTracker::point_at_distance(Vec2 from, double distance_m) const {
  toolkit::PathPlace place = toolkit::place_at(points_, arcs_, progress_m_);
  Vec2 inside = place.point;
  if (toolkit::distance(from, inside) >= distance_m) return inside;
  for (std::size_t i = place.segment + 1; i < points_.size(); ++i) {
    const bool ends = arcs_[i] >= end_m_;
    const Vec2 next = ends ? stop_.position : points_[i];
    if (toolkit::distance(from, next) > distance_m) {
      // the segment leaves the circle: |inside + f (next - inside) - from| = distance
      const Vec2 along = next - inside;
      const Vec2 offset = inside - from;
      const double a = toolkit::squared_norm(along);
      const double b = toolkit::dot(offset, along);
      const double c = toolkit::squared_norm(offset) - distance_m * distance_m;
      return toolkit::lerp(inside, next, std::clamp((-b + std::sqrt(std::max(0.0, b * b - a * c))) / a, 0.0, 1.0));
    }
    inside = next;
    if (ends) break;
  }
  return inside;
}

}  // namespace dmrp::controllers
