// SPDX-License-Identifier: MIT
// Which way people turn to reach their targets: straight where the way is clear, else round furniture, through doors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <dmrp/cpp/pedestrian_model.hpp>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/navigation_field.hpp>
#include <vector>

#include "pedestrians/crowd/line_of_sight.hpp"

namespace dmrp::pedestrians {

// Shares one navigation field among all who walk to the same place; it is computed when somebody first needs it. Fields
// depend on the grid and the place alone, so they are kept over trials on the same grid.
class WayFinder {
 public:
  WayFinder() = default;
  WayFinder(const WayFinder&) = delete;
  WayFinder& operator=(const WayFinder&) = delete;

  void start(const dmrp_grid& walking_grid);

  // The unit vector in which the person in this slot should set out; zero on the target. Where no way leads to the
  // target: straight at it.
  dmrp_vec2 direction(std::size_t slot, const Person& person);

 private:
  struct Place {
    std::uint32_t target_id;
    toolkit::Rectangle area;
    toolkit::NavigationField field;
  };

  // What was found out about a person's way; true until they walk into another cell or get another target.
  struct Way {
    std::uint64_t person_id = 0;
    std::uint32_t cell = toolkit::no_cell;
    bool has_patch = false;                           // of the field, in patches_
    const toolkit::NavigationField* field = nullptr;  // null: straight
    LineOfSight line;                                 // to the target
  };

  dmrp_vec2 along_field(const toolkit::NavigationField& field, dmrp_vec2 position, std::uint32_t cell) const;
  bool is_known(const dmrp_grid& grid) const;
  void copy(const dmrp_grid& grid);
  void find_way(std::size_t slot, const Person& person, std::uint32_t cell);
  const toolkit::NavigationField& field_to_target_of(const Person& person);

  toolkit::GridView grid_;  // of the arrays below
  Sight sight_;
  std::vector<std::uint8_t> free_;
  std::vector<std::uint8_t> edges_;
  std::vector<float> clearance_;
  std::deque<Place> places_;                              // never move
  std::vector<Way> ways_;                                 // by slot
  std::vector<toolkit::NavigationField::Patch> patches_;  // likewise; apart, as most walk straight
};

}  // namespace dmrp::pedestrians
