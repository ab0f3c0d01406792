// SPDX-License-Identifier: MIT
#include "controllers/e3mop/local_plan.hpp"

#include <algorithm>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers::e3mop {

void LocalPlan::prepare(const Limits& limits, double resolution_m, const ClearanceField& field) {
  motions_.build(limits, resolution_m);
  frame_.resolution_m = resolution_m;
  const Vec2 size = field.upper() - field.lower();
  frame_.half_cells = static_cast<std::int32_t>(0.5 * std::max(size.x, size.y) / resolution_m) + 1;
  open_cells_.reserve(static_cast<std::size_t>(frame_.cell_count()));
  to_goal_.reserve(frame_);
  from_robot_.reserve(frame_);
  search_.reserve(frame_, found_);
}

void LocalPlan::lay_lattice(Vec2 robot, const ClearanceField& field, const FreeSpace& free_space,
                            double inscribed_radius_m) {
  frame_.center = robot;
  frame_.resolution_m = motions_.resolution_m();
  const Vec2 below = robot - field.lower();
  const Vec2 above = field.upper() - robot;
  const double room_m = std::min(std::min(below.x, below.y), std::min(above.x, above.y)) - field.resolution_m();
  frame_.half_cells = std::max(0, static_cast<std::int32_t>(room_m / frame_.resolution_m));
  open_cells_.assign(static_cast<std::size_t>(frame_.cell_count()), 0);
  for (std::int32_t row = -frame_.half_cells; row <= frame_.half_cells; ++row) {
    for (std::int32_t column = -frame_.half_cells; column <= frame_.half_cells; ++column) {
      const std::int32_t cell = frame_.cell_at(column, row);
      const Vec2 at = frame_.point_of(cell);
      const double clearance_m = field.of_cell(at);
      open_cells_[static_cast<std::size_t>(cell)] = clearance_m >= inscribed_radius_m || free_space.tolerated(at);
    }
  }
}

// Seeds the heuristic with the goal's cell and its eight neighbours: the search may end in any of them.
bool LocalPlan::can_reach(Vec2 goal) {
  const std::int32_t cell = frame_.cell_of(goal);
  if (cell < 0) return false;
  to_goal_.begin(frame_, open_cells_);
  for (const std::int32_t row : {-1, 0, 1})
    for (const std::int32_t column : {-1, 0, 1}) to_goal_.seed(cell + row * frame_.stride() + column);
  return to_goal_.distance(frame_.center_cell()) != GoalDistances::infinite;
}

std::optional<LatticeGoal> LocalPlan::choose_goal(Vec2 robot, const ClearanceField& field, const FreeSpace& free_space,
                                                  double inscribed_radius_m, const std::vector<Vec2>& path) {
  lay_lattice(robot, field, free_space, inscribed_radius_m);
  const auto goal_at = [&](std::size_t i, bool is_cut) -> std::optional<LatticeGoal> {
    if (!can_reach(path[i])) return {};
    return LatticeGoal{path[i], is_cut, i + 1 == path.size()};
  };
  std::size_t last = path.size();
  while (last > 0 && !(frame_.cell_of(path[last - 1]) >= 0 && free_space.can_stand(path[last - 1]))) --last;
  if (last == 0) return {};
  --last;
  if (const auto goal = goal_at(last, false)) return goal;
  from_robot_.begin(frame_, open_cells_);
  from_robot_.seed(frame_.center_cell());
  for (std::size_t i = last; i-- > 0;) {
    const std::int32_t cell = frame_.cell_of(path[i]);
    if (cell < 0 || from_robot_.distance(cell) == GoalDistances::infinite || !free_space.can_stand(path[i])) continue;
    return goal_at(i, true);
  }
  return {};
}

const SearchResult& LocalPlan::search(const Pose& robot, const FreeSpace& free_space, const SearchSettings& settings) {
  search_.find(robot, {frame_, motions_, free_space, to_goal_}, settings, found_);
  return found_;
}

}  // namespace dmrp::controllers::e3mop
