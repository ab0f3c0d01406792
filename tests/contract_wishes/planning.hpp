// SPDX-License-Identifier: MIT
// planning.hpp: calls of plan(), with the plan in force and goals that grow, and what came of them.
#pragma once

#include <string>
#include <vector>

#include "tests/contract_wishes/driver.hpp"

namespace dmrp::test {

// A path as the sink got it: its waypoints as far as the contract knows them, and the stride.
struct GivenPath {
  std::vector<dmrp_waypoint> waypoints;
  std::uint32_t stride = 0;
  std::vector<unsigned char> bytes;  // of all waypoints, as they were given
};

// The planning problem of a trial from call to call.
class Planning {
 public:
  // The robots start here; `world` has their goals.
  Planning(World& world, const std::vector<dmrp_vec2>& starts);
  Planning(const Planning&) = delete;
  Planning& operator=(const Planning&) = delete;

  // Calls plan(). If it is done, its paths are in force for the next call.
  std::int32_t plan(const Instance& planner);

  // Lets every robot follow its path in force for some steps from where it began.
  void drive(std::size_t steps);

  std::vector<Longer<dmrp_planning_robot>> robots;
  std::vector<GivenPath> paths;  // in force, or refused
  double cost = -1.0;            // as reported

 private:
  World& world_;
  std::uint64_t revision_ = 0;
  std::int64_t now_ns_ = 0;
  std::vector<std::vector<Longer<dmrp_waypoint>>> in_force_;
};

// What is wrong with step-wise paths on the grid: "" if they start and end as they should, pass all goals in order, make
// moves of one cell, and no two robots collide.
std::string fault_of(const Planning& planning, const World& world);

}  // namespace dmrp::test
