// SPDX-License-Identifier: MIT
// Where people should turn to reach their targets: round furniture, through doors, straight where the way is clear.
#pragma once

#include <cstddef>
#include <cstdint>
#include <dmrp/cpp/pedestrian_model.hpp>
#include <dmrp/toolkit/grid_view.hpp>
#include <vector>

namespace dmrp::pedestrians {

// Everybody heads for a point in sight: the target itself, or else the farthest point in sight of the shortest way
// there over the walking grid. Those points are worked out once for every place and cell, when first asked for.
class WayFinder {
 public:
  // The grid must live until the next start().
  void start(const dmrp_grid& walking_grid);

  // The unit vector in which the person in this slot should set out; zero on the target.
  dmrp_vec2 direction(std::size_t slot, const Person& person);

 private:
  // The ways to one target area, from everywhere.
  struct Place {
    std::uint32_t target_id;
    dmrp_vec2 area_lower;
    dmrp_vec2 area_upper;
    std::vector<double> distance_m;          // of every cell from the area; infinite where there is no way
    std::vector<std::uint32_t> heading_for;  // of every cell: the cell to head for; no_cell: not worked out yet
  };

  // What a person heads for, until another cell or another target.
  struct Heading {
    std::uint64_t person_id;
    std::uint32_t target_id;
    std::uint32_t cell;
    dmrp_vec2 target;
    dmrp_vec2 point;
  };

  dmrp_vec2 point_to_head_for(const Person& person, std::uint32_t cell);
  Place& place_of(const Person& person);
  std::uint32_t cell_to_head_for(Place& place, std::uint32_t from) const;
  std::uint32_t nearest_reached_cell(const Place& place, dmrp_vec2 position) const;

  toolkit::GridView grid_;
  std::vector<Place> places_;
  std::vector<Heading> headings_;  // by slot
};

}  // namespace dmrp::pedestrians
