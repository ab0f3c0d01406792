// SPDX-License-Identifier: MIT
// way_ahead.hpp: the next part of a robot's way along its path.
#pragma once

#include <algorithm>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/polyline.hpp>
#include <vector>

namespace dmrp::metrics {

// The polyline from `position` to the path at progress_m and along the path for look_ahead_m.
inline std::vector<Vec2> way_ahead(const Path& path, Vec2 position, double progress_m, double look_ahead_m) {
  const std::vector<double> arcs = toolkit::arc_lengths(path);
  const double end_m = std::min(progress_m + look_ahead_m, arcs.back());
  std::vector<Vec2> way = {position, toolkit::point_at(path, arcs, progress_m)};
  for (std::size_t i = 0; i < path.size(); ++i)
    if (arcs[i] > progress_m && arcs[i] < end_m) way.push_back(toolkit::position(path[i]));
  way.push_back(toolkit::point_at(path, arcs, end_m));
  return way;
}

}  // namespace dmrp::metrics
