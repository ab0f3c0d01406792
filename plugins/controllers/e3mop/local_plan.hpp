// SPDX-License-Identifier: MIT
// local_plan.hpp: the lattice path from the robot to a point of its global path, inside the costmap's window.
#ifndef DMRP_CONTROLLERS_E3MOP_LOCAL_PLAN_HPP
#define DMRP_CONTROLLERS_E3MOP_LOCAL_PLAN_HPP

#include <vector>

#include "controllers/e3mop/lattice_search.hpp"

namespace dmrp::controllers::e3mop {

// The window's lattice, its heuristic and its search, cycle after cycle.
class LocalPlan {
 public:
  // Once the robot's limits are known, and when they change; makes room for windows like this field's.
  void prepare(const dmrp_limits& limits, double resolution_m, const ClearanceField& field);

  // Lays the lattice about the robot. `field` and `free_space` are used until the next call.
  void look(const Pose& robot, const ClearanceField& field, const FreeSpace& free_space, double inscribed_radius_m);

  // The farthest of these points of the global path that the robot can stand at and get to, as far as the heuristic's
  // grid can say. False where it gets to none.
  bool choose_goal(const std::vector<Vec2>& path);

  // To the goal chosen.
  void search(const Pose& robot, const SearchSettings& settings);

  Vec2 goal() const { return goal_; }
  bool is_cut() const { return is_cut_; }            // something stands across the whole way to the path's end
  bool is_path_end() const { return is_path_end_; }  // the goal is the last of the path's points
  const SearchResult& found() const { return found_; }

 private:
  bool head_for(const std::vector<Vec2>& path, std::size_t index);

  MotionSet motions_;
  LatticeFrame frame_;
  const FreeSpace* free_space_ = nullptr;
  std::vector<std::uint8_t> open_cells_;  // by the heuristic's measure
  GoalDistances to_goal_;
  GoalDistances from_robot_;
  LatticeSearch search_;
  SearchResult found_;
  Vec2 goal_ = {0.0, 0.0};
  bool is_cut_ = false;
  bool is_path_end_ = false;
};

}  // namespace dmrp::controllers::e3mop

#endif
