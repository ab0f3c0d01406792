// SPDX-License-Identifier: MIT
#include "core/scene/footprint_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/polygon.hpp>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "core/scene/footprint.hpp"
#include "core/scene/touching.hpp"

namespace dmrp::core {
namespace {

using toolkit::Cell;
using toolkit::GridView;

constexpr int axes = 4;  // the directions 0 to 3; each axis also has the opposite direction
constexpr int any_axis = axes;
constexpr int no_axis = -1;

// The number of cells in each connected part of a growing graph.
class JoinedCells {
 public:
  explicit JoinedCells(std::size_t cells) : parent_(cells), size_(cells, 1) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  std::uint32_t of(std::uint32_t cell) const {
    while (parent_[cell] != cell) cell = parent_[cell];
    return cell;
  }
  std::uint32_t size(std::uint32_t part) const { return size_[part]; }
  void join(std::uint32_t one, std::uint32_t two) {
    std::uint32_t large = of(one);
    std::uint32_t small = of(two);
    if (large == small) return;
    if (size_[large] < size_[small]) std::swap(large, small);
    parent_[small] = large;
    size_[large] += size_[small];
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint32_t> size_;
};

class FootprintGrid {
 public:
  FootprintGrid(const StaticGeometry& geometry, const RobotSettings& robot, double margin_m, PlanningGrid& grid)
      : geometry_(geometry),
        grid_(grid),
        c_grid_(grid.view()),
        view_(c_grid_),
        margin_m_(margin_m),
        axes_(view_.size(), no_axis),
        parts_(view_.size()) {
    for (int direction = 0; direction < 8; ++direction) {
      const auto d = static_cast<std::size_t>(direction);
      steps_[d] = view_.resolution_m() * dmrp_vec2{static_cast<double>(toolkit::direction_dx[d]),
                                                   static_cast<double>(toolkit::direction_dy[d])};
      for (const ConvexPolygon& part : robot.parts)
        headed_[d].push_back(toolkit::to_world({0.0, 0.0, std::atan2(steps_[d].y, steps_[d].x)}, part));
    }
  }

  // Cells on which the robot can turn, or which it can pass along one axis only, come first. Each other cell then takes
  // the axis that joins the most cells.
  void extend() {
    std::vector<std::pair<std::uint32_t, std::vector<int>>> undecided;
    for (std::uint32_t cell = 0; cell < view_.size(); ++cell) {
      if (grid_.free[cell]) {
        axes_[cell] = any_axis;
        continue;
      }
      std::vector<int> possible = possible_axes(cell);
      if (possible.size() == 1) axes_[cell] = possible.front();
      if (possible.size() > 1) undecided.emplace_back(cell, std::move(possible));
    }
    for (std::uint32_t cell = 0; cell < view_.size(); ++cell)
      for (int direction = 0; direction < axes; ++direction) join(cell, direction);
    for (const auto& [cell, possible] : undecided) decide(cell, possible);
    open_edges();
  }

 private:
  static ConvexPolygon at(dmrp_vec2 place, ConvexPolygon part) {
    for (dmrp_vec2& vertex : part) vertex += place;
    return part;
  }

  // The axes along which the footprint, heading either way, keeps the margin.
  std::vector<int> possible_axes(std::uint32_t cell) const {
    std::vector<int> possible;
    for (int axis = 0; axis < axes; ++axis) {
      double room_m = std::numeric_limits<double>::infinity();
      for (const int direction : {axis, axis + axes})
        for (const ConvexPolygon& part : headed_[static_cast<std::size_t>(direction)])
          room_m = std::min(room_m, geometry_.clearance(at(view_.center(cell), part), margin_m_ + touching_m));
      if (room_m > 0.0 && room_m >= margin_m_ - touching_m) possible.push_back(axis);
    }
    return possible;
  }

  bool passes(std::uint32_t cell, int axis) const { return axes_[cell] == any_axis || axes_[cell] == axis; }

  // Whether the robot can move to the neighbour and back, heading along the motion either way.
  bool can_move(std::uint32_t cell, int direction) const {
    const auto d = static_cast<std::size_t>(direction);
    const Cell from = view_.cell(cell);
    const Cell to = {from.column + toolkit::direction_dx[d], from.row + toolkit::direction_dy[d]};
    const int axis = direction % axes;
    if (!view_.contains(to) || !passes(cell, axis) || !passes(view_.index(to), axis)) return false;
    if (grid_.edges[cell] & 1u << direction) return true;  // open for the circle around the footprint
    if (toolkit::is_diagonal(direction) &&
        (axes_[view_.index({to.column, from.row})] == no_axis || axes_[view_.index({from.column, to.row})] == no_axis))
      return false;
    for (const int heading : {axis, axis + axes})
      for (const ConvexPolygon& part : headed_[static_cast<std::size_t>(heading)])
        if (!(geometry_.clearance(swept(at(view_.center(cell), part), steps_[d]), touching_m) > 0.0)) return false;
    return true;
  }

  void join(std::uint32_t cell, int direction) {
    if (can_move(cell, direction)) parts_.join(cell, view_.neighbour(cell, direction));
  }

  void decide(std::uint32_t cell, const std::vector<int>& possible) {
    int best = possible.front();
    std::uint32_t most = 0;
    for (const int axis : possible) {
      axes_[cell] = axis;
      std::uint32_t joined = 0;
      std::uint32_t ahead = cell;
      for (const int direction : {axis, axis + axes}) {
        if (!can_move(cell, direction)) continue;
        const std::uint32_t part = parts_.of(view_.neighbour(cell, direction));
        if (part != ahead) joined += parts_.size(part);
        ahead = part;
      }
      if (joined > most) {
        most = joined;
        best = axis;
      }
    }
    axes_[cell] = best;
    for (const int direction : {best, best + axes}) join(cell, direction);
  }

  // A cell that leads nowhere is not free.
  void open_edges() {
    for (std::uint32_t cell = 0; cell < view_.size(); ++cell)
      for (int direction = 0; direction < axes; ++direction) {
        if (!can_move(cell, direction)) continue;
        const std::uint32_t other = view_.neighbour(cell, direction);
        grid_.edges[cell] = static_cast<std::uint8_t>(grid_.edges[cell] | 1u << direction);
        grid_.edges[other] =
            static_cast<std::uint8_t>(grid_.edges[other] | 1u << toolkit::opposite_direction(direction));
      }
    for (std::uint32_t cell = 0; cell < view_.size(); ++cell)
      if (axes_[cell] != any_axis) grid_.free[cell] = grid_.edges[cell] != 0;
  }

  const StaticGeometry& geometry_;
  PlanningGrid& grid_;
  dmrp_grid c_grid_;
  GridView view_;
  double margin_m_;
  std::array<dmrp_vec2, 8> steps_{};
  std::array<std::vector<ConvexPolygon>, 8> headed_;  // the footprint, by direction
  std::vector<int> axes_;                             // by cell, along which the robot can pass
  JoinedCells parts_;
};

}  // namespace

PlanningGrid build_planning_grid(const StaticGeometry& geometry, double resolution_m, const RobotSettings& robot,
                                 double margin_m) {
  PlanningGrid grid = build_planning_grid(geometry, resolution_m, robot.radius_m, margin_m);
  if (!robot.parts.empty()) FootprintGrid(geometry, robot, margin_m, grid).extend();
  return grid;
}

}  // namespace dmrp::core
