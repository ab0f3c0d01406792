// SPDX-License-Identifier: MIT
#include "core/progress.hpp"

#include <dmrp/toolkit/polyline.hpp>

namespace dmrp::core {
namespace {

// How far ahead on the path the robot is looked for, beyond what it has travelled since its last gain: enough to follow
// one that cuts a corner, too little to skip a detour that it is about to take.
constexpr double search_ahead_m = 2.0;

}  // namespace

void PathProgress::set_path(std::span<const dmrp_waypoint> path, dmrp_vec2 position) {
  path_.assign(path.begin(), path.end());
  toolkit::arc_lengths(path_, arcs_);
  progress_m_ = 0.0;
  travelled_m_ = 0.0;
  last_position_ = position;
  waypoint_ = 0;
  const double gained_before_m = gained_m_;
  advance(position, path_.empty() ? 0.0 : arcs_.back());
  gained_m_ = gained_before_m;
}

void PathProgress::update(dmrp_vec2 position, std::uint32_t goal_index) {
  if (path_.empty()) return;
  travelled_m_ += toolkit::distance(last_position_, position);
  last_position_ = position;

  // the way to the current goal ends at its last waypoint
  std::size_t last = path_.size() - 1;
  while (last > 0 && path_[last].goal_index > goal_index) --last;
  advance(position, arcs_[last]);
}

void PathProgress::advance(dmrp_vec2 position, double limit_m) {
  if (path_.empty()) return;
  if (limit_m > progress_m_) {
    const double until_m = std::min(limit_m, progress_m_ + search_ahead_m + travelled_m_);
    const double reached_m = toolkit::project(path_, arcs_, position, progress_m_, until_m).arc_m;
    if (reached_m > progress_m_) {
      gained_m_ += reached_m - progress_m_;
      progress_m_ = reached_m;
      travelled_m_ = 0.0;
    }
  }
  while (waypoint_ + 1 < path_.size() && arcs_[waypoint_ + 1] <= progress_m_) ++waypoint_;
}

}  // namespace dmrp::core
