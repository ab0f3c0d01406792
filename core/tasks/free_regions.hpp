// SPDX-License-Identifier: MIT
// free_regions.hpp: the rooms of a world, and which of them a planning grid cuts off from its drawn tasks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/scene/planning_grids.hpp"
#include "core/scene/static_geometry.hpp"

namespace dmrp::core {

// The robots that tasks are drawn for, as TaskRequest has them.
struct DrawnFor {
  std::vector<std::string> types;  // none: the default type
  std::vector<dmrp_vec2> inside;
};

// Whether some free cells hang together neither with the cells that tasks are drawn on nor with the open edge of a map:
// where not, nothing is cut off.
bool has_other_parts(const PlanningGrid& grid, std::span<const dmrp_vec2> inside);

// Regions are what the robots can reach and what is in one piece after all ways are closed that cells of these settings
// may miss: those narrower than the robot, the margin and a cell. A hall that most regions adjoin, and that tasks are
// drawn in, is none of them.
class FreeRegions {
 public:
  // Looks at the finest of the resolutions that gives at most `most_cells` cells.
  FreeRegions(const StaticGeometry& geometry, const RobotTypes& types, const SimulationSettings& settings,
              const DrawnFor& drawn, std::span<const double> resolutions_m, double most_cells);

  std::size_t count() const { return counted_; }

  // How many of them hold no cell of the part of this grid that tasks are drawn on.
  std::size_t missed(const PlanningGrid& grid) const;

 private:
  std::vector<bool> reached(const PlanningGrid& grid) const;
  void find_regions(const std::vector<std::uint32_t>& part, double open_m, double niche_m2);
  void spread(std::size_t near_steps);
  bool is_hall(std::size_t region) const;

  DrawnFor drawn_;
  PlanningGrid fine_;
  std::vector<std::uint32_t> region_;      // by fine cell; at first of the open ones, then of the nearest
  std::vector<bool> is_near_;              // by fine cell: within half a cell of the open ones
  std::vector<std::vector<bool>> adjoin_;  // by two regions
  std::size_t hall_;                       // the index of no region if there is none
  std::size_t counted_ = 0;
};

}  // namespace dmrp::core
