// SPDX-License-Identifier: MIT
// detour.hpp: a way around an obstacle on the path, kept until the robot has driven it.
#pragma once

#include <cassert>
#include <dmrp/cpp/local_controller.hpp>
#include <vector>

#include "controllers/motion/guide.hpp"

namespace dmrp::controllers {

// The costmap's window moves with the robot. A robot that has to leave a dead end loses sight of the path beyond it;
// planning anew to the last point of the path that is left in its window, it would turn back into the dead end. So the
// way that it has found is kept, and counts as its path as long as it leads farther than the path in the window.
class Detour {
 public:
  Detour();

  void clear() { points_.clear(); }

  // Keeps a way of at least two points from the robot to the path's point at this arc length.
  void keep(const std::vector<Vec2>& way, double end_m);

  // Once per control period: forgets the way if the robot is about to reach its end, has strayed from it, or has got so
  // far along its path.
  void update(Vec2 robot, double path_progress_m);

  bool is_kept() const { return !points_.empty(); }

  // Where the robot sees more of an obstacle, the way may turn out blocked. Joins it farther on by the guide, which has
  // searched from the robot on this map; false if it reaches no place near the way.
  bool mend(const Guide& guide, const CostmapView& map);

  // Whether a way is kept that leads farther along the path than to this arc length.
  bool leads_beyond(double arc_m) const;

  // The rest of the way, from the place nearest to the robot on, if one is kept.
  double remaining_m() const {
    assert(is_kept());
    return arcs_.back() - progress_m_;
  }
  Vec2 point_ahead(double distance_m) const;  // the end if the distance is greater than what remains

  // The arc length of the path where the way ends.
  double end_m() const { return end_m_; }

 private:
  std::vector<Vec2> points_;  // empty: none is kept
  std::vector<double> arcs_;
  std::vector<Vec2> mended_;
  double progress_m_ = 0.0;  // on the way
  double end_m_ = 0.0;
};

}  // namespace dmrp::controllers
