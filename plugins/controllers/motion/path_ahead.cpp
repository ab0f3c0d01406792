// SPDX-License-Identifier: MIT
#include "controllers/motion/path_ahead.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers {

namespace {

// The path's direction at a point is that of the chord from this far before the point to this far after it.
constexpr double direction_reach_m = 0.3;

bool is_inside(const CostmapView& map, Vec2 point, double margin_m) {
  const Vec2 margin = {margin_m, margin_m};
  return map.index_of(point - margin) >= 0 && map.index_of(point + margin) >= 0;
}

double direction(Vec2 from, Vec2 to, double fallback) {
  const Vec2 chord = to - from;
  return toolkit::norm(chord) > 1e-6 ? std::atan2(chord.y, chord.x) : fallback;
}

}  // namespace

void PathAhead::look(const PathTracker& tracker, const Observation& now, const CostmapView& map, double look_ahead_m,
                     double window_margin_m) {
  assert(!tracker.empty() && look_ahead_m >= 0.0);
  points_.clear();
  const double whole_m = std::min(look_ahead_m, tracker.remaining_m());
  ends_at_stop_ = look_ahead_m >= tracker.remaining_m();
  const auto steps = static_cast<int>(std::ceil(whole_m / spacing_m));
  double reached_m = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double arc_m = std::min(i * spacing_m, whole_m);
    const Vec2 point = tracker.point_at(tracker.progress_m() + arc_m);
    if (i > 0 && !is_inside(map, point, window_margin_m)) {
      ends_at_stop_ = false;
      break;
    }
    points_.push_back(point);
    reached_m = arc_m;
  }
  goal_ = {points_.back().x, points_.back().y, 0.0};
  has_heading_ = ends_at_stop_ && std::isfinite(tracker.stop().heading);
  const double at_m = end_m_ = tracker.progress_m() + reached_m;
  goal_.theta = has_heading_ ? tracker.stop().heading
                             : direction(tracker.point_at(std::max(0.0, at_m - direction_reach_m)),
                                         tracker.point_at(at_m + direction_reach_m), now.pose.theta);
}

void PathAhead::look_along(const Detour& detour, const PathTracker& tracker, const Observation& now,
                           const CostmapView& map, double look_ahead_m, double window_margin_m) {
  assert(detour.is_kept() && !tracker.empty() && look_ahead_m >= 0.0);
  points_.clear();
  const auto point_at = [&](double ahead_m) {
    const double beyond_m = ahead_m - detour.remaining_m();
    return beyond_m > 0.0 ? tracker.point_at(detour.end_m() + beyond_m) : detour.point_ahead(ahead_m);
  };
  const double left_m = detour.remaining_m() + std::max(0.0, tracker.end_m() - detour.end_m());
  const double whole_m = std::min(look_ahead_m, left_m);
  ends_at_stop_ = look_ahead_m >= left_m;
  const auto steps = static_cast<int>(std::ceil(whole_m / spacing_m));
  double reached_m = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double ahead_m = std::min(i * spacing_m, whole_m);
    const Vec2 point = point_at(ahead_m);
    if (i > 0 && !is_inside(map, point, window_margin_m)) {
      ends_at_stop_ = false;
      break;
    }
    points_.push_back(point);
    reached_m = ahead_m;
  }
  has_heading_ = ends_at_stop_ && std::isfinite(tracker.stop().heading);
  goal_ = {points_.back().x, points_.back().y, 0.0};
  goal_.theta = has_heading_ ? tracker.stop().heading
                             : direction(point_at(std::max(0.0, reached_m - direction_reach_m)),
                                         point_at(reached_m + direction_reach_m), now.pose.theta);
  end_m_ = detour.end_m();
}

}  // namespace dmrp::controllers
