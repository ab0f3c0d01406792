// SPDX-License-Identifier: MIT
#include "controllers/dwa/path_fronts.hpp"

#include <algorithm>
#include <dmrp/toolkit/vec2.hpp>

#include "controllers/dwa/critics.hpp"

namespace dmrp::controllers::dwa {

LocalGoal PathFronts::spread(const PathTracker& tracker, Vec2 robot, double heading, const CostmapView& map,
                             const std::array<Box, 2>& boxes, const FrontSettings& settings) {
  terrain_.read(map, map.highest_cost_at(settings.needed_m));
  lay_out_plan(tracker, map, settings.look_ahead_m);
  request(map, robot, boxes);
  const std::int32_t home = terrain_.nearest_free(terrain_.index_of(map, robot), escape_reach_cells);  // -1: none
  spread_path(tracker, map, home, settings);
  LocalGoal goal;
  goal.at = robot;
  const std::int32_t goal_index = choose_goal(home, goal);
  spread_nose(map, robot, heading, goal_index, settings.nose_m, goal);
  return goal;
}

void PathFronts::request(const CostmapView& map, Vec2 robot, const std::array<Box, 2>& boxes) {
  const bool is_free = terrain_.is_free(terrain_.index_of(map, robot));
  const std::int32_t margin = is_free ? 1 : escape_reach_cells + 1;
  for (const Box& box : boxes)
    terrain_.request(map.column_of(box.lower.x) - margin, map.column_of(box.upper.x) + margin,
                     map.row_of(box.lower.y) - margin, map.row_of(box.upper.y) + margin);
}

// The path ahead in the window, in steps of half a cell.
void PathFronts::lay_out_plan(const PathTracker& tracker, const CostmapView& map, double look_ahead_m) {
  plan_.clear();
  const double step_m = 0.5 * map.resolution_m();
  const double ahead_m = std::min(look_ahead_m, tracker.remaining_m());
  const int steps = static_cast<int>(ahead_m / step_m);
  for (int i = 0; i <= steps + 1; ++i) {
    const Vec2 at = tracker.point_at(tracker.progress_m() + std::min(i * step_m, ahead_m));
    const std::int32_t index = terrain_.index_of(map, at);
    if (index < 0) return;  // outside the window
    plan_.push_back({at, index});
  }
}

void PathFronts::spread_path(const PathTracker& tracker, const CostmapView& map, std::int32_t home,
                             const FrontSettings& settings) {
  path_.begin(terrain_);
  for (const PlanPoint& point : plan_) path_.seed(point.index);
  if (settings.extends_path && tracker.remaining_m() <= settings.look_ahead_m)
    seed_beyond_end(tracker, map, settings.nose_m);
  path_.spread();
  // cut off from the whole path: the robot stays about its position
  if (home >= 0 && !path_.reached(home)) {
    path_.seed(home);
    path_.spread();
  }
}

// Extends the path straight on by the nose's length, as far as that is free. The nose reaches the path's end before the
// robot does; without the extension the alignment critic would stop the robot short of its goal.
void PathFronts::seed_beyond_end(const PathTracker& tracker, const CostmapView& map, double nose_m) {
  const Vec2 end = tracker.point_at(tracker.end_m());
  const Vec2 onward = toolkit::from_angle(tracker.heading_at(tracker.end_m(), 0.0));
  const double step_m = 0.5 * map.resolution_m();
  for (double beyond_m = step_m; beyond_m <= nose_m; beyond_m += step_m) {
    const std::int32_t index = terrain_.index_of(map, end + beyond_m * onward);
    if (!terrain_.is_free(index)) return;
    path_.seed(index);
  }
}

void PathFronts::spread_goal(std::int32_t index, bool everywhere) {
  goal_.begin(terrain_, everywhere);
  if (index < 0) return;
  goal_.seed(index);
  goal_.spread();
}

// The last point of the plan that the robot can reach, or its own position; spreads the goal's front from it.
std::int32_t PathFronts::choose_goal(std::int32_t home, LocalGoal& goal) {
  const auto last = std::find_if(plan_.rbegin(), plan_.rend(),
                                 [this](const PlanPoint& point) { return terrain_.is_free(point.index); });
  if (last != plan_.rend()) {
    goal.at = last->at;
    spread_goal(last->index);
    if (home < 0 || goal_.reached(home)) return last->index;
  }
  // cut off from the path's end: the last point that a front from the robot reaches
  goal.is_cut = true;
  spread_goal(home, true);
  const auto nearest =
      std::find_if(plan_.rbegin(), plan_.rend(), [this](const PlanPoint& point) { return goal_.reached(point.index); });
  if (nearest == plan_.rend()) return home;
  goal.at = nearest->at;
  spread_goal(nearest->index);
  return nearest->index;
}

// From a point beyond the goal by the nose's length, or less if there is less free space.
void PathFronts::spread_nose(const CostmapView& map, Vec2 robot, double heading, std::int32_t goal_index, double nose_m,
                             LocalGoal& goal) {
  nose_.begin(terrain_);
  if (goal_index < 0) return;
  const double step_m = 0.5 * map.resolution_m();
  Vec2 direction = toolkit::normalized(goal.at - robot);
  if (direction == Vec2{0.0, 0.0}) direction = toolkit::from_angle(heading);
  std::int32_t front = goal_index;
  const int steps = static_cast<int>(nose_m / step_m);
  for (int i = 0; i <= steps; ++i) {
    const std::int32_t index = terrain_.index_of(map, goal.at + (i * step_m) * direction);
    if (!terrain_.is_free(index)) break;
    front = index;
    goal.front_length_m = i * step_m;
  }
  nose_.seed(front);
  nose_.spread();
}

}  // namespace dmrp::controllers::dwa
