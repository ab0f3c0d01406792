// SPDX-License-Identifier: MIT
// Directions to targets: straight where the target is in sight, otherwise around furniture and through doors.
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

// The grid that the scenario's people walk on. Throws if there is none.
const Grid& walking_grid(const dmrp_walking_grid& extension, const World& world);

// All people with the same target area share one navigation field, computed when the first of them needs it. Fields
// depend only on the grid and the area, so they stay valid over trials on the same grid.
class WayFinder {
 public:
  WayFinder() = default;
  WayFinder(const WayFinder&) = delete;
  WayFinder& operator=(const WayFinder&) = delete;

  void start(const Grid& grid);

  const toolkit::GridView& grid() const { return grid_; }

  // The desired direction of the person in this slot, a unit vector; zero on the target. Leads straight to the target
  // where no way exists.
  Vec2 direction(std::size_t slot, const Person& person);

 private:
  struct Place {
    std::uint32_t target_id;
    toolkit::Rectangle area;
    toolkit::NavigationField field;
  };

  // A person's way. Valid until the person enters another cell or gets another target.
  struct Way {
    std::uint64_t person_id = 0;
    std::uint32_t cell = toolkit::no_cell;
    bool has_patch = false;                           // patches_ holds the part of the field for this cell
    const toolkit::NavigationField* field = nullptr;  // null: straight
    SightLine sight_line;                             // to the target
  };

  Vec2 along_field(const toolkit::NavigationField& field, Vec2 position, std::uint32_t cell) const;
  bool is_known(const Grid& grid) const;
  void copy(const Grid& grid);
  void find_way(std::size_t slot, const Person& person, std::uint32_t cell);
  const toolkit::NavigationField& field_to_target_of(const Person& person);

  toolkit::GridView grid_;  // of the arrays below
  LineOfSight line_of_sight_;
  std::vector<std::uint8_t> free_;
  std::vector<std::uint8_t> edges_;
  std::vector<float> clearance_;
  std::deque<Place> places_;                              // addresses are stable
  std::vector<Way> ways_;                                 // by slot
  std::vector<toolkit::NavigationField::Patch> patches_;  // by slot; kept apart because most people walk straight
};

}  // namespace dmrp::pedestrians
