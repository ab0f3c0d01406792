// SPDX-License-Identifier: MIT
// path_ahead.hpp: the part of the path that a local planner works on, and its local goal.
#pragma once

#include <vector>

#include "controllers/motion/costmap_view.hpp"
#include "controllers/motion/path_tracker.hpp"

namespace dmrp::controllers {

// The path from the robot's position on it up to a look-ahead distance, clipped to the costmap's window and to the
// tracker's stop point. teb_local_planner and mpc_local_planner call these the transformed plan and the local goal.
class PathAhead {
 public:
  // `look_ahead_m` is measured along the path; the outermost `window_margin_m` of the window counts as outside. After
  // the tracker's update().
  void look(const PathTracker& tracker, const Observation& now, const CostmapView& map, double look_ahead_m,
            double window_margin_m = 0.4);

  // Points `spacing_m` apart along the path, from the robot's position on the path to the goal; the last interval may
  // be shorter.
  static constexpr double spacing_m = 0.1;
  const std::vector<Vec2>& points() const { return points_; }

  // The last point, with the stop point's heading if has_heading(), otherwise the path's direction there.
  const Pose& goal() const { return goal_; }
  bool ends_at_stop() const { return ends_at_stop_; }  // the robot has to stop there
  bool has_heading() const { return has_heading_; }    // ends_at_stop(), and the stop point has a heading

 private:
  std::vector<Vec2> points_;
  Pose goal_ = {0.0, 0.0, 0.0};
  bool ends_at_stop_ = false;
  bool has_heading_ = false;
};

}  // namespace dmrp::controllers
