// SPDX-License-Identifier: MIT
// Optimal reciprocal collision avoidance: people take the velocity nearest to the one they wish for that keeps them
// clear of each other, of robots and of walls for a while, as long as all do their share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <dmrp/plugin.hpp>
#include <vector>

#include "pedestrians/crowd/leanings.hpp"
#include "pedestrians/crowd/neighbor_grid.hpp"
#include "pedestrians/crowd/walkers.hpp"
#include "pedestrians/crowd/way_finding.hpp"
#include "pedestrians/orca/half_plane.hpp"
#include "pedestrians/orca/linear_program.hpp"
#include "pedestrians/orca/wall_obstacles.hpp"

namespace dmrp::pedestrians {

class Orca final : public PedestrianModel {
 public:
  static Descriptor describe();

  Param<double> neighbor_distance =
      param("neighbor_distance", 5.0).unit("m").range(0.5, 50.0).doc("others further away are not minded");
  Param<std::int64_t> max_neighbors =
      param("max_neighbors", std::int64_t{10}).range(1, 100).doc("so many others are minded, the nearest");
  Param<double> time_horizon =
      param("time_horizon", 3.0).unit("s").range(0.1, 20.0).doc("people keep clear of others for this time");
  Param<double> time_horizon_obst =
      param("time_horizon_obst", 0.15).unit("s").range(0.05, 20.0).doc("people keep clear of walls for this time");
  Param<double> robot_awareness =
      param("robot_awareness", 1.0).range(0.0, 1.0).doc("how much people mind robots: 1 like people, 0 not at all");

  Status start(const World& world, std::uint64_t seed) override;
  Status step(const Crowd& crowd, Vec2* velocities) override;

 private:
  // How many there are.
  std::size_t find_neighbors(std::uint32_t slot, Vec2 position, const Span<Person>& people);
  HalfPlane permitted_beside(const Body& other, const Person& person, double step_s) const;
  static Vec2 preferred_velocity(Vec2 way, const Person& person, double step_s);

  WayFinder ways_;
  Leanings leanings_;
  NeighborGrid grid_;
  WallObstacles walls_;
  VelocityProgram program_;
  Walkers walkers_;
  std::vector<NearBody> neighbors_;  // nearest first; by id where distances are equal
  std::vector<HalfPlane> planes_;
};

}  // namespace dmrp::pedestrians
