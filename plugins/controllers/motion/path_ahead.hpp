// SPDX-License-Identifier: MIT
// path_ahead.hpp: the part of the path that a local planner works on, and the pose it plans to.
#ifndef DMRP_CONTROLLERS_MOTION_PATH_AHEAD_HPP
#define DMRP_CONTROLLERS_MOTION_PATH_AHEAD_HPP

#include <vector>

#include "controllers/motion/footprint_check.hpp"
#include "controllers/motion/path_tracker.hpp"

namespace dmrp::controllers {

// From the robot's place on the path to a look-ahead along it, cut where it leaves the costmap's window and at the
// tracker's stop point. What teb_local_planner and mpc_local_planner call the transformed plan and the local goal.
class PathAhead {
 public:
  // `look_ahead_m` is measured along the path; the window's outer `window_margin_m` counts as outside. After the
  // tracker's update().
  void look(const PathTracker& tracker, const Observation& now, const CostmapView& map, double look_ahead_m,
            double window_margin_m = 0.4);

  // Where the robot could not stand at the goal (somebody is there): takes the last point before that where it could.
  // False where there is none; the goal stays then.
  bool retreat(FootprintCheck& footprint);

  // Points `spacing_m` apart along the path, the last two less; the first is the robot's place on it, the last the
  // goal's.
  static constexpr double spacing_m = 0.1;
  const std::vector<Vec2>& points() const { return points_; }

  // The last point. Its heading: the one asked for where the goal has one and ends_at_stop(), else the path's
  // direction there.
  const Pose& goal() const { return goal_; }
  bool ends_at_stop() const { return ends_at_stop_; }  // the robot comes to rest there
  bool has_heading() const { return has_heading_; }    // the goal's heading was asked for

 private:
  std::vector<Vec2> points_;
  Pose goal_ = {0.0, 0.0, 0.0};
  bool ends_at_stop_ = false;
  bool has_heading_ = false;
};

}  // namespace dmrp::controllers

#endif
