// SPDX-License-Identifier: MIT
#include "dwa.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers {

namespace {

// Turning in place begins when the way out is further aside than the first, and ends below the second.
constexpr double turn_begin_rad = 0.5;
constexpr double turn_back_rad = 1.8;
constexpr double turn_end_rad = 0.2;

// How far along the goal's front the direction of the way out is taken.
constexpr double way_out_m = 0.5;

}  // namespace

Descriptor Dwa::describe() {
  return Descriptor("dmrp.controller.dwa", "Dynamic window approach", "1.0.0")
      .vendor("dmrp")
      .license("MIT")
      .summary("tries the velocities within reach on the costmap and takes the arc that scores best")
      .source(
          "Fox, Burgard, Thrun: The dynamic window approach to collision avoidance, IEEE Robotics & Automation "
          "Magazine 4 (1997); critics as in ROS's dwa_local_planner")
      .needs(DMRP_EXT_LOCAL_COSTMAP);
}

Status Dwa::start(const World&, std::uint64_t) {
  costmap_ = extension<dmrp_local_costmap>(DMRP_EXT_LOCAL_COSTMAP);
  if (!costmap_) {
    set_error("the host has no " DMRP_EXT_LOCAL_COSTMAP);
    return Status::error;
  }
  tuning_ = {sim_time,      sim_granularity, angular_sim_granularity, path_distance_bias, goal_distance_bias,
             occdist_scale, twirling_scale,  forward_point_distance,  scaling_speed,      max_scaling_factor};
  tracker_.clear();
  at_goal_.reset();
  oscillation_.reset();
  turning_ = false;
  return Status::ok;
}

void Dwa::set_path(Path path, std::uint64_t) {
  tracker_.set_path(path);
}

Status Dwa::step(const Observation& now, Command& command) {
  command = braking(now);
  tracker_.update(now);
  if (tracker_.empty()) return Status::ok;
  const CostmapView map(*costmap_->costmap(costmap_));
  FootprintCheck footprint(map, now.footprint, footprint_padding, now.pose);
  if (at_goal_.reached(tracker_.stop(), now)) {
    command = at_goal_.command(tracker_.stop(), now);
    return Status::ok;
  }

  terrain_.read(map, map.highest_cost_at(now.footprint.inscribed_radius_m + footprint_padding));
  lay_out_plan(map);
  spread_fronts(now, map);
  const double aside = way_out(map, now.pose);
  if (std::abs(aside) > turn_back_rad && std::abs(now.velocity.v_x) < 0.1) turning_ = true;
  if (turning_ && std::abs(aside) > turn_end_rad) {
    command = turn_toward(aside, now, footprint);
    return Status::ok;
  }
  turning_ = false;

  oscillation_.release(now.pose, oscillation_reset_dist, oscillation_reset_angle);
  window_.sample(now, static_cast<std::size_t>(*vx_samples), static_cast<std::size_t>(*vth_samples));
  const bool align = toolkit::distance(toolkit::position(now.pose), goal_) > forward_point_distance;
  // a path is not replanned about people: round something that stands on it, the goal critics lead alone
  const bool follow =
      std::all_of(plan_.begin(), plan_.end(), [this](const PlanPoint& point) { return terrain_.is_free(point.index); });
  const dwa::Scene scene = {now.pose,    now.limits.v_max, map,    terrain_, path_front_,
                            goal_front_, nose_front_,      follow, align,    oscillation_};
  const std::optional<dwa::Sample> choice = dwa::cheapest(window_, scene, tuning_, footprint);
  if (!choice) {
    set_error("every arc within reach runs into an obstacle");
    return Status::no_solution;
  }
  oscillation_.note(now.pose, choice->v, choice->omega);
  // where standing is best although the way leads aside, turning in place comes first
  if (choice->v == 0.0 && std::abs(choice->omega) < 0.1 && std::abs(aside) > turn_begin_rad) {
    turning_ = true;
    command = turn_toward(aside, now, footprint);
    return Status::ok;
  }
  command.v_x = choice->v;
  command.omega = choice->omega;
  return Status::ok;
}

// The path ahead in the window, in steps of half a cell.
void Dwa::lay_out_plan(const CostmapView& map) {
  plan_.clear();
  const double step_m = 0.5 * map.resolution_m();
  const double ahead_m = std::min<double>(max_global_plan_lookahead_dist, tracker_.remaining_m());
  const int steps = static_cast<int>(ahead_m / step_m);
  for (int i = 0; i <= steps + 1; ++i) {
    const Vec2 at = tracker_.point_at(tracker_.progress_m() + std::min(i * step_m, ahead_m));
    const std::int32_t index = terrain_.index_of(map, at.x, at.y);
    if (index < 0) break;  // out of the window
    plan_.push_back({at, index});
  }
}

void Dwa::spread_fronts(const Observation& now, const CostmapView& map) {
  const std::int32_t here = terrain_.index_of(map, now.pose.x, now.pose.y);
  const std::int32_t home = terrain_.nearest_free(here, dwa::escape_reach_cells);

  path_front_.begin(terrain_);
  for (const PlanPoint& point : plan_)
    if (terrain_.is_free(point.index)) path_front_.seed(point.index);
  path_front_.spread();
  // cut off from all of the path: stay about here
  if (home >= 0 && !path_front_.reached(home)) {
    path_front_.seed(home);
    path_front_.spread();
  }

  goal_ = toolkit::position(now.pose);
  const std::int32_t goal = choose_goal(home);
  nose_front_.begin(terrain_);
  if (goal < 0) return;
  const std::int32_t nose = point_in_front(map, toolkit::position(now.pose), goal_, now.pose.theta);
  nose_front_.seed(nose < 0 ? goal : nose);
  nose_front_.spread();
}

// The last point of the plan that the robot can get to; its own place where there is none. Leaves the front spread
// from it.
std::int32_t Dwa::choose_goal(std::int32_t home) {
  const auto spread_from = [this](std::int32_t index) {
    goal_front_.begin(terrain_);
    if (index < 0) return;
    goal_front_.seed(index);
    goal_front_.spread();
  };
  const auto last = std::find_if(plan_.rbegin(), plan_.rend(),
                                 [this](const PlanPoint& point) { return terrain_.is_free(point.index); });
  if (last != plan_.rend()) {
    goal_ = last->at;
    spread_from(last->index);
    if (home < 0 || goal_front_.reached(home)) return last->index;
  }
  // something stands across the whole way: as near as the path leads to it
  spread_from(home);
  const auto nearest = std::find_if(plan_.rbegin(), plan_.rend(),
                                    [this](const PlanPoint& point) { return goal_front_.reached(point.index); });
  if (nearest == plan_.rend()) return home;
  goal_ = nearest->at;
  spread_from(nearest->index);
  return nearest->index;
}

// Beyond the goal by the nose's length, as far as that is free.
std::int32_t Dwa::point_in_front(const CostmapView& map, Vec2 from, Vec2 goal, double fallback_heading) const {
  const double step_m = 0.5 * map.resolution_m();
  Vec2 direction = toolkit::normalized(goal - from);
  if (direction == Vec2{0.0, 0.0}) direction = toolkit::from_angle(fallback_heading);
  std::int32_t front = -1;
  const int steps = static_cast<int>(forward_point_distance / step_m);
  for (int i = 0; i <= steps; ++i) {
    const Vec2 point = goal + (i * step_m) * direction;
    const std::int32_t index = terrain_.index_of(map, point.x, point.y);
    if (!terrain_.is_free(index)) break;
    front = index;
  }
  return front;
}

// How far to turn toward where the goal's front falls from here; 0 where it does not.
double Dwa::way_out(const CostmapView& map, const Pose& from) const {
  std::int32_t index = terrain_.nearest_free(terrain_.index_of(map, from.x, from.y), dwa::escape_reach_cells);
  if (!goal_front_.reached(index) || goal_front_.cells(index) == 0) return 0.0;
  const std::int32_t start = index;
  const std::int32_t stride = terrain_.stride();
  const int steps = static_cast<int>(way_out_m / map.resolution_m());
  for (int i = 0; i < steps && goal_front_.cells(index) > 0; ++i) {
    // of the neighbours nearer to the goal, the one nearest to the path
    std::int32_t next = index;
    for (const std::int32_t offset : {1, -1, stride, -stride}) {
      const std::int32_t neighbour = index + offset;
      if (goal_front_.cells(neighbour) >= goal_front_.cells(index)) continue;
      if (next == index || path_front_.cells(neighbour) < path_front_.cells(next)) next = neighbour;
    }
    index = next;
  }
  const int columns = index % stride - start % stride;
  const int rows = index / stride - start / stride;
  return toolkit::difference(from.theta, std::atan2(rows, columns));
}

Command Dwa::turn_toward(double angle, const Observation& now, FootprintCheck& footprint) const {
  Command command = braking(now);
  const double omega = turning_rate(angle, now);
  footprint.scale(1.0);
  const int steps = dwa::simulation_steps({0.0, omega}, tuning_);
  if (footprint.arc_cost(now.pose, 0.0, omega, tuning_.sim_time, steps) != in_collision) command.omega = omega;
  return command;
}

}  // namespace dmrp::controllers
