// SPDX-License-Identifier: MIT
#include "pedestrians/crowd/line_of_sight.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/grid_line.hpp>
#include <dmrp/toolkit/segment.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::pedestrians {

namespace {

// Far more than what rounding makes of a line's cells, m.
constexpr double rounding_m = 1e-6;

// So far into what blocks a line is gone in search of its midst.
constexpr int most_blocked_cells = 6;

template <class Visit>
void for_each_around(toolkit::Cell cell, const Visit& visit) {
  for (std::int32_t row = cell.row - 1; row <= cell.row + 1; ++row)
    for (std::int32_t column = cell.column - 1; column <= cell.column + 1; ++column) visit(toolkit::Cell{column, row});
}

}  // namespace

void Sight::start(const toolkit::GridView& grid) {
  grid_ = grid;
  rooms_.resize(grid.size());
  for (std::uint32_t index = 0; index < grid.size(); ++index) {
    int free_count = 0;
    for_each_around(grid.cell(index), [&](toolkit::Cell cell) { free_count += grid.free(cell) ? 1 : 0; });
    rooms_[index] = free_count == 9    ? Room::all_free
                    : grid.free(index) ? Room::free
                    : free_count == 0  ? Room::all_blocked
                                       : Room::blocked;
  }
}

bool Sight::is_free(dmrp_vec2 from, dmrp_vec2 to, LineOfSight& last) const {
  if (last.to != to || !is_told_by(last, from)) last = look(from, to);
  return last.is_free;
}

// No point of a line to `to` is further from another such line than its beginning is. Within a cell's length of a free
// line are its own cells and those around these alone; a blocked one is met by no line that keeps nearer to it than the
// blocked one is. And a line that comes nearer to the middle of a blocked square than half its side runs through it.
bool Sight::is_told_by(const LineOfSight& last, dmrp_vec2 from) {
  const double off_m = last.is_free ? toolkit::distance(dmrp_segment{last.witness, last.to}, from)
                                    : toolkit::distance(dmrp_segment{from, last.to}, last.witness);
  return off_m < static_cast<double>(last.room_m);
}

LineOfSight Sight::look(dmrp_vec2 from, dmrp_vec2 to) const {
  const double cell_m = grid_.resolution_m();
  const Ray ray = {from, toolkit::normalized(to - from), toolkit::distance(from, to)};
  double room_m = cell_m;
  int blocked_count = 0;
  toolkit::Cell blocked;
  toolkit::for_each_cell_on_line(grid_, from, to, [&](toolkit::Cell cell) {
    const Room room = grid_.contains(cell) ? rooms_[grid_.index(cell)] : Room::blocked;
    if (room == Room::free || room == Room::all_free) {
      if (room == Room::free && blocked_count == 0) room_m = std::min(room_m, room_beside(cell, ray));
      return blocked_count == 0;
    }
    if (blocked_count++ == 0 || room == Room::all_blocked) {
      blocked = cell;
      room_m = room == Room::all_blocked ? 1.5 * cell_m : 0.5 * cell_m;
    }
    return room != Room::all_blocked && blocked_count < most_blocked_cells;
  });
  const bool is_free = blocked_count == 0;
  return {to, is_free ? from : grid_.center(blocked), is_free, static_cast<float>(std::max(room_m - rounding_m, 0.0))};
}

// How far it is at least from the ray to a blocked cell beside one of its own: the gap across or along it.
double Sight::room_beside(toolkit::Cell cell, const Ray& ray) const {
  const double half_cell_m = 0.5 * grid_.resolution_m() * (std::abs(ray.along.x) + std::abs(ray.along.y));
  double room_m = grid_.resolution_m();
  for_each_around(cell, [&](toolkit::Cell other) {
    if (grid_.free(other)) return;
    const dmrp_vec2 apart = grid_.center(other) - ray.from;
    const double ahead_m = toolkit::dot(ray.along, apart);
    const double off_ends_m = std::max(-ahead_m, ahead_m - ray.length_m) - half_cell_m;
    const double aside_m = std::abs(toolkit::cross(ray.along, apart)) - half_cell_m;
    room_m = std::min(room_m, std::max({off_ends_m, aside_m, 0.0}));
  });
  return room_m;
}

}  // namespace dmrp::pedestrians
