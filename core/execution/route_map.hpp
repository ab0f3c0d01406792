// SPDX-License-Identifier: MIT
// route_map.hpp: where a robot can drive in its costmap, and ways through it.
#pragma once

#include <dmrp/ext/local_costmap.h>
#include <dmrp/observation.h>

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/scene/settings.hpp"

namespace dmrp::core {

// A robot's surroundings at one control tick, for one direction of travel.
//
// - What stands is an obstacle: all that the costmap has marked, without the agents that move, which the robot's
//   controller meets in time, and without robots where an order between them holds (`yields_to_robots`).
// - An oncoming robot closes the way ahead of itself, and to the left of itself as this one sees it, so that both keep
//   right. It does the same, so it is taken to be farther to the left by half of the room that both need.
// - Unknown cells and those outside of the costmap are free.
class RouteMap {
 public:
  struct View {
    const dmrp_costmap& costmap;
    std::span<const dmrp_agent> agents;
    dmrp_pose pose;
    dmrp_vec2 direction;            // unit vector
    bool yields_to_robots = false;  // leave the robots out
  };

  // The arguments outlive it.
  RouteMap(const View& view, const RobotSettings& robot);

  // Returns this map without oncoming robots.
  RouteMap of_what_stands() const;

  // Whether nothing stands where the footprint would be; and also no oncoming robot comes there.
  bool is_free(dmrp_vec2 point, double heading) const;
  bool fits(dmrp_vec2 point, double heading) const;

  // Whether nothing stands where the robot is.
  bool robot_is_free() const;

  // The cheapest way between two points (A* over the cells, in eight directions; a metre costs up to three times as much
  // near obstacles), as few straight legs; nothing if there is none. A robot that does not fit where it is may leave that
  // place. `allowed` may be empty.
  std::optional<std::vector<dmrp_vec2>> way(dmrp_vec2 from, dmrp_vec2 to,
                                            const std::function<bool(dmrp_vec2)>& allowed) const;

  // Half of the window's side: a route is led within it.
  double reach_m() const;

 private:
  struct Oncoming {
    dmrp_segment ahead;  // that it drives next
    dmrp_segment left;   // from there to the left
    double need_m;
  };

  // Limits a way: `left_place` may be left although the robot does not fit there (nullptr: none); `allowed` says where the
  // robot may be at all.
  struct Bounds {
    const dmrp_vec2* left_place;
    const std::function<bool(dmrp_vec2)>& allowed;
  };

  void meet(const dmrp_agent& other);
  bool is_left_out(dmrp_vec2 point, double beyond_m) const;
  std::uint8_t cost(dmrp_vec2 point) const;
  bool outline_is_free(dmrp_vec2 point, double heading) const;
  double leg_cost(dmrp_vec2 from, dmrp_vec2 to, const Bounds& bounds) const;
  std::vector<dmrp_vec2> straightened(const std::vector<dmrp_vec2>& way, const Bounds& bounds) const;

  const View view_;
  const RobotSettings& robot_;
  std::vector<const dmrp_agent*> left_out_;
  std::vector<Oncoming> oncoming_;
};

}  // namespace dmrp::core
