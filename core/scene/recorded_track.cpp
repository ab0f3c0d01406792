// SPDX-License-Identifier: MIT
#include "core/scene/recorded_track.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::core {
namespace {

using Point = Track::Point;

double seconds(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-9;
}

// The first point after this time.
std::vector<Point>::const_iterator next_point(const Track& track, std::int64_t t_ns) {
  return std::upper_bound(track.points.begin(), track.points.end(), t_ns,
                          [](std::int64_t t, const Point& point) { return t < point.t_ns; });
}

}  // namespace

bool is_on_track(const Track& track, std::int64_t t_ns) {
  assert(!track.points.empty());
  return track.points.front().t_ns <= t_ns && t_ns <= track.points.back().t_ns;
}

dmrp_vec2 position_on(const Track& track, std::int64_t t_ns) {
  assert(!track.points.empty());
  const auto to = next_point(track, t_ns);
  if (to == track.points.begin()) return to->position;
  const Point& from = *(to - 1);
  if (to == track.points.end()) return from.position;
  const double share = seconds(t_ns - from.t_ns) / seconds(to->t_ns - from.t_ns);
  return from.position + share * (to->position - from.position);
}

dmrp_vec2 velocity_on(const Track& track, std::int64_t t_ns) {
  assert(!track.points.empty());
  const auto to = next_point(track, t_ns);
  if (to == track.points.begin() || to == track.points.end()) return {0.0, 0.0};
  const Point& from = *(to - 1);
  return (to->position - from.position) / seconds(to->t_ns - from.t_ns);
}

double mean_speed(const Track& track) {
  assert(!track.points.empty());
  double length_m = 0.0;
  for (std::size_t i = 1; i < track.points.size(); ++i)
    length_m += toolkit::distance(track.points[i - 1].position, track.points[i].position);
  const double time_s = seconds(track.points.back().t_ns - track.points.front().t_ns);
  return time_s > 0.0 ? length_m / time_s : 0.0;
}

}  // namespace dmrp::core
