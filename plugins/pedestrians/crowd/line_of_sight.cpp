// SPDX-License-Identifier: MIT
#include "pedestrians/crowd/line_of_sight.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/grid_line.hpp>
#include <dmrp/toolkit/segment.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::pedestrians {

namespace {

// Far more than the rounding errors of a line's cells, m.
constexpr double rounding_m = 1e-6;

// How many cells into an obstacle the search looks for its interior.
constexpr int most_blocked_cells = 6;

template <class Visit>
void for_each_in_block(toolkit::Cell cell, const Visit& visit) {
  for (std::int32_t row = cell.row - 1; row <= cell.row + 1; ++row)
    for (std::int32_t column = cell.column - 1; column <= cell.column + 1; ++column) visit(toolkit::Cell{column, row});
}

}  // namespace

void LineOfSight::start(const toolkit::GridView& grid) {
  grid_ = grid;
  states_.resize(grid.size());
  for (std::uint32_t index = 0; index < grid.size(); ++index) {
    int free_count = 0;
    for_each_in_block(grid.cell(index), [&](toolkit::Cell cell) { free_count += grid.free(cell) ? 1 : 0; });
    states_[index] = free_count == 9    ? CellState::all_free
                     : grid.free(index) ? CellState::free
                     : free_count == 0  ? CellState::all_blocked
                                        : CellState::blocked;
  }
}

bool LineOfSight::is_free(Vec2 from, Vec2 to, SightLine& last) const {
  if (last.to != to || !is_answered_by(last, from)) last = examine(from, to);
  return last.is_free;
}

// The distance d in the header's figure, against r.
bool LineOfSight::is_answered_by(const SightLine& last, Vec2 from) {
  const double off_m = last.is_free ? toolkit::distance(Segment{last.witness, last.to}, from)
                                    : toolkit::distance(Segment{from, last.to}, last.witness);
  return off_m < static_cast<double>(last.range_m);
}

// Only the cells of a free line and their neighbours lie within a cell's length of it, so a range of up to a cell's
// length needs no look at others.
SightLine LineOfSight::examine(Vec2 from, Vec2 to) const {
  const double cell_m = grid_.resolution_m();
  const Ray ray = {from, toolkit::normalized(to - from), toolkit::distance(from, to)};
  double range_m = cell_m;
  int blocked_count = 0;
  toolkit::Cell blocked;
  toolkit::for_each_cell_on_line(grid_, from, to, [&](toolkit::Cell cell) {
    const CellState state = grid_.contains(cell) ? states_[grid_.index(cell)] : CellState::blocked;
    if (state == CellState::free || state == CellState::all_free) {
      if (state == CellState::free && blocked_count == 0) range_m = std::min(range_m, clearance_beside(cell, ray));
      return blocked_count == 0;
    }
    if (blocked_count++ == 0 || state == CellState::all_blocked) {
      blocked = cell;
      range_m = state == CellState::all_blocked ? 1.5 * cell_m : 0.5 * cell_m;
    }
    return state != CellState::all_blocked && blocked_count < most_blocked_cells;
  });
  const bool is_free = blocked_count == 0;
  return {to, is_free ? from : grid_.center(blocked), is_free, static_cast<float>(std::max(range_m - rounding_m, 0.0))};
}

// A lower bound on the distance from the ray to the blocked neighbours of one of its cells: the gap across or along it.
double LineOfSight::clearance_beside(toolkit::Cell cell, const Ray& ray) const {
  const double half_cell_m = 0.5 * grid_.resolution_m() * (std::abs(ray.direction.x) + std::abs(ray.direction.y));
  double clearance_m = grid_.resolution_m();
  for_each_in_block(cell, [&](toolkit::Cell other) {
    if (grid_.free(other)) return;
    const Vec2 apart = grid_.center(other) - ray.from;
    const double ahead_m = toolkit::dot(ray.direction, apart);
    const double off_ends_m = std::max(-ahead_m, ahead_m - ray.length_m) - half_cell_m;
    const double aside_m = std::abs(toolkit::cross(ray.direction, apart)) - half_cell_m;
    clearance_m = std::min(clearance_m, std::max({off_ends_m, aside_m, 0.0}));
  });
  return clearance_m;
}

}  // namespace dmrp::pedestrians
