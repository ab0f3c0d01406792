// SPDX-License-Identifier: MIT
// The collision-free speed model: people turn away from those near them, and go as fast as the gap to whoever is in
// their way permits.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <vector>

#include "pedestrians/crowd/leanings.hpp"
#include "pedestrians/crowd/neighbor_grid.hpp"
#include "pedestrians/crowd/walkers.hpp"
#include "pedestrians/crowd/wall_grid.hpp"
#include "pedestrians/crowd/way_finding.hpp"

namespace dmrp::pedestrians {

class CollisionFreeSpeed final : public PedestrianModel {
 public:
  static Descriptor describe();

  Param<double> time_gap =
      param("time_gap", 0.5).unit("s").range(0.1, 10.0).doc("people take this long to cover the gap before them");
  Param<double> neighbor_strength = param("strength_neighbor_repulsion", 8.0)
                                        .range(0.0, 100.0)
                                        .doc("how hard people turn away from whom they touch, against their wish of 1");
  Param<double> neighbor_range = param("range_neighbor_repulsion", 0.1)
                                     .unit("m")
                                     .range(0.001, 0.5)
                                     .doc("over this gap turning away from others fades to 1/e");
  Param<double> wall_strength =
      param("strength_geometry_repulsion", 5.0)
          .range(0.0, 100.0)
          .doc("how hard people turn away from walls that they touch, against their wish of 1");
  Param<double> wall_range = param("range_geometry_repulsion", 0.02)
                                 .unit("m")
                                 .range(0.001, 0.5)
                                 .doc("over this gap turning away from walls fades to 1/e");
  Param<double> robot_awareness =
      param("robot_awareness", 1.0).range(0.0, 1.0).doc("how much people mind robots: 1 like people, 0 not at all");

  Status start(const World& world, std::uint64_t seed) override;
  Status step(const Crowd& crowd, Vec2* velocities) override;

 private:
  // A body near somebody, seen by them.
  struct Near {
    Vec2 apart;  // from them to it, m
    double gap_m;
    double reach_m;  // sum of the radii
    double weight;
    bool gives_way;  // is not turned away from
  };

  void look_around(const Walker& walker, const Span<Person>& people);
  Vec2 direction(const Walker& walker);
  double speed_along(Vec2 direction, const Walker& walker, double step_s) const;
  Vec2 kept_off_walls(Vec2 velocity, const Person& person, double step_s) const;

  double neighbor_reach_m_ = 0.0;  // beyond this gap nobody is turned away from
  WayFinder ways_;
  Leanings leanings_;
  NeighborGrid neighbors_;
  WallGrid walls_;
  Walkers walkers_;
  std::vector<Near> near_;              // to the person whose turn it is
  std::vector<WallPoint> wall_points_;  // likewise
};

}  // namespace dmrp::pedestrians
