// SPDX-License-Identifier: MIT
#include "core/execution/progress.hpp"

#include <algorithm>
#include <cassert>
#include <dmrp/toolkit/polyline.hpp>
#include <limits>

namespace dmrp::core {
namespace {

// The search window ahead on the path, beyond the distance travelled since the last progress: large enough to follow a
// robot that cuts a corner, too small to skip a detour ahead of it.
constexpr double search_ahead_m = 2.0;

constexpr double return_arc_cells = 1.5;
constexpr double return_cells = 0.7;

}  // namespace

void PathProgress::set_path(std::span<const dmrp_waypoint> path, dmrp_vec2 position) {
  assert(!path.empty());
  path_.assign(path.begin(), path.end());
  toolkit::arc_lengths(path_, arcs_);
  last_position_ = position;
  reached_m_ = toolkit::project(path_, arcs_, position, 0.0, search_ahead_m).arc_m;
  approach_ = 0;
  if (reached_m_ == 0.0 && off_path_m() > 0.0) {
    approach_ = 1;
    path_.insert(path_.begin(), path_.front());
    path_.front().x = position.x;
    path_.front().y = position.y;
    toolkit::arc_lengths(path_, arcs_);
  }
  travelled_m_ = 0.0;
  waypoint_ = 0;
  pass_waypoints();
}

void PathProgress::update(dmrp_vec2 position, std::uint32_t goal_index) {
  if (path_.empty()) return;
  travelled_m_ += toolkit::distance(last_position_, position);
  last_position_ = position;

  // The part of the path to the current goal ends at the goal's last waypoint.
  std::size_t last = path_.size() - 1;
  while (last > 0 && path_[last].goal_index > goal_index) --last;
  advance(arcs_[last]);
}

void PathProgress::advance(double limit_m) {
  if (limit_m <= reached_m_) return;
  double until_m = std::min(limit_m, reached_m_ + search_ahead_m + travelled_m_);
  if (const std::size_t back = first_return(until_m); back < path_.size()) until_m = arcs_[back - 1];
  const double place_m = toolkit::project(path_, arcs_, last_position_, reached_m_, until_m).arc_m;
  if (place_m <= reached_m_) return;
  reached_m_ = place_m;
  travelled_m_ = 0.0;
  pass_waypoints();
}

// Among the waypoints up to until_m along path_; path_.size() if there is none.
std::size_t PathProgress::first_return(double until_m) const {
  const dmrp_vec2 place = toolkit::point_at(path_, arcs_, reached_m_);
  for (std::size_t i = waypoint_ + 1; i < path_.size() && arcs_[i] <= until_m; ++i)
    if (arcs_[i] - reached_m_ > return_arc_cells * cell_m_ &&
        toolkit::distance(toolkit::position(path_[i]), place) < return_cells * cell_m_)
      return i;
  return path_.size();
}

std::uint32_t PathProgress::before_return() const {
  return static_cast<std::uint32_t>(first_return(std::numeric_limits<double>::infinity())) - 1 - approach_;
}

void PathProgress::pass_waypoints() {
  while (waypoint_ + 1 < path_.size() && arcs_[waypoint_ + 1] <= reached_m_) ++waypoint_;
}

double PathProgress::progress_m() const {
  return approach_ == 0 ? reached_m_ : std::max(0.0, reached_m_ - arcs_[approach_]);
}

std::uint32_t PathProgress::waypoint() const {
  return waypoint_ - std::min(waypoint_, approach_);
}

bool PathProgress::has_begun() const {
  return waypoint_ >= approach_;
}

double PathProgress::off_path_m() const {
  return path_.empty() ? 0.0 : toolkit::distance(toolkit::point_at(path_, arcs_, reached_m_), last_position_);
}

}  // namespace dmrp::core
