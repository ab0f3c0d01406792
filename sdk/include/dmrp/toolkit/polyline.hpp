// SPDX-License-Identifier: MIT
// polyline.hpp: arc lengths and projections on a path.
//
// A path is any type with size() and operator[] whose elements have x and y in metres: a std::vector<dmrp_vec2>, a
// span of dmrp_waypoint. Repeated points (waits) are allowed. Segment i leads from point i to point i + 1.
// Arc length is measured from the first point, in metres; `arcs` are the arc lengths of all points (arc_lengths()).
// Functions that return a place need at least one point, unless stated otherwise.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>
#include <vector>

#include "segment.hpp"
#include "vec2.hpp"

namespace dmrp::toolkit {

// A place on a path.
struct PathPlace {
  dmrp_vec2 point = {0.0, 0.0};
  std::size_t segment = 0;  // the last segment if the place is the end of the path; 0 on a path of one point
  double fraction = 0.0;    // of that segment, in [0, 1]
  double arc_m = 0.0;       // arc length of `point`
  double distance_m = 0.0;  // from the projected point; 0 if none was projected
};

template <class Path>
double length(const Path& path) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += distance(position(path[i - 1]), position(path[i]));
  return sum;
}

// Fills `arcs` with the arc length of every point: the first is 0, they never decrease.
template <class Path>
void arc_lengths(const Path& path, std::vector<double>& arcs) {
  arcs.resize(path.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i > 0) sum += distance(position(path[i - 1]), position(path[i]));
    arcs[i] = sum;
  }
}

template <class Path>
std::vector<double> arc_lengths(const Path& path) {
  std::vector<double> arcs;
  arc_lengths(path, arcs);
  return arcs;
}

// The place at this arc length, which is clamped to the path. On a wait it is the end of the wait.
template <class Path>
PathPlace place_at(const Path& path, const std::vector<double>& arcs, double arc_m) {
  assert(path.size() > 0 && arcs.size() == path.size());
  PathPlace place;
  if (path.size() == 1) {
    place.point = position(path[0]);
    return place;
  }
  place.arc_m = std::clamp(arc_m, 0.0, arcs.back());
  const auto after = std::upper_bound(arcs.begin(), arcs.end(), place.arc_m);
  const auto next = std::clamp<std::size_t>(static_cast<std::size_t>(after - arcs.begin()), 1, path.size() - 1);
  const double span = arcs[next] - arcs[next - 1];
  place.segment = next - 1;
  place.fraction = span > 0.0 ? std::min((place.arc_m - arcs[next - 1]) / span, 1.0) : 1.0;
  place.point = lerp(position(path[next - 1]), position(path[next]), place.fraction);
  return place;
}

template <class Path>
dmrp_vec2 point_at(const Path& path, const std::vector<double>& arcs, double arc_m) {
  return place_at(path, arcs, arc_m).point;
}

// The nearest place whose arc length is in [from_m, to_m] (both clamped to the path); the first among equals. Where a
// path crosses or repeats itself, the window keeps the place on the present lap. Progress that never decreases is
//
//   progress_m = project(path, arcs, robot, progress_m, progress_m + window_m).arc_m;
//
// Takes time linear in the number of segments in the window, plus a binary search.
template <class Path>
PathPlace project(const Path& path, const std::vector<double>& arcs, dmrp_vec2 point, double from_m, double to_m) {
  PathPlace best = place_at(path, arcs, from_m);
  best.distance_m = distance(best.point, point);
  const double end_m = std::min(to_m, arcs.back());
  for (std::size_t i = best.segment; i + 1 < path.size() && arcs[i] <= end_m; ++i) {
    const double span = arcs[i + 1] - arcs[i];
    if (!(span > 0.0)) continue;
    const dmrp_segment segment = {position(path[i]), position(path[i + 1])};
    const double first = i == best.segment && arcs[i] < from_m ? std::min((from_m - arcs[i]) / span, 1.0) : 0.0;
    const double last = std::max(first, std::min((end_m - arcs[i]) / span, 1.0));
    const double fraction = std::clamp(closest_fraction(segment, point), first, last);
    const dmrp_vec2 candidate = lerp(segment.from, segment.to, fraction);
    const double candidate_distance = distance(candidate, point);
    if (candidate_distance < best.distance_m) {
      const double arc_m = std::clamp(arcs[i] + fraction * span, from_m, std::max(from_m, end_m));
      best = {candidate, i, fraction, arc_m, candidate_distance};
    }
  }
  return best;
}

// The nearest place on the whole path.
template <class Path>
PathPlace project(const Path& path, const std::vector<double>& arcs, dmrp_vec2 point) {
  return project(path, arcs, point, 0.0, std::numeric_limits<double>::infinity());
}

// The point that lies `look_ahead_m` >= 0 beyond the place nearest to `from` (a pose or a point) along the path, or the
// end of the path if that is nearer. Takes the first of several nearest places. Returns `from` for an empty path. Needs
// no arc lengths and does not allocate; visits the whole path.
template <class Path, class From>
dmrp_vec2 point_ahead(const Path& path, const From& from, double look_ahead_m) {
  assert(look_ahead_m >= 0.0);
  if (path.size() == 0) return position(from);
  dmrp_vec2 at = position(path[0]);
  double nearest = squared_distance(at, position(from));
  std::size_t next = 1;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const dmrp_vec2 candidate = closest_point(dmrp_segment{position(path[i - 1]), position(path[i])}, position(from));
    if (squared_distance(candidate, position(from)) < nearest) {
      at = candidate;
      nearest = squared_distance(candidate, position(from));
      next = i;
    }
  }
  for (double left_m = look_ahead_m; next < path.size(); ++next) {
    const double span = distance(at, position(path[next]));
    if (span > left_m) return lerp(at, position(path[next]), left_m / span);
    left_m -= span;
    at = position(path[next]);
  }
  return at;
}

// The direction of travel at this arc length in (-pi, pi]: of the segment that begins there, or at the end of the path
// of the last segment with a length. `fallback` if no segment has a length.
template <class Path>
double heading_at(const Path& path, const std::vector<double>& arcs, double arc_m, double fallback) {
  if (path.size() < 2) return fallback;
  for (std::size_t i = place_at(path, arcs, arc_m).segment + 1; i-- > 0;) {
    const dmrp_vec2 along = position(path[i + 1]) - position(path[i]);
    if (along != dmrp_vec2{0.0, 0.0}) return std::atan2(along.y, along.x);
  }
  return fallback;
}

}  // namespace dmrp::toolkit
