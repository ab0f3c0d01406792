// SPDX-License-Identifier: MIT
#include "pedestrians/crowd/way_finding.hpp"

#include <algorithm>
#include <dmrp/toolkit/rectangle.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <stdexcept>

namespace dmrp::pedestrians {

namespace {

// Makes people accept a longer way to keep away from walls and corners.
constexpr toolkit::NavigationCost walking_cost = {1.0, 2.0};

// For people outside the free cells: the weight of the way on, relative to the way back into the cells.
constexpr double onward_weight = 10.0;

// The size of the walking grid's cells.
constexpr double walking_cell_m = 0.25;

// More than any scenario has. The limit keeps fields of unused places from accumulating.
constexpr std::size_t most_places_kept = 64;

}  // namespace

const Grid& walking_grid(const dmrp_walking_grid& extension, const World& world) {
  const dmrp_walking_grid_request request = {sizeof(request), 0, walking_cell_m, world->person_radius_m};
  const Grid* grid = extension.grid(&extension, &request);
  if (grid == nullptr) throw std::runtime_error("the host has no walking grid for this world");
  return *grid;
}

void WayFinder::start(const Grid& grid) {
  ways_.clear();
  if (!is_known(grid) || places_.size() > most_places_kept) {
    places_.clear();
    copy(grid);
  }
}

bool WayFinder::is_known(const Grid& grid) const {
  const std::size_t size = free_.size();
  return grid.width == grid_.width() && grid.height == grid_.height() && grid.resolution_m == grid_.resolution_m() &&
         grid.origin == grid_.lower() && std::equal(grid.free, grid.free + size, free_.begin()) &&
         std::equal(grid.edges, grid.edges + size, edges_.begin()) &&
         std::equal(grid.clearance, grid.clearance + size, clearance_.begin());
}

void WayFinder::copy(const Grid& grid) {
  const std::size_t size = std::size_t{grid.width} * grid.height;
  free_.assign(grid.free, grid.free + size);
  edges_.assign(grid.edges, grid.edges + size);
  clearance_.assign(grid.clearance, grid.clearance + size);
  Grid own = grid;
  own.free = free_.data();
  own.edges = edges_.data();
  own.clearance = clearance_.data();
  grid_ = toolkit::GridView(own);
  line_of_sight_.start(grid_);
}

Vec2 WayFinder::direction(std::size_t slot, const Person& person) {
  if (slot >= ways_.size()) {
    ways_.resize(slot + 1);
    patches_.resize(slot + 1);
  }
  Way& way = ways_[slot];
  const std::uint32_t cell = grid_.index_of(person.position);
  if (way.person_id != person.id || way.cell != cell || cell == toolkit::no_cell || way.sight_line.to != person.target)
    find_way(slot, person, cell);
  if (way.field != nullptr) {
    const Vec2 along =
        way.has_patch ? patches_[slot].direction(person.position) : along_field(*way.field, person.position, cell);
    if (along != Vec2{0.0, 0.0}) return along;
  }
  return toolkit::normalized(person.target - person.position);
}

// A person pushed out of the free cells walks on along them while returning. The field alone leads to the centre of the
// nearest free cell, which can lie backward, and a crowd that presses against a wall would stand still there.
Vec2 WayFinder::along_field(const toolkit::NavigationField& field, Vec2 position, std::uint32_t cell) const {
  const Vec2 along = field.direction(position);
  if (cell != toolkit::no_cell && field.reachable(cell)) return along;
  const std::uint32_t beside = grid_.index_of(position + grid_.resolution_m() * along);
  if (beside == toolkit::no_cell || !field.reachable(beside)) return along;
  return toolkit::normalized(along + onward_weight * field.direction(beside));
}

void WayFinder::find_way(std::size_t slot, const Person& person, std::uint32_t cell) {
  Way& way = ways_[slot];
  way.person_id = person.id;
  way.cell = cell;
  way.has_patch = false;
  way.field = nullptr;
  if (line_of_sight_.is_free(person.position, person.target, way.sight_line)) return;
  const toolkit::NavigationField& field = field_to_target_of(person);
  const bool is_cut_off = cell != toolkit::no_cell && grid_.free(cell) && !field.reachable(cell);
  if (is_cut_off) return;
  way.field = &field;
  way.has_patch = cell != toolkit::no_cell && field.has_patch(cell);
  if (way.has_patch) patches_[slot] = field.patch(cell);
}

const toolkit::NavigationField& WayFinder::field_to_target_of(const Person& person) {
  for (const Place& place : places_)
    if (place.target_id == person.target_id && place.area.lower == person.area_lower &&
        place.area.upper == person.area_upper)
      return place.field;
  places_.push_back({person.target_id, {person.area_lower, person.area_upper}, {}});
  Place& place = places_.back();
  place.field.compute(grid_, place.area, walking_cost);
  return place.field;
}

}  // namespace dmrp::pedestrians
