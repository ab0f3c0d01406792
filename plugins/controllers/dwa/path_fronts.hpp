// SPDX-License-Identifier: MIT
// path_fronts.hpp: the wave-fronts of one control cycle: from the path in the window, from the local goal, and from a
// point in front of the local goal.
#pragma once

#include <vector>

#include "controllers/dwa/wave_front.hpp"
#include "controllers/motion/path_tracker.hpp"

namespace dmrp::controllers::dwa {

struct FrontSettings {
  double needed_m = 0.0;           // clearance that the robot's centre needs
  double look_ahead_m = 0.0;       // length of the path considered
  double nose_m = 0.0;             // from the robot's centre to its nose
  bool ends_at_inversion = false;  // the path considered ends where it turns back
  bool returns_to_path = false;    // a path outside the window is considered from the robot's position on
  bool extends_path = true;        // straight on beyond its end, by the nose's length
  bool leans_into_gaps = false;    // where the way past an obstacle is too narrow: over all cells but occupied ones
  bool stands = false;             // the robot stands
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
  bool leans = false;    // the way there leads through a gap that is too narrow
  double front_length_m = 0.0;  // from `at` to the seed of nose()
};

// Reuses its buffers from cycle to cycle, and remembers whether it passes an obstacle.
class PathFronts {
 public:
  void start();

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

  LocalGoal spread_fronts(const PathTracker& tracker, Vec2 robot, double heading, const CostmapView& map,
                          const FrontSettings& settings);
  std::int32_t home_of(const CostmapView& map, Vec2 robot) const;
  bool is_cut_off(std::int32_t home);
  void request(const CostmapView& map, Vec2 robot, const std::array<Box, 2>& boxes);
  void lay_out_plan(const PathTracker& tracker, Vec2 robot, const CostmapView& map, const FrontSettings& settings,
                    bool beyond = false);
  void end_on_free_cell();
  void end_on_the_right(const CostmapView& map);
  void end_at_inversion();
  void lay_out_return(Vec2 from, Vec2 to, const CostmapView& map);
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

  // The goal lies behind the obstacle on the path: since the robot leaned or stood before it, until the path is free.
  // Of two robots head-on, one sees a way as soon as the other has leaned. Without memory, that one's goal would be the
  // last free point before the other, and there it would stand in the middle.
  bool passes_ = false;
};

}  // namespace dmrp::controllers::dwa
