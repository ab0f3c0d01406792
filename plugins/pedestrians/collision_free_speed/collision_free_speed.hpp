// SPDX-License-Identifier: MIT
// The collision-free speed model: people turn away from their neighbours and walk as fast as the gap to the nearest
// body in their way permits.
#pragma once

#include <vector>

#include "pedestrians/crowd/crowd_model.hpp"
#include "pedestrians/crowd/side_preference.hpp"
#include "pedestrians/crowd/wall_grid.hpp"

namespace dmrp::pedestrians {

class CollisionFreeSpeed final : public CrowdModel {
 public:
  static Descriptor describe();

  Param<double> time_gap =
      param("time_gap", 0.5).unit("s").range(0.1, 10.0).doc("people take at least this long to cover the gap ahead");
  Param<double> neighbor_strength = param("strength_neighbor_repulsion", 8.0)
                                        .range(0.0, 100.0)
                                        .doc("repulsion of a neighbour in contact, relative to the desired direction");
  Param<double> neighbor_range = param("range_neighbor_repulsion", 0.1)
                                     .unit("m")
                                     .range(0.001, 0.5)
                                     .doc("gap at which the repulsion of a neighbour has fallen to 1/e");
  Param<double> wall_strength = param("strength_geometry_repulsion", 5.0)
                                    .range(0.0, 100.0)
                                    .doc("repulsion of a wall in contact, relative to the desired direction");
  Param<double> wall_range = param("range_geometry_repulsion", 0.02)
                                 .unit("m")
                                 .range(0.001, 0.5)
                                 .doc("gap at which the repulsion of a wall has fallen to 1/e");
  RobotResponse to_robots = robot_response();

  Status start(const Start& start) override;
  Status step(const Crowd& crowd, Motions& motions) override;

 private:
  // A neighbour of a person.
  struct Near {
    Vec2 apart;  // from the person to the neighbour, m
    double gap_m;
    double reach_m;  // sum of the radii
    double weight;
    bool is_ignored;  // by the right of way
  };

  void find_neighbors(const Walker& walker);
  Vec2 wish(const Walker& walker, Vec2 moved);
  double short_of_turning(double speed, Vec2 here, const Walker& walker, double step_s);
  double speed_along(Vec2 direction, const Walker& walker, double step_s) const;
  Vec2 without_wall_contact(Vec2 velocity, const Person& person, double step_s) const;

  double neighbor_reach_m_ = 0.0;  // the repulsion is negligible beyond this gap
  SidePreference side_preference_;
  WallGrid walls_;
  std::vector<Near> near_;              // of the current person
  std::vector<WallPoint> wall_points_;  // of the current person
  std::vector<WallPoint> walls_there_;  // of the current person, once moved
};

}  // namespace dmrp::pedestrians
