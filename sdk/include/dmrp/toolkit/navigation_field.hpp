// SPDX-License-Identifier: MIT
// navigation_field.hpp: the length of the shortest way to a target, and its direction, from every point.
//
// The fast marching method (Sethian 1996): solves |grad T| = cost on the free cells of a grid, so that T is the length
// of the shortest way (not of a zigzag of grid moves) times the cost per metre. First order: within a few per cent of
// the true length, and at cell centres never shorter than the straight line except by rounding. It moves between cells
// only along edges E, N, W, S of the grid's mask, which are mutual, and cuts no corner. Cells at equal distance are
// settled in the order of their indices, so equal grids give equal fields.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "grid_line.hpp"
#include "grid_view.hpp"
#include "rectangle.hpp"
#include "vec2.hpp"

namespace dmrp::toolkit {

// A cost for ways near walls: a metre in clearance c costs 1 + wall_cost * (1 - c / comfort_m)^2 where c < comfort_m,
// and 1 elsewhere. The default gives the shortest way.
struct NavigationCost {
  double comfort_m = 0.0;
  double wall_cost = 0.0;
};

// Keeps its buffers between calls of compute(). The grid's arrays must outlive the field.
class NavigationField {
 public:
  // The field towards the nearest of the targets; a point is a rectangle without extent. A target is reached through
  // the free cells that it touches: a target that touches none has no effect.
  void compute(const GridView& grid, const std::vector<Rectangle>& targets, NavigationCost cost = {}) {
    begin(grid, targets, cost);
    march({});
  }

  void compute(const GridView& grid, const Rectangle& target, NavigationCost cost = {}) {
    compute(grid, std::vector<Rectangle>{target}, cost);
  }

  // Computes the same field only as far as the ways from the points `from` need it: it tells the truth about a point
  // that it knows.
  void compute_from(const GridView& grid, const std::vector<dmrp_vec2>& from, const Rectangle& target) {
    begin(grid, {target}, {});
    std::vector<std::uint32_t> starts;
    for (const dmrp_vec2 point : from) starts.push_back(grid.index_of(point));
    march(starts);
  }

  // Whether the field was computed as far as the point's cell and those around it.
  bool knows(dmrp_vec2 point) const {
    if (known_ == unreachable) return true;
    const std::uint32_t cell = grid_.index_of(point);
    return cell != no_cell && values_[cell] + around() <= known_;
  }

  DMRP_LOCAL static constexpr double unreachable = std::numeric_limits<double>::infinity();

  const GridView& grid() const { return grid_; }

  // At a cell's centre: metres times cost; `unreachable` where no way leads to a target.
  double value(std::uint32_t cell) const { return values_[cell]; }
  bool reachable(std::uint32_t cell) const { return values_[cell] < unreachable; }

  // The unit direction of steepest descent at a cell's centre; zero in a target and where no way leads to one. Computed
  // at each call: most cells of a large field are never asked for.
  dmrp_vec2 direction(std::uint32_t cell) const {
    if (states_[cell] & is_aimed) return aims_.find(cell)->second;
    return states_[cell] & is_settled ? descent(cell) : dmrp_vec2{0.0, 0.0};
  }

  // At any point: bilinear between cell centres, or the value of the point's own cell where a neighbour is cut off. For
  // a point in no reachable cell (pushed against a wall) the distance to the nearest reachable cell's centre is added.
  double value(dmrp_vec2 point) const {
    const std::uint32_t own = nearest_reachable(point);
    if (own == no_cell) return unreachable;
    if (grid_.index_of(point) != own) return values_[own] + distance(point, grid_.center(own));
    const Rectangle* target = touching_target(own);
    if (target != nullptr) return distance(*target, point) * metre_cost(own);
    const Corners corners = corners_around(point, own);
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      if (corners.cells[i] == no_cell) {
        const double gained = dot(direction(own), point - grid_.center(own));
        return std::max(0.0, values_[own] - gained * metre_cost(own));
      }
      sum += corners.weights[i] * values_[corners.cells[i]];
    }
    return sum;
  }

  // The unit direction to walk at any point: interpolated between the cells connected to the point's own; straight to
  // the target in a cell that touches it; to the nearest reachable cell from a point in none. Zero inside a target and
  // where no way leads to one.
  dmrp_vec2 direction(dmrp_vec2 point) const {
    const std::uint32_t own = nearest_reachable(point);
    if (own == no_cell) return {0.0, 0.0};
    if (grid_.index_of(point) != own) return normalized(grid_.center(own) - point);
    const Rectangle* target = touching_target(own);
    if (target != nullptr) return normalized(closest_point(*target, point) - point);
    return patch(own).direction(point);
  }

  // The directions of a cell and its neighbours, all that direction() reads: a copy for frequent calls inside one cell,
  // because the field of a large world does not fit in a cache.
  struct Patch {
    dmrp_vec2 center;  // of the cell
    double resolution_m;
    std::array<dmrp_vec2, 9> directions;  // by rows, the cell's own in the middle; zero for cells not connected to it

    // The same as NavigationField::direction(), for a point in the cell.
    dmrp_vec2 direction(dmrp_vec2 point) const {
      const dmrp_vec2 offset = (point - center) / resolution_m;
      const std::size_t across = offset.x < 0.0 ? 3 : 5;
      const std::size_t up = offset.y < 0.0 ? 1 : 7;
      const double far_x = std::abs(offset.x);
      const double far_y = std::abs(offset.y);
      dmrp_vec2 sum = {0.0, 0.0};
      sum += (1.0 - far_x) * (1.0 - far_y) * directions[4];
      sum += far_x * (1.0 - far_y) * directions[across];
      sum += (1.0 - far_x) * far_y * directions[up];
      sum += far_x * far_y * directions[across + up - 4];
      // Where ways part, the neighbours' directions may cancel: then the point's own cell decides.
      return norm(sum) > 0.1 ? normalized(sum) : directions[4];
    }
  };

  // Whether the cell's patch gives direction() at every point of the cell: it is reachable and touches no target.
  bool has_patch(std::uint32_t cell) const { return reachable(cell) && touching_target(cell) == nullptr; }

  Patch patch(std::uint32_t cell) const {
    assert(has_patch(cell));
    Patch patch = {grid_.center(cell), grid_.resolution_m(), {}};
    patch.directions[4] = direction(cell);
    for (std::size_t d = 0; d < strides_.size(); ++d) {
      // An edge always leads to a cell in the grid; the direction is zero in an unreachable cell.
      if (grid_.edge(cell, static_cast<int>(d)))
        patch.directions[static_cast<std::size_t>(4 + direction_dx[d] + 3 * direction_dy[d])] =
            direction(cell + strides_[d]);
    }
    return patch;
  }

 private:
  using Entry = std::pair<double, std::uint32_t>;  // value, cell: the order of settling

  DMRP_LOCAL static constexpr std::uint8_t is_settled = 1;
  DMRP_LOCAL static constexpr std::uint8_t is_aimed = 2;

  // The four cells whose centres surround a point, with their bilinear weights; no_cell for a cell that is not
  // connected to the point's own cell.
  struct Corners {
    std::array<std::uint32_t, 4> cells;
    std::array<double, 4> weights;
  };

  void begin(const GridView& grid, const std::vector<Rectangle>& targets, NavigationCost cost) {
    const bool few = known_ < unreachable && values_.size() == grid.size();
    grid_ = grid;
    for (std::size_t i = 0; i < strides_.size(); ++i)
      strides_[i] =
          static_cast<std::uint32_t>(direction_dx[i]) + static_cast<std::uint32_t>(direction_dy[i]) * grid.width();
    cost_ = cost;
    targets_ = targets;
    clear(few);
    for (const Rectangle& target : targets_) seed(target);
  }

  // Forgets the last field: the cells that it came to, if these are `few`, else all.
  void clear(bool few) {
    if (few) {
      for (const Entry& entry : queue_) order_.push_back(entry.second);
      for (const std::uint32_t cell : order_) {
        values_[cell] = unreachable;
        states_[cell] = 0;
      }
    } else {
      values_.assign(grid_.size(), unreachable);
      states_.assign(grid_.size(), 0);
    }
    order_.clear();
    queue_.clear();
    aims_.clear();
  }

  // What the values of cells around a cell exceed its own by at most, and more, where a metre costs 1.
  double around() const { return 6.0 * grid_.resolution_m(); }

  double metre_cost(std::uint32_t cell) const {
    const double clearance = static_cast<double>(grid_.clearance(cell));
    if (!(clearance < cost_.comfort_m)) return 1.0;
    const double closeness = 1.0 - clearance / cost_.comfort_m;
    return 1.0 + cost_.wall_cost * closeness * closeness;
  }

  Rectangle square_of(Cell cell) const {
    const dmrp_vec2 half = {0.5 * grid_.resolution_m(), 0.5 * grid_.resolution_m()};
    return {grid_.center(cell) - half, grid_.center(cell) + half};
  }

  static bool overlap(const Rectangle& a, const Rectangle& b) {
    return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y;
  }

  const Rectangle* touching_target(std::uint32_t cell) const {
    const Rectangle* nearest = nullptr;
    double nearest_distance = unreachable;
    for (const Rectangle& target : targets_) {
      if (!overlap(target, square_of(grid_.cell(cell)))) continue;
      const double target_distance = distance(target, grid_.center(cell));
      if (target_distance < nearest_distance) {
        nearest = &target;
        nearest_distance = target_distance;
      }
    }
    return nearest;
  }

  Cell clamped(Cell cell) const {
    return {std::clamp(cell.column, 0, static_cast<std::int32_t>(grid_.width()) - 1),
            std::clamp(cell.row, 0, static_cast<std::int32_t>(grid_.height()) - 1)};
  }

  // Initialises the cells that a target touches and nearby cells that see it: their distance is known exactly, and the
  // method's error arises near a source.
  void seed(const Rectangle& target) {
    if (grid_.size() == 0) return;
    const std::int32_t exact_ring = 8;
    const Cell first = grid_.cell_of(target.lower);
    const Cell last = grid_.cell_of(target.upper);
    const Cell lower = clamped({first.column - exact_ring, first.row - exact_ring});
    const Cell upper = clamped({last.column + exact_ring, last.row + exact_ring});
    for (std::int32_t row = lower.row; row <= upper.row; ++row) {
      for (std::int32_t column = lower.column; column <= upper.column; ++column) {
        const Cell cell = {column, row};
        if (!grid_.free(cell)) continue;
        const std::uint32_t index = grid_.index(cell);
        const dmrp_vec2 center = grid_.center(cell);
        const dmrp_vec2 aim = closest_point(target, center);
        const double away = distance(aim, center);
        if (overlap(target, square_of(cell))) {
          aim_at(index, away * metre_cost(index), normalized(aim - center));
        } else if (static_cast<double>(grid_.clearance(index)) - away >= cost_.comfort_m &&
                   line_is_free(grid_, center, aim)) {
          // No shape is as near as the target, and the clearance stays above comfort_m: the way is straight and costs
          // its length.
          aim_at(index, away, normalized(aim - center));
        }
      }
    }
  }

  // The straight way to a target; a zero direction leaves the slope of the field.
  void aim_at(std::uint32_t cell, double value, dmrp_vec2 direction) {
    if (!(value < values_[cell])) return;
    offer(cell, value);
    if (direction == dmrp_vec2{0.0, 0.0}) return;
    aims_[cell] = direction;
    states_[cell] = is_aimed;
  }

  void offer(std::uint32_t cell, double value) {
    if (!(value < values_[cell])) return;
    values_[cell] = value;
    states_[cell] = 0;
    queue_.emplace_back(value, cell);
    std::push_heap(queue_.begin(), queue_.end(), std::greater<Entry>());
  }

  // Settles all cells; or, with starts, no more than the ways from them need: if all of these can be settled.
  void march(const std::vector<std::uint32_t>& starts) {
    known_ = unreachable;
    std::size_t settled_starts = 0;
    while (!queue_.empty() && !(queue_.front().first > known_)) {
      std::pop_heap(queue_.begin(), queue_.end(), std::greater<Entry>());
      const std::uint32_t cell = queue_.back().second;
      queue_.pop_back();
      if (states_[cell] & is_settled) continue;
      states_[cell] |= is_settled;
      if (!starts.empty()) {
        order_.push_back(cell);
        settled_starts += static_cast<std::size_t>(std::count(starts.begin(), starts.end(), cell));
        if (settled_starts == starts.size() && known_ == unreachable) known_ = values_[cell] + 2.0 * around();
      }
      for (int direction = 0; direction < direction_count; direction += 2) {
        if (!grid_.edge(cell, direction)) continue;
        const std::uint32_t next = across(cell, direction);
        if (!(states_[next] & is_settled)) offer(next, upwind_value(next));
      }
    }
    if (queue_.empty()) known_ = unreachable;
  }

  // The cell on the other side of an edge: always in the grid, so there is no bounds check.
  std::uint32_t across(std::uint32_t cell, int direction) const {
    return cell + strides_[static_cast<std::size_t>(direction)];
  }

  // The settled value across one edge; `unreachable` where there is none.
  double settled_value(std::uint32_t cell, int direction) const {
    if (!grid_.edge(cell, direction)) return unreachable;
    const std::uint32_t next = across(cell, direction);
    return states_[next] & is_settled ? values_[next] : unreachable;
  }

  // Solves the eikonal equation at a cell from its settled neighbours.
  double upwind_value(std::uint32_t cell) const {
    const double along_x = std::min(settled_value(cell, 0), settled_value(cell, 4));
    const double along_y = std::min(settled_value(cell, 2), settled_value(cell, 6));
    const double step = metre_cost(cell) * grid_.resolution_m();
    const double lower = std::min(along_x, along_y);
    const double apart = std::max(along_x, along_y) - lower;
    if (!(apart < step)) return lower + step;
    return 0.5 * (along_x + along_y + std::sqrt(2.0 * step * step - apart * apart));
  }

  // The direction of the upwind differences that gave the value; zero in a target.
  dmrp_vec2 descent(std::uint32_t cell) const {
    const auto slope = [&](int positive, int negative) {
      const double ahead = settled_value(cell, positive);
      const double behind = settled_value(cell, negative);
      return ahead <= behind ? std::max(0.0, values_[cell] - ahead) : -std::max(0.0, values_[cell] - behind);
    };
    return normalized({slope(0, 4), slope(2, 6)});
  }

  Corners corners_around(dmrp_vec2 point, std::uint32_t own) const {
    const Cell center = grid_.cell(own);
    const dmrp_vec2 offset = (point - grid_.center(own)) / grid_.resolution_m();
    const std::int32_t dx = offset.x < 0.0 ? -1 : 1;
    const std::int32_t dy = offset.y < 0.0 ? -1 : 1;
    const double far_x = std::abs(offset.x);
    const double far_y = std::abs(offset.y);
    const auto joined = [&](std::int32_t step_x, std::int32_t step_y) {
      const bool open = grid_.edge(own, direction_of(step_x, step_y));
      const Cell cell = {center.column + step_x, center.row + step_y};
      return open && grid_.contains(cell) && reachable(grid_.index(cell)) ? grid_.index(cell) : no_cell;
    };
    return {{own, joined(dx, 0), joined(0, dy), joined(dx, dy)},
            {(1.0 - far_x) * (1.0 - far_y), far_x * (1.0 - far_y), (1.0 - far_x) * far_y, far_x * far_y}};
  }

  // The reachable cell that contains the point, or the one whose centre is nearest, with the lowest index among equals;
  // no_cell if none is reachable. Searches square rings of cells until no further one can be nearer.
  std::uint32_t nearest_reachable(dmrp_vec2 point) const {
    const std::uint32_t holding = grid_.index_of(point);
    if (holding != no_cell && reachable(holding)) return holding;
    const Cell middle = clamped(grid_.cell_of(point));
    const auto rings = static_cast<std::int32_t>(std::max(grid_.width(), grid_.height()));
    std::uint32_t best = no_cell;
    double best_distance = unreachable;
    for (std::int32_t ring = 0; ring <= rings; ++ring) {
      if ((ring - 1) * grid_.resolution_m() > best_distance) break;
      for (std::int32_t row = middle.row - ring; row <= middle.row + ring; ++row) {
        const bool whole_row = std::abs(row - middle.row) == ring;
        for (std::int32_t dx = -ring; dx <= ring; dx += whole_row ? 1 : std::max(1, 2 * ring)) {
          const Cell cell = {middle.column + dx, row};
          if (!grid_.contains(cell) || !reachable(grid_.index(cell))) continue;
          const double cell_distance = distance(grid_.center(cell), point);
          if (cell_distance < best_distance || (cell_distance == best_distance && grid_.index(cell) < best)) {
            best = grid_.index(cell);
            best_distance = cell_distance;
          }
        }
      }
    }
    return best;
  }

  GridView grid_;
  std::array<std::uint32_t, 8> strides_ = {};  // from a cell's index to its neighbours', modulo 2^32
  NavigationCost cost_;
  std::vector<Rectangle> targets_;
  std::vector<double> values_;
  std::vector<std::uint8_t> states_;                   // of is_settled and is_aimed
  std::unordered_map<std::uint32_t, dmrp_vec2> aims_;  // straight to a target, of the cells that are aimed
  std::vector<Entry> queue_;
  std::vector<std::uint32_t> order_;  // cells as they were settled, if not all were to be
  double known_ = unreachable;        // up to this value, all cells are settled
};

}  // namespace dmrp::toolkit
