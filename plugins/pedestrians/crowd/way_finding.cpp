// SPDX-License-Identifier: MIT
#include "pedestrians/crowd/way_finding.hpp"

#include <algorithm>
#include <dmrp/toolkit/rectangle.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::pedestrians {

namespace {

// People rather walk a little further than along a wall or round a corner's very edge.
constexpr toolkit::NavigationCost walking_cost = {1.0, 2.0};

// How much more somebody beside the free cells minds the way on than the way back in.
constexpr double onward_weight = 10.0;

// More than any scenario has; fields of places that nobody goes to any more must not pile up.
constexpr std::size_t most_places_kept = 64;

}  // namespace

void WayFinder::start(const dmrp_grid& walking_grid) {
  ways_.clear();
  if (!is_known(walking_grid) || places_.size() > most_places_kept) {
    places_.clear();
    copy(walking_grid);
  }
}

bool WayFinder::is_known(const dmrp_grid& grid) const {
  const std::size_t size = free_.size();
  return grid.width == grid_.width() && grid.height == grid_.height() && grid.resolution_m == grid_.resolution_m() &&
         grid.origin == grid_.lower() && std::equal(grid.free, grid.free + size, free_.begin()) &&
         std::equal(grid.edges, grid.edges + size, edges_.begin()) &&
         std::equal(grid.clearance, grid.clearance + size, clearance_.begin());
}

void WayFinder::copy(const dmrp_grid& grid) {
  const std::size_t size = std::size_t{grid.width} * grid.height;
  free_.assign(grid.free, grid.free + size);
  edges_.assign(grid.edges, grid.edges + size);
  clearance_.assign(grid.clearance, grid.clearance + size);
  dmrp_grid own = grid;
  own.free = free_.data();
  own.edges = edges_.data();
  own.clearance = clearance_.data();
  grid_ = toolkit::GridView(own);
  sight_.start(grid_);
}

dmrp_vec2 WayFinder::direction(std::size_t slot, const Person& person) {
  if (slot >= ways_.size()) {
    ways_.resize(slot + 1);
    patches_.resize(slot + 1);
  }
  Way& way = ways_[slot];
  const std::uint32_t cell = grid_.index_of(person.position);
  if (way.person_id != person.id || way.cell != cell || cell == toolkit::no_cell || way.line.to != person.target)
    find_way(slot, person, cell);
  if (way.field != nullptr) {
    const dmrp_vec2 along =
        way.has_patch ? patches_[slot].direction(person.position) : along_field(*way.field, person.position, cell);
    if (along != dmrp_vec2{0.0, 0.0}) return along;
  }
  return toolkit::normalized(person.target - person.position);
}

// Who is pressed out of the free cells walks on beside them while coming back in: the field alone leads to the middle of
// the nearest one, be it backward, and a crowd that presses at a wall would stand still there.
dmrp_vec2 WayFinder::along_field(const toolkit::NavigationField& field, dmrp_vec2 position, std::uint32_t cell) const {
  const dmrp_vec2 along = field.direction(position);
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
  if (sight_.is_free(person.position, person.target, way.line)) return;
  const toolkit::NavigationField& field = field_to_target_of(person);
  const bool cut_off = cell != toolkit::no_cell && grid_.free(cell) && !field.reachable(cell);
  if (cut_off) return;
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
