// SPDX-License-Identifier: MIT
// navigator.hpp: leads the paths that controllers get around what stands on them.
//
// nav2's planner server does so once a second for its controllers (Macenski, Martin, White, Gines Clavero: The Marathon 2,
// IROS 2020). A navigator leads within the costmap only; beyond it the plan holds.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/execution/progress.hpp"
#include "core/execution/route_map.hpp"
#include "core/world/world.hpp"
#include "host/trial/dispatcher.hpp"
#include "host/trial/robot_sensors.hpp"

namespace dmrp::host {

// The local routes of all robots in a trial, for [navigation] route = "around".
//
// A route is the path that the dispatcher hands over, as long as nothing stands on it (route_map.hpp) and the robot is on
// it. Otherwise it begins at the robot, leads past what stands there to the farthest free place of the path in the
// costmap, and goes on along the path. Where the path ends in what stands there, the route ends before it; where nothing
// leads past, the path stays. A route is made when what the controller has becomes blocked, when the dispatcher's path
// changes, and once a second until it leads past.
//
// A route stays in the planning grid's cells that the path passes, and robots are no obstacles, where execution is
// "ordered": their order holds.
class Navigator {
 public:
  // Both arguments outlive it.
  Navigator(const VariantWorld& variant, const core::World& world);

  struct Rerouted {
    Guidance guidance;
    PathUpdate path;       // that the controller gets now; valid until the next call for this robot
    bool is_anew = false;  // a route was made that is not the dispatcher's path
  };

  // What the controller gets in place of what the dispatcher gives; at every control tick of the robot.
  Rerouted reroute(std::uint32_t robot, const Guidance& guidance, const PathUpdate& handed, RobotSensors& sensors);

 private:
  // What the controller has: the dispatcher's path, a way past something, or a way up to it.
  enum class Kind { base, past, stop };

  struct Route {
    std::vector<dmrp_waypoint> base;  // the dispatcher's path
    std::vector<double> base_arcs;
    std::uint32_t base_flags = 0;
    Kind kind = Kind::base;
    std::vector<dmrp_waypoint> path;  // that the controller has in its place
    std::uint32_t flags = 0;
    core::PathProgress progress;  // along it
    std::size_t rejoins = 0;      // its waypoint from which on it is the base
    bool was_blocked = false;     // what the controller has, at the tick before
    std::int64_t made_ns = 0;     // the time
  };

  // The robot and what it sees at this control tick.
  struct Sight {
    core::RouteMap map;
    dmrp_vec2 here;
    double base_m;    // its place on the base, along it
    double reach_m;   // in which it looks at paths
    bool is_on_base;  // to within a cell
  };

  // Whether a part of a path is not free, and where that begins.
  struct Block {
    bool exists = false;
    double arc_m = 0.0;
  };

  static Block first_block(const core::RouteMap& map, const std::vector<dmrp_waypoint>& path, double from_m,
                           double to_m);
  static double far_m(const Route& route, const Sight& sight);
  Sight look(const Route& route, std::uint32_t robot, double base_m, RobotSensors& sensors) const;
  bool decide(Route& route, const Sight& sight, bool base_is_new) const;
  Kind make(Route& route, const Sight& sight) const;
  bool lead_past(Route& route, const core::RouteMap& map, const Sight& sight, double to_m) const;
  void stop_before(Route& route, const Sight& sight, double block_m) const;
  dmrp_waypoint waypoint_at(const Route& route, dmrp_vec2 point, double base_m) const;
  std::function<bool(dmrp_vec2)> cells_of(const Route& route) const;

  const VariantWorld& variant_;
  const core::World& world_;
  std::vector<Route> routes_;
};

}  // namespace dmrp::host
