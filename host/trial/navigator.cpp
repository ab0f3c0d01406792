// SPDX-License-Identifier: MIT
#include "host/trial/navigator.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/polyline.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <utility>

namespace dmrp::host {

namespace {

constexpr std::int64_t made_again_ns = 1'000'000'000;
constexpr double step_m = 0.1;    // between the places of a path that are looked at
constexpr double border_m = 0.3;  // of the costmap, in which no route ends
constexpr double stop_m = 0.1;    // before what stands on the path

}  // namespace

Navigator::Navigator(const VariantWorld& variant, const core::World& world)
    : variant_(variant), world_(world), routes_(world.robots().size()) {
  for (Route& route : routes_) route.progress = core::PathProgress(variant.planning_grid.view().resolution_m);
}

// A robot that is in a place that is not free may leave it.
Navigator::Block Navigator::first_block(const core::RouteMap& map, const std::vector<dmrp_waypoint>& path,
                                        double from_m, double to_m) {
  const std::vector<double> arcs = toolkit::arc_lengths(path);
  to_m = std::min(to_m, arcs.back());
  if (!(arcs.back() > 0.0)) return {};
  double heading = 0.0;
  bool leaves = from_m < to_m && !map.robot_is_free();
  for (double arc_m = from_m;; arc_m = std::min(arc_m + step_m, to_m)) {
    const toolkit::PathPlace place = toolkit::place_at(path, arcs, arc_m);
    const dmrp_vec2 from = toolkit::position(path[place.segment]), to = toolkit::position(path[place.segment + 1]);
    if (from != to) heading = toolkit::bearing(from, to);  // on a wait that of the way to it
    leaves = leaves && !map.is_free(place.point, heading);
    if (!leaves && !map.fits(place.point, heading)) return {true, arc_m};
    if (arc_m >= to_m) return {};
  }
}

// Makes a waypoint with the time that the plan has at that arc length of the base.
dmrp_waypoint Navigator::waypoint_at(const Route& route, dmrp_vec2 point, double base_m) const {
  const toolkit::PathPlace place = toolkit::place_at(route.base, route.base_arcs, base_m);
  const dmrp_waypoint& from = route.base[place.segment];
  const dmrp_waypoint& to = route.base[std::min(place.segment + 1, route.base.size() - 1)];
  const auto leg_ns = static_cast<double>(to.t_ns - from.t_ns);
  return {point.x, point.y, core::free_heading, from.t_ns + std::llround(place.fraction * leg_ns), to.goal_index, 0};
}

std::function<bool(dmrp_vec2)> Navigator::cells_of(const Route& route) const {
  if (variant_.simulation.execution != core::Execution::ordered) return {};
  const toolkit::GridView grid(variant_.planning_grid.view());
  std::vector<std::uint32_t> cells;
  for (const dmrp_waypoint& waypoint : route.base) cells.push_back(grid.index_of(toolkit::position(waypoint)));
  std::sort(cells.begin(), cells.end());
  return [grid, cells = std::move(cells)](dmrp_vec2 point) {
    return std::binary_search(cells.begin(), cells.end(), grid.index_of(point));
  };
}

// The farthest place of the base that the robot sees.
double Navigator::far_m(const Route& route, const Sight& sight) {
  const double end_m = route.base_arcs.back();
  double far_m = sight.base_m;
  while (far_m < end_m) {
    const double next_m = std::min(far_m + step_m, end_m);
    const dmrp_vec2 off = toolkit::point_at(route.base, route.base_arcs, next_m) - sight.here;
    if (std::max(std::abs(off.x), std::abs(off.y)) > sight.reach_m) break;
    far_m = next_m;
  }
  return far_m;
}

// Leads from here to the last free place of the base up to `to_m`, past its first block; false if nothing leads there.
bool Navigator::lead_past(Route& route, const core::RouteMap& map, const Sight& sight, double to_m) const {
  const double base_m = sight.base_m;
  const Block block = first_block(map, route.base, base_m, to_m);
  double rejoin_m = to_m;
  while (rejoin_m > base_m && first_block(map, route.base, rejoin_m, rejoin_m).exists) rejoin_m -= step_m;
  if (rejoin_m <= base_m || (block.exists && rejoin_m < block.arc_m)) return false;
  const auto way = map.way(sight.here, toolkit::point_at(route.base, route.base_arcs, rejoin_m), cells_of(route));
  if (!way) return false;
  const std::vector<double> arcs = toolkit::arc_lengths(*way);
  route.path.clear();
  for (std::size_t i = 0; i < way->size(); ++i) {
    const double share = arcs.back() > 0.0 ? arcs[i] / arcs.back() : 1.0;
    route.path.push_back(waypoint_at(route, (*way)[i], base_m + share * (rejoin_m - base_m)));
  }
  route.rejoins = route.path.size() - 1;
  const auto after = std::upper_bound(route.base_arcs.begin(), route.base_arcs.end(), rejoin_m);
  route.path.insert(route.path.end(), route.base.begin() + (after - route.base_arcs.begin()), route.base.end());
  route.flags = route.base_flags;
  return true;
}

// Ends before that arc length of the base.
void Navigator::stop_before(Route& route, const Sight& sight, double block_m) const {
  const double base_m = sight.base_m, end_m = std::max(base_m, block_m - stop_m);
  const auto first = std::upper_bound(route.base_arcs.begin(), route.base_arcs.end(), base_m);
  const auto last = std::lower_bound(first, route.base_arcs.end(), end_m);
  route.path = {waypoint_at(route, sight.here, base_m)};
  route.path.insert(route.path.end(), route.base.begin() + (first - route.base_arcs.begin()),
                    route.base.begin() + (last - route.base_arcs.begin()));
  route.path.push_back(waypoint_at(route, toolkit::point_at(route.base, route.base_arcs, end_m), end_m));
  route.rejoins = route.path.size() - 1;
  route.flags = route.base_flags | DMRP_PATH_PARTIAL;
}

// Leads past what blocks the base, if a way does. Else the controller keeps the base, which ends early only if something
// stands at its end.
Navigator::Kind Navigator::make(Route& route, const Sight& sight) const {
  const double to_m = far_m(route, sight);
  if (lead_past(route, sight.map, sight, to_m)) return Kind::past;
  const core::RouteMap standing = sight.map.of_what_stands();
  const Block block = first_block(standing, route.base, sight.base_m, to_m);
  if (!block.exists && sight.is_on_base) return Kind::base;
  if (lead_past(route, standing, sight, to_m)) return Kind::past;
  const bool ends_there = to_m == route.base_arcs.back() && first_block(standing, route.base, to_m, to_m).exists;
  if (!block.exists || !ends_there) return Kind::base;
  stop_before(route, sight, block.arc_m);
  return Kind::stop;
}

Navigator::Sight Navigator::look(const Route& route, std::uint32_t robot, double base_m, RobotSensors& sensors) const {
  const dmrp_pose& pose = sensors.odometry().pose();
  const dmrp_vec2 here = toolkit::position(pose);
  const dmrp_vec2 ahead = toolkit::point_at(route.base, route.base_arcs, base_m + 1.0);
  const dmrp_vec2 direction = ahead == here ? toolkit::from_angle(pose.theta) : toolkit::normalized(ahead - here);
  const bool ordered = variant_.simulation.execution == core::Execution::ordered;
  const core::RouteMap map({sensors.costmap(), sensors.agents(), pose, direction, ordered},
                           world_.robot_settings(robot));
  const double off_m = toolkit::distance(here, toolkit::point_at(route.base, route.base_arcs, base_m));
  return {map, here, base_m, map.reach_m() - border_m, off_m < variant_.planning_grid.view().resolution_m};
}

// Chooses what the controller is to have; whether `path` was made for it.
bool Navigator::decide(Route& route, const Sight& sight, bool base_is_new) const {
  const double base_m = sight.base_m, led_m = route.progress.progress_m();
  if (sight.is_on_base && !first_block(sight.map, route.base, base_m, base_m + sight.reach_m).exists) {
    route.kind = Kind::base;
    route.was_blocked = false;
    return false;
  }
  const bool is_blocked =
      route.kind == Kind::base || first_block(sight.map, route.path, led_m, led_m + sight.reach_m).exists;
  const bool leads_past = route.kind == Kind::past && !is_blocked && route.progress.waypoint() < route.rejoins;
  const bool is_due = world_.t_ns() >= route.made_ns + made_again_ns && !leads_past;
  const bool was_blocked = std::exchange(route.was_blocked, is_blocked);
  const bool became_blocked = is_blocked && !was_blocked;
  if (!became_blocked && !base_is_new && !is_due) return false;
  route.kind = make(route, sight);
  route.made_ns = world_.t_ns();
  return route.kind != Kind::base;
}

Navigator::Rerouted Navigator::reroute(std::uint32_t robot, const Guidance& guidance, const PathUpdate& handed,
                                       RobotSensors& sensors) {
  Route& route = routes_[robot];
  const bool base_is_new = !handed.waypoints.empty();
  if (base_is_new) {
    route.base.assign(handed.waypoints.begin(), handed.waypoints.end());
    toolkit::arc_lengths(route.base, route.base_arcs);
    route.base_flags = handed.flags;
  }
  if (route.base.empty()) return {guidance, handed, false};

  const core::RobotState& state = world_.robots()[robot];
  const dmrp_vec2 position = toolkit::position(state.pose);
  const bool had_base = route.kind == Kind::base;
  if (!had_base) route.progress.update(position, state.goal_index);
  const bool is_made = decide(route, look(route, robot, guidance.progress_m, sensors), base_is_new);
  if (route.kind == Kind::base) {
    if (had_base) return {guidance, handed, false};
    return {guidance, {route.base, route.base_flags, 0}, false};
  }
  if (is_made) route.progress.set_path(route.path, position);
  const Guidance along = {guidance.goal, route.progress.progress_m(), route.progress.waypoint()};
  return {along, is_made ? PathUpdate{route.path, route.flags, 0} : PathUpdate{}, is_made};
}

}  // namespace dmrp::host
