// SPDX-License-Identifier: MIT
// The social force model: people accelerate toward their targets and away from walls, robots and each other.
#pragma once

#include <cstdint>
#include <vector>

#include "pedestrians/crowd/crowd_model.hpp"
#include "pedestrians/crowd/groups.hpp"
#include "pedestrians/crowd/wall_grid.hpp"

namespace dmrp::pedestrians {

// The shape of the interaction between two people.
struct InteractionShape {
  double lambda;   // weight of the relative velocity, compared with the direction to the other person
  double gamma;    // range of the interaction per unit of that sum, m
  double n;        // angular width of the turning force
  double n_prime;  // angular width of the decelerating force
};

class SocialForce final : public CrowdModel {
 public:
  static Descriptor describe();

  Param<double> relaxation_time = param("relaxation_time", 0.5)
                                      .unit("s")
                                      .range(0.05, 10.0)
                                      .doc("time constant of reaching the desired velocity at weight 1");
  Param<double> time_gap = param("time_gap", 0.5)
                               .unit("s")
                               .range(0.05, 2.0)
                               .doc("people take at least this long to cover the gap to the body ahead");
  Param<double> desired_weight =
      param("force_factor_desired", 2.0).range(0.0, 100.0).doc("weight of the force toward the desired velocity");
  Param<double> social_weight =
      param("force_factor_social", 2.1).range(0.0, 100.0).doc("weight of the interaction with people and robots");
  Param<double> obstacle_weight =
      param("force_factor_obstacle", 10.0).range(0.0, 100.0).doc("weight of the repulsion from walls and bodies");
  Param<double> obstacle_sigma = param("force_sigma_obstacle", 0.2)
                                     .unit("m")
                                     .range(0.01, 0.25)
                                     .doc("range of the repulsion from walls and bodies");
  Param<double> gaze_weight =
      param("force_factor_group_gaze", 3.0).range(0.0, 100.0).doc("weight of slowing down to keep the group in view");
  Param<double> cohesion_weight =
      param("force_factor_group_cohesion", 2.0).range(0.0, 100.0).doc("weight of staying close to the group");
  Param<double> repulsion_weight =
      param("force_factor_group_repulsion", 1.0).range(0.0, 100.0).doc("weight of keeping a gap to group members");
  Param<double> lambda =
      param("lambda", 2.0).range(0.0, 10.0).doc("weight of the relative velocity in the direction of an interaction");
  Param<double> gamma = param("gamma", 0.35).range(0.01, 5.0).doc("range of an interaction per unit of its strength");
  Param<double> n = param("n", 2.0).range(0.0, 20.0).doc("angular width of the turning force");
  Param<double> n_prime = param("n_prime", 3.0).range(0.0, 20.0).doc("angular width of the decelerating force");
  RobotResponse to_robots = robot_response();
  Param<double> motion_noise = param("motion_noise", 0.0)
                                   .unit("m/s")
                                   .range(0.0, 1.0)
                                   .doc("standard deviation of the random velocity added in one second");

  Status start(const Start& start) override;
  Status step(const Crowd& crowd, Motions& motions) override;

 private:
  Vec2 acceleration(const Walker& walker, const Span<Person>& people);
  double repulsion(double gap_m) const;
  Vec2 force_of_neighbors(const Walker& walker, const Span<Person>& people, double& speed);
  Vec2 force_of_group(const Walker& walker, const Span<Person>& people, Vec2 desired) const;
  Vec2 force_of_walls(const Person& person);

  InteractionShape shape_ = {};
  std::uint64_t seed_ = 0;
  Groups groups_;
  WallGrid walls_;
  std::vector<WallPoint> wall_points_;
};

}  // namespace dmrp::pedestrians
