// SPDX-License-Identifier: MIT
#include "line_of_sight.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/grid_line.hpp>
#include <dmrp/toolkit/segment.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::pedestrians {

namespace {

// Far more than what rounding makes of a line's cells, m.
constexpr double rounding_m = 1e-6;

template <class Visit>
void for_each_around(toolkit::Cell cell, const Visit& visit) {
  for (std::int32_t row = cell.row - 1; row <= cell.row + 1; ++row)
    for (std::int32_t column = cell.column - 1; column <= cell.column + 1; ++column) visit(toolkit::Cell{column, row});
}

}  // namespace

void Sight::start(const toolkit::GridView& grid) {
  grid_ = grid;
  rooms_.assign(grid.size(), Room::none);
  for (std::uint32_t index = 0; index < grid.size(); ++index) {
    if (!grid.free(index)) continue;
    bool all_round = true;
    for_each_around(grid.cell(index), [&](toolkit::Cell other) { all_round = all_round && grid.free(other); });
    rooms_[index] = all_round ? Room::all_round : Room::beside_blocked;
  }
}

// No point of a line to `to` is further from the last such line than its beginning is. Within a cell's length of a line
// are the cells on it and those around these alone: a blocked one is met by no line that keeps nearer to this one.
bool Sight::is_free(dmrp_vec2 from, dmrp_vec2 to, LineOfSight& last) const {
  if (last.to == to && toolkit::distance(dmrp_segment{last.from, last.to}, from) < last.room_m) return true;
  last = {from, to, grid_.resolution_m()};
  const bool is_free = toolkit::for_each_cell_on_line(grid_, from, to, [&](toolkit::Cell cell) {
    if (!grid_.contains(cell)) return false;
    const Room room = rooms_[grid_.index(cell)];
    if (room == Room::beside_blocked) last.room_m = std::min(last.room_m, room_beside(cell, last));
    return room != Room::none;
  });
  last.room_m = is_free ? std::max(last.room_m - rounding_m, 0.0) : 0.0;
  return is_free;
}

// How far it is at least from the line to a blocked cell beside one of its own: the gap across or along it.
double Sight::room_beside(toolkit::Cell cell, const LineOfSight& line) const {
  const dmrp_vec2 way = line.to - line.from;
  const double length_m = toolkit::norm(way);
  if (!(length_m > 0.0)) return 0.0;
  const dmrp_vec2 along = way / length_m;
  const double half_cell_m = 0.5 * grid_.resolution_m() * (std::abs(along.x) + std::abs(along.y));
  double room_m = line.room_m;
  for_each_around(cell, [&](toolkit::Cell other) {
    if (grid_.free(other)) return;
    const dmrp_vec2 apart = grid_.center(other) - line.from;
    const double ahead_m = toolkit::dot(along, apart);
    const double off_ends_m = std::max(-ahead_m, ahead_m - length_m) - half_cell_m;
    const double aside_m = std::abs(toolkit::cross(along, apart)) - half_cell_m;
    room_m = std::min(room_m, std::max({off_ends_m, aside_m, 0.0}));
  });
  return room_m;
}

}  // namespace dmrp::pedestrians
