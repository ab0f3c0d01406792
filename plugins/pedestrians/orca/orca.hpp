// SPDX-License-Identifier: MIT
// Optimal reciprocal collision avoidance: people choose the velocity nearest to their preferred one that avoids
// collisions with people, robots and walls within a time horizon, provided that all do their share.
#pragma once

#include <cstddef>
#include <vector>

#include "pedestrians/crowd/crowd_model.hpp"
#include "pedestrians/crowd/side_preference.hpp"
#include "pedestrians/orca/wall_obstacles.hpp"
#include "reciprocal/half_plane.hpp"
#include "reciprocal/linear_program.hpp"

namespace dmrp::pedestrians {

class Orca final : public CrowdModel {
 public:
  static Descriptor describe();

  Param<double> neighbor_distance =
      param("neighbor_distance", 5.0).unit("m").range(0.5, 50.0).doc("people ignore neighbours farther away");
  Param<int> max_neighbors =
      param("max_neighbors", 10).range(1, 100).doc("people consider at most this many neighbours, the nearest ones");
  Param<double> time_horizon = param("time_horizon", 3.0)
                                   .unit("s")
                                   .range(0.1, 20.0)
                                   .doc("people avoid collisions with neighbours within this time");
  Param<double> time_horizon_obst = param("time_horizon_obst", 0.15)
                                        .unit("s")
                                        .range(0.05, 20.0)
                                        .doc("people avoid collisions with walls within this time");
  RobotResponse to_robots = robot_response();

  Status start(const Start& start) override;
  Status step(const Crowd& crowd, Motions& motions) override;

 private:
  // Fills neighbors_ and returns their number.
  std::size_t find_neighbors(const Walker& walker, const Span<Person>& people);
  reciprocal::HalfPlane permitted_by(const Neighbor& other, const Person& person, double step_s) const;
  static Vec2 preferred_velocity(Vec2 way, const Person& person, double step_s);

  SidePreference side_preference_;
  WallObstacles walls_;
  reciprocal::VelocityProgram program_;
  std::vector<Neighbor> neighbors_;  // nearest first; by id where distances are equal
  std::vector<reciprocal::HalfPlane> planes_;
};

}  // namespace dmrp::pedestrians
