// SPDX-License-Identifier: MIT
// scenario.hpp: a world as its file describes it: static shapes, robots with their goals, and flows of people.
// Plain data, metres and radians in the world frame; the host parses scenario.toml into it.
#pragma once

#include <dmrp/person.h>
#include <dmrp/values.h>

#include <cstdint>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>
#include <string>
#include <vector>

#include "core/scene/recorded_track.hpp"

namespace dmrp::core {

// A static body. A [[box]] of the file becomes a polygon.
struct Shape {
  enum class Kind { circle, polygon };
  std::string name;
  Kind kind = Kind::polygon;
  dmrp_vec2 center{};               // circle
  double radius_m = 0.0;            // circle
  std::vector<dmrp_vec2> vertices;  // polygon: convex, counter-clockwise
  double height_m = 2.0;
};

inline constexpr double free_heading = std::numeric_limits<double>::quiet_NaN();

// A robot's task. Headings may be free; for a start see start_of() in robot_task.hpp.
struct RobotTask {
  std::string name;
  dmrp_pose start{};
  std::vector<dmrp_pose> goals;  // at least one; several form a tour
  std::string type{};            // name of the robot's type; "": the default type
};

// An axis-aligned rectangle where people come from, pass or go to.
struct Region {
  std::string name;
  dmrp_vec2 lower{};
  dmrp_vec2 upper{};
};

inline dmrp_vec2 middle_of(const Region& region) {
  return 0.5 * (region.lower + region.upper);
}

// The positions of a flow's people at t = 0: spread along the whole route, or all in the first region.
enum class FlowStart { along, from };

// People who walk from a region through others to a last one, where they leave.
struct Flow {
  std::string name;
  std::vector<std::uint32_t> regions;  // indices into Scenario::regions: from, via..., to; at least two
  std::uint32_t people = 0;            // at t = 0
  FlowStart start = FlowStart::along;
  bool respawn = true;           // each person who leaves is replaced by a new one in the first region
  std::uint32_t group_size = 1;  // people per group; the last group is smaller if `people` is not a multiple
  std::uint32_t reaction = DMRP_REACTION_UNSPECIFIED;  // to robots, of each of the people
};

// Body radius and walking speed of people; the speed is truncated normal. The body is RiMEA's, 40 cm wide (guideline
// 4.1.1): the pedestrian models are verified with it (docs/pedestrians.md).
struct PeopleSettings {
  double radius_m = 0.2;
  double speed_mean = 1.2;  // m/s
  double speed_sd = 0.2;
  double speed_min = 0.5;
  double speed_max = 2.0;
};

struct Scenario {
  std::string name;  // as used in experiment files
  std::string title;
  std::string description;
  dmrp_vec2 lower{};  // the world is the rectangle from lower to upper; its border is a wall
  dmrp_vec2 upper{};
  double time_limit_s = 180.0;
  std::vector<Shape> shapes;
  bool edge_is_open = false;      // of a map of map_server: beyond its edge there may be more, but no wall
  std::vector<dmrp_vec2> inside;  // robots are drawn in what these points reach: given points, or all listed starts
  std::vector<RobotTask> robots;
  std::vector<dmrp_vec2> other_starts;  // of listed robots that take no part: people keep clear of them too at t = 0
  PeopleSettings people;
  std::vector<Region> regions;
  std::vector<Flow> flows;
  std::vector<Track> tracks;  // of people replayed from a recording; time 0 is the start of the trial
};

// The number of people that the pedestrian model moves.
inline std::uint32_t walker_count(const Scenario& scenario) {
  std::uint32_t count = 0;
  for (const Flow& flow : scenario.flows) count += flow.people;
  return count;
}

// The number of all people, including recorded ones.
inline std::uint32_t person_count(const Scenario& scenario) {
  return walker_count(scenario) + static_cast<std::uint32_t>(scenario.tracks.size());
}

}  // namespace dmrp::core
