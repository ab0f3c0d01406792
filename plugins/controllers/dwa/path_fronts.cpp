// SPDX-License-Identifier: MIT
#include "controllers/dwa/path_fronts.hpp"

#include <algorithm>
#include <dmrp/toolkit/vec2.hpp>

#include "controllers/dwa/critics.hpp"

namespace dmrp::controllers::dwa {

namespace {

// Enough for a straight path across a window of usual size; more points cost an allocation.
constexpr std::size_t most_plan_points = 1024;

// The path turns back where it comes nearer to the place reached by more than this. (inversion_xy_tolerance in nav2)
constexpr double inversion_tolerance_m = 0.2;

// The goal behind an obstacle lies this far to the right of the path.
constexpr double keep_right_m = 0.2;

}  // namespace

void PathFronts::start() {
  plan_.reserve(most_plan_points);
  passes_ = false;
}

LocalGoal PathFronts::spread(const PathTracker& tracker, Vec2 robot, double heading, const CostmapView& map,
                             const std::array<Box, 2>& boxes, const FrontSettings& settings) {
  const std::uint8_t highest_free = map.highest_cost_at(settings.needed_m);
  const auto spread_all = [&] {
    request(map, robot, boxes);
    return spread_fronts(tracker, robot, heading, map, settings);
  };
  terrain_.read(map, highest_free);
  lay_out_plan(tracker, robot, map, settings);
  const bool ends_on_obstacle = !plan_.empty() && !terrain_.is_free(plan_.back().index);
  const bool looks_beyond = settings.leans_into_gaps && ends_on_obstacle;
  passes_ = looks_beyond && (passes_ || settings.stands);
  if (looks_beyond) lay_out_plan(tracker, robot, map, settings, true);
  if (!looks_beyond || !is_cut_off(home_of(map, robot))) {
    if (passes_)
      end_on_the_right(map);
    else if (looks_beyond)
      lay_out_plan(tracker, robot, map, settings);
    const LocalGoal goal = spread_all();
    if (looks_beyond || !settings.leans_into_gaps || !goal.is_cut) return goal;
  }
  passes_ = looks_beyond;
  end_on_free_cell();
  end_on_the_right(map);
  terrain_.read(map, DMRP_COST_LETHAL - 1);
  LocalGoal goal = spread_all();
  goal.leans = true;
  if (!goal.is_cut) return goal;
  terrain_.read(map, highest_free);
  lay_out_plan(tracker, robot, map, settings);
  return spread_all();
}

// The free cell nearest to the robot; -1 if none is near.
std::int32_t PathFronts::home_of(const CostmapView& map, Vec2 robot) const {
  return terrain_.nearest_free(terrain_.index_of(map, robot), escape_reach_cells);
}

// Whether obstacles separate `home` from the plan's last free point. Before anything is requested: the search then ends
// at `home`, which is a fraction of what a front costs.
bool PathFronts::is_cut_off(std::int32_t home) {
  const auto last = std::find_if(plan_.rbegin(), plan_.rend(),
                                 [this](const PlanPoint& point) { return terrain_.is_free(point.index); });
  if (last == plan_.rend()) return true;
  if (home < 0) return false;
  terrain_.request(home);
  goal_.begin(terrain_);
  goal_.seed(last->index);
  goal_.spread();
  return !goal_.reached(home);
}

// All fronts over the terrain, from the plan.
LocalGoal PathFronts::spread_fronts(const PathTracker& tracker, Vec2 robot, double heading, const CostmapView& map,
                                    const FrontSettings& settings) {
  const std::int32_t home = home_of(map, robot);
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

// The path ahead in the window, in steps of half a cell. If it ends on an obstacle, `beyond`: to the first free point
// behind that, if the window holds one.
void PathFronts::lay_out_plan(const PathTracker& tracker, Vec2 robot, const CostmapView& map,
                              const FrontSettings& settings, bool beyond) {
  plan_.clear();
  const double step_m = 0.5 * map.resolution_m();
  const double remaining_m = tracker.remaining_m();
  const double ahead_m = std::min(settings.look_ahead_m, remaining_m);
  const int steps = static_cast<int>(ahead_m / step_m);
  const auto add = [&](double at_m) {
    const Vec2 at = tracker.point_at(tracker.progress_m() + at_m);
    const std::int32_t index = terrain_.index_of(map, at);
    if (index >= 0) plan_.push_back({at, index});
    return index >= 0;
  };
  for (int i = 0; i <= steps + 1; ++i)
    if (!add(std::min(i * step_m, ahead_m))) break;  // outside the window
  const std::size_t looked = plan_.size();
  for (double at_m = ahead_m + step_m; beyond && !terrain_.is_free(plan_.back().index); at_m += step_m) {
    if (at_m <= remaining_m && add(at_m)) continue;
    plan_.resize(looked);
    break;
  }
  if (settings.ends_at_inversion) end_at_inversion();
  if (settings.returns_to_path && plan_.empty()) lay_out_return(robot, tracker.point_at(tracker.progress_m()), map);
}

void PathFronts::end_on_free_cell() {
  while (!plan_.empty() && !terrain_.is_free(plan_.back().index)) plan_.pop_back();
}

// Moves the plan's end to the right, as far as that is free. Of two sides about equally wide, the robot then passes on
// the right one, which for two robots head-on are different sides. By the shorter way alone, both choose the side that
// is wider for both, and stand.
void PathFronts::end_on_the_right(const CostmapView& map) {
  if (plan_.size() < 2) return;
  const double step_m = 0.5 * map.resolution_m();
  const Vec2 end = plan_.back().at;
  const Vec2 left = toolkit::perpendicular(toolkit::normalized(end - plan_[plan_.size() - 2].at));
  const int steps = static_cast<int>(keep_right_m / step_m);
  for (int i = 1; i <= steps; ++i) {
    const Vec2 at = end - (i * step_m) * left;
    const std::int32_t index = terrain_.index_of(map, at);
    if (!terrain_.is_free(index)) return;
    plan_.back() = {at, index};
  }
}

// Ends the plan at its farthest point if it turns back there. Otherwise the local goal of an out-and-back path lies
// where the robot already is, and the robot stays.
void PathFronts::end_at_inversion() {
  std::size_t farthest = 0;
  double farthest_m = 0.0;
  for (std::size_t i = 1; i < plan_.size(); ++i) {
    const double distance_m = toolkit::distance(plan_[0].at, plan_[i].at);
    if (distance_m > farthest_m) {
      farthest = i;
      farthest_m = distance_m;
    } else if (distance_m < farthest_m - inversion_tolerance_m) {
      plan_.resize(farthest + 1);
      return;
    }
  }
}

// The straight line to the path, as far as it is in the window: for a robot that a detour has led so far from its path
// that the window holds none of it.
void PathFronts::lay_out_return(Vec2 from, Vec2 to, const CostmapView& map) {
  const double step_m = 0.5 * map.resolution_m();
  const Vec2 step = step_m * toolkit::normalized(to - from);
  const int steps = static_cast<int>(toolkit::distance(from, to) / step_m);
  for (int i = 0; i <= steps; ++i) {
    const Vec2 at = from + i * step;
    const std::int32_t index = terrain_.index_of(map, at);
    if (index < 0) return;
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
