// SPDX-License-Identifier: MIT
// sent_world.hpp: copies in an arena of what plugins are shown, with all that it points to.
#pragma once

#include <dmrp/ext/distance_field.h>
#include <dmrp/ext/lidar.h>
#include <dmrp/ext/local_costmap.h>
#include <dmrp/ext/obstacle_clusters.h>
#include <dmrp/global_planner.h>
#include <dmrp/observation.h>
#include <dmrp/trial_end.h>
#include <dmrp/world.h>

#include <map>

#include "host/guests/exchange/arena.hpp"

namespace dmrp::host {

// The copies of grids, by the array `free` of the original.
using SentGrids = std::map<const std::uint8_t*, const dmrp_grid*>;

// A world in an arena.
class SentWorld {
 public:
  SentWorld(Arena& arena, const dmrp_world& world);

  // Copies no grid again that `shared` has, which is of the same static geometry.
  SentWorld(Arena& arena, const dmrp_world& world, const SentWorld& shared);

  const dmrp_world& world() const { return *world_; }

  // Copies the grid, unless it has a copy. The copy stays as long as the world's.
  const dmrp_grid* add_grid(Arena& arena, const dmrp_grid& grid);

  // The copy of a grid; nullptr if it has none.
  const dmrp_grid* find_grid(const dmrp_grid& grid) const;

  // `problem` of this world.
  const dmrp_planning_problem* copy(Arena& arena, const dmrp_planning_problem& problem) const;

  // `observation` of a robot of this world.
  dmrp_observation copy(Arena& arena, const dmrp_observation& observation) const;

 private:
  void copy_all(Arena& arena, const dmrp_world& world);

  dmrp_world* world_;
  SentGrids grids_;
};

const dmrp_path* sent_paths(Arena& arena, const dmrp_path* paths, std::uint32_t count, std::uint32_t stride);
const dmrp_trial_end* sent(Arena& arena, const dmrp_trial_end& end);
const dmrp_scan* sent(Arena& arena, const dmrp_scan& scan);
const dmrp_costmap* sent(Arena& arena, const dmrp_costmap& costmap);
const dmrp_field* sent(Arena& arena, const dmrp_field& field);
const dmrp_obstacle_cluster_list* sent(Arena& arena, const dmrp_obstacle_cluster_list& clusters);

}  // namespace dmrp::host
