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
  const double at_m = tracker.progress_m() + reached_m;
  goal_.theta = has_heading_ ? tracker.stop().heading
                             : direction(tracker.point_at(std::max(0.0, at_m - direction_reach_m)),
                                         tracker.point_at(at_m + direction_reach_m), now.pose.theta);
}

}  // namespace dmrp::controllers
