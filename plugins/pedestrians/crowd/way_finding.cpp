// SPDX-License-Identifier: MIT
#include "way_finding.hpp"

#include <cmath>
#include <dmrp/toolkit/grid_line.hpp>
#include <dmrp/toolkit/rectangle.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>
#include <queue>
#include <utility>

namespace dmrp::pedestrians {

namespace {

constexpr double no_way = std::numeric_limits<double>::infinity();

// Who is pushed off the free cells looks this far for one, m.
constexpr double search_radius_m = 1.5;

// How far along the way ahead points in sight are looked for, cells.
constexpr int look_ahead_cells = 80;

}  // namespace

void WayFinder::start(const dmrp_grid& walking_grid) {
  grid_ = toolkit::GridView(walking_grid);
  places_.clear();
  headings_.clear();
}

dmrp_vec2 WayFinder::direction(std::size_t slot, const Person& person) {
  const std::uint32_t cell = grid_.index_of(person.position);
  if (slot >= headings_.size()) headings_.resize(slot + 1, {0, 0, toolkit::no_cell, {0.0, 0.0}, {0.0, 0.0}});
  Heading& heading = headings_[slot];
  const bool fresh = heading.person_id == person.id && heading.target_id == person.target_id &&
                     heading.target == person.target && heading.cell == cell && cell != toolkit::no_cell;
  if (!fresh) heading = {person.id, person.target_id, cell, person.target, point_to_head_for(person, cell)};
  return toolkit::normalized(heading.point - person.position);
}

dmrp_vec2 WayFinder::point_to_head_for(const Person& person, std::uint32_t cell) {
  if (toolkit::line_is_free(grid_, person.position, person.target)) return person.target;
  Place& place = place_of(person);
  if (cell == toolkit::no_cell || place.distance_m[cell] == no_way) {
    const std::uint32_t way_back = nearest_reached_cell(place, person.position);
    return way_back == toolkit::no_cell ? person.target : grid_.center(way_back);
  }
  const std::uint32_t ahead = cell_to_head_for(place, cell);
  return ahead == cell ? person.target : grid_.center(ahead);
}

WayFinder::Place& WayFinder::place_of(const Person& person) {
  for (Place& place : places_)
    if (place.target_id == person.target_id && place.area_lower == person.area_lower &&
        place.area_upper == person.area_upper)
      return place;
  places_.push_back({person.target_id, person.area_lower, person.area_upper, {}, {}});
  Place& place = places_.back();
  const toolkit::Rectangle area = {person.area_lower, person.area_upper};
  std::vector<std::uint32_t> goals;
  for (std::uint32_t c = 0; c < grid_.size(); ++c)
    if (grid_.free(c) && toolkit::contains(area, grid_.center(c))) goals.push_back(c);
  place.distance_m.assign(grid_.size(), no_way);
  place.heading_for.assign(grid_.size(), toolkit::no_cell);
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (const std::uint32_t goal : goals) open.push({place.distance_m[goal] = 0.0, goal});
  while (!open.empty()) {
    const auto [d, c] = open.top();
    open.pop();
    if (d > place.distance_m[c]) continue;
    for (int k = 0; k < toolkit::direction_count; ++k) {
      if (!grid_.edge(c, k)) continue;
      const std::uint32_t next = grid_.neighbour(c, k);
      const double to = d + toolkit::direction_length[static_cast<std::size_t>(k)] * grid_.resolution_m();
      if (to < place.distance_m[next]) open.push({place.distance_m[next] = to, next});
    }
  }
  return place;
}

// Follows the shortest way and takes the last cell on it that is in sight from the first.
std::uint32_t WayFinder::cell_to_head_for(Place& place, std::uint32_t from) const {
  std::uint32_t& known = place.heading_for[from];
  if (known != toolkit::no_cell) return known;
  known = from;
  std::uint32_t at = from;
  for (int i = 0; i < look_ahead_cells; ++i) {
    std::uint32_t next = at;
    for (int k = 0; k < toolkit::direction_count; ++k) {
      if (!grid_.edge(at, k)) continue;
      const std::uint32_t beside = grid_.neighbour(at, k);
      if (place.distance_m[beside] < place.distance_m[next]) next = beside;
    }
    if (next == at) break;
    if (i > 0 && !toolkit::line_is_free(grid_, grid_.center(from), grid_.center(next))) break;
    known = at = next;
  }
  return known;
}

std::uint32_t WayFinder::nearest_reached_cell(const Place& place, dmrp_vec2 position) const {
  const auto reach = static_cast<std::int32_t>(std::ceil(search_radius_m / grid_.resolution_m()));
  const toolkit::Cell around = grid_.cell_of(position);
  std::uint32_t nearest = toolkit::no_cell;
  double nearest_squared = no_way;
  for (std::int32_t row = around.row - reach; row <= around.row + reach; ++row) {
    for (std::int32_t column = around.column - reach; column <= around.column + reach; ++column) {
      const toolkit::Cell cell = {column, row};
      if (!grid_.contains(cell) || place.distance_m[grid_.index(cell)] == no_way) continue;
      const double squared = toolkit::squared_distance(grid_.center(cell), position);
      if (squared < nearest_squared) nearest = grid_.index(cell), nearest_squared = squared;
    }
  }
  return nearest;
}

}  // namespace dmrp::pedestrians
