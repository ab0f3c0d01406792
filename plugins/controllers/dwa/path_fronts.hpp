// SPDX-License-Identifier: MIT
// path_fronts.hpp: the wave-fronts of one control cycle: from the path in the window, from the local goal, and from a
// point in front of the local goal.
#pragma once

#include <vector>

#include "controllers/dwa/wave_front.hpp"
#include "controllers/motion/path_tracker.hpp"

namespace dmrp::controllers::dwa {

struct FrontSettings {
  double needed_m = 0.0;      // clearance that the robot's centre needs
  double look_ahead_m = 0.0;  // length of the path considered
  double nose_m = 0.0;        // from the robot's centre to its nose
  bool extends_path = true;   // straight on beyond its end, by the nose's length
};

// An axis-aligned rectangle.
struct Box {
  Vec2 lower = {1e300, 1e300};
  Vec2 upper = {-1e300, -1e300};

  void add(Vec2 point) {
    lower = {std::min(lower.x, point.x), std::min(lower.y, point.y)};
    upper = {std::max(upper.x, point.x), std::max(upper.y, point.y)};
  }
};

// Where the robot goes in this cycle.
struct LocalGoal {
  Vec2 at = {0.0, 0.0};  // the last point of the path in the window that the robot can reach; its position if none
  bool is_cut = false;   // obstacles separate the robot from the path's end in the window
  double front_length_m = 0.0;  // from `at` to the seed of nose()
};

// Reuses its buffers from cycle to cycle.
class PathFronts {
 public:
  // Computes the fronts at least for the cells of `boxes` and those about the robot.
  LocalGoal spread(const PathTracker& tracker, Vec2 robot, double heading, const CostmapView& map,
                   const std::array<Box, 2>& boxes, const FrontSettings& settings);

  const Terrain& terrain() const { return terrain_; }
  const WaveFront& path() const { return path_; }
  const WaveFront& goal() const { return goal_; }
  const WaveFront& nose() const { return nose_; }

 private:
  struct PlanPoint {
    Vec2 at;
    std::int32_t index;  // on the terrain
  };

  void request(const CostmapView& map, Vec2 robot, const std::array<Box, 2>& boxes);
  void lay_out_plan(const PathTracker& tracker, const CostmapView& map, double look_ahead_m);
  void spread_path(const PathTracker& tracker, const CostmapView& map, std::int32_t home,
                   const FrontSettings& settings);
  void seed_beyond_end(const PathTracker& tracker, const CostmapView& map, double nose_m);
  void spread_goal(std::int32_t index, bool everywhere = false);
  std::int32_t choose_goal(std::int32_t home, LocalGoal& goal);
  void spread_nose(const CostmapView& map, Vec2 robot, double heading, std::int32_t goal_index, double nose_m,
                   LocalGoal& goal);

  Terrain terrain_;
  WaveFront path_;
  WaveFront goal_;
  WaveFront nose_;
  std::vector<PlanPoint> plan_;  // the path in the window
};

}  // namespace dmrp::controllers::dwa
