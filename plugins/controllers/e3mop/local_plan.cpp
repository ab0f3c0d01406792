// SPDX-License-Identifier: MIT
#include "controllers/e3mop/local_plan.hpp"

#include <algorithm>
#include <cmath>

namespace dmrp::controllers::e3mop {

void LocalPlan::prepare(const dmrp_limits& limits, double resolution_m, const ClearanceField& field) {
  motions_.build(limits, resolution_m);
  frame_.resolution_m = resolution_m;
  const Vec2 size = field.upper() - field.lower();
  frame_.half_cells = static_cast<std::int32_t>(0.5 * std::max(size.x, size.y) / resolution_m) + 1;
  open_cells_.reserve(static_cast<std::size_t>(frame_.cell_count()));
  to_goal_.reserve(frame_);
  from_robot_.reserve(frame_);
  search_.reserve(frame_, found_);
}

void LocalPlan::look(const Pose& robot, const ClearanceField& field, const FreeSpace& free_space,
                     double inscribed_radius_m) {
  free_space_ = &free_space;
  frame_.center = toolkit::position(robot);
  frame_.resolution_m = motions_.resolution_m();
  const Vec2 below = frame_.center - field.lower();
  const Vec2 above = field.upper() - frame_.center;
  const double room_m = std::min(std::min(below.x, below.y), std::min(above.x, above.y)) - field.resolution_m();
  frame_.half_cells = std::max(0, static_cast<std::int32_t>(room_m / frame_.resolution_m));
  open_cells_.assign(static_cast<std::size_t>(frame_.cell_count()), 0);
  for (std::int32_t row = -frame_.half_cells; row <= frame_.half_cells; ++row) {
    for (std::int32_t column = -frame_.half_cells; column <= frame_.half_cells; ++column) {
      const std::int32_t cell = frame_.cell_at(column, row);
      const Vec2 at = frame_.point_of(cell);
      const double clearance_m = field.of_cell(at.x, at.y);
      open_cells_[static_cast<std::size_t>(cell)] =
          clearance_m >= inscribed_radius_m || free_space.tolerated({at.x, at.y, 1.0, 0.0});
    }
  }
}

// Any of the cells about the point will do as the goal.
bool LocalPlan::head_for(const std::vector<Vec2>& path, std::size_t index) {
  goal_ = path[index];
  is_path_end_ = index + 1 == path.size();
  const std::int32_t cell = frame_.cell_of(goal_);
  if (cell < 0) return false;
  to_goal_.begin(frame_, open_cells_);
  for (const std::int32_t row : {-1, 0, 1})
    for (const std::int32_t column : {-1, 0, 1}) to_goal_.seed(cell + row * frame_.stride() + column);
  return to_goal_.distance(frame_.center_cell()) != GoalDistances::infinite;
}

bool LocalPlan::choose_goal(const std::vector<Vec2>& path) {
  is_cut_ = false;
  std::size_t last = path.size();
  while (last > 0) {
    --last;
    const std::int32_t cell = frame_.cell_of(path[last]);
    if (cell >= 0 && free_space_->is_free({path[last].x, path[last].y, 1.0, 0.0})) break;
    if (last == 0) return false;
  }
  if (head_for(path, last)) return true;
  is_cut_ = true;
  from_robot_.begin(frame_, open_cells_);
  from_robot_.seed(frame_.center_cell());
  for (std::size_t i = last; i-- > 0;) {
    const std::int32_t cell = frame_.cell_of(path[i]);
    if (cell < 0 || from_robot_.distance(cell) == GoalDistances::infinite) continue;
    if (!free_space_->is_free({path[i].x, path[i].y, 1.0, 0.0})) continue;
    return head_for(path, i);
  }
  return false;
}

void LocalPlan::search(const Pose& robot, const SearchSettings& settings) {
  search_.find(robot, {frame_, motions_, *free_space_, to_goal_}, settings, found_);
}

}  // namespace dmrp::controllers::e3mop
