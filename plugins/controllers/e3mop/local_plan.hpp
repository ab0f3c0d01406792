// SPDX-License-Identifier: MIT
// local_plan.hpp: the lattice path from the robot to a point of its global path, within the costmap's window.
#pragma once

#include <optional>
#include <vector>

#include "controllers/e3mop/lattice_search.hpp"

namespace dmrp::controllers::e3mop {

// The point of the global path that the search leads to.
struct LatticeGoal {
  Vec2 at = {0.0, 0.0};
  bool is_cut = false;       // obstacles separate the robot from the last free point of the path
  bool is_path_end = false;  // the last point of the path
};

// The window's lattice, its heuristic and its search. Reuses its buffers from cycle to cycle.
class LocalPlan {
 public:
  // Builds the motions for the robot's limits; allocates for windows of this field's size.
  void prepare(const Limits& limits, double resolution_m, const ClearanceField& field);

  // Lays the lattice about the robot and chooses the last point of the global path where the robot can stand and that
  // it can reach, according to the heuristic's grid. Nothing if it can reach none.
  std::optional<LatticeGoal> choose_goal(Vec2 robot, const ClearanceField& field, const FreeSpace& free_space,
                                         double inscribed_radius_m, const std::vector<Vec2>& path);

  // Takes another goal; false if the robot cannot reach it.
  bool can_reach(Vec2 goal);

  // Searches for the path to the goal chosen. The result is valid until the next search.
  const SearchResult& search(const Pose& robot, const FreeSpace& free_space, const SearchSettings& settings);

 private:
  void lay_lattice(Vec2 robot, const ClearanceField& field, const FreeSpace& free_space, double inscribed_radius_m);

  MotionSet motions_;
  LatticeFrame frame_;
  std::vector<std::uint8_t> open_cells_;  // the heuristic's grid
  GoalDistances to_goal_;
  GoalDistances from_robot_;
  LatticeSearch search_;
  SearchResult found_;
};

}  // namespace dmrp::controllers::e3mop
