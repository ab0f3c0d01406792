// SPDX-License-Identifier: MIT
// The social force model: people accelerate toward where they want to go and away from walls, robots and each other.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <vector>

#include "pedestrians/crowd/groups.hpp"
#include "pedestrians/crowd/neighbor_grid.hpp"
#include "pedestrians/crowd/walkers.hpp"
#include "pedestrians/crowd/wall_grid.hpp"
#include "pedestrians/crowd/way_finding.hpp"
#include "pedestrians/social_force/forces.hpp"

namespace dmrp::pedestrians {

class SocialForce final : public PedestrianModel {
 public:
  static Descriptor describe();

  Param<double> relaxation_time =
      param("relaxation_time", 0.5).unit("s").range(0.05, 10.0).doc("time to take up the desired velocity, weight 1");
  Param<double> time_gap = param("time_gap", 0.5)
                               .unit("s")
                               .range(0.05, 2.0)
                               .doc("people take at least this long to cover the way to those ahead");
  Param<double> desired_weight =
      param("force_factor_desired", 2.0).range(0.0, 100.0).doc("weight of keeping the desired velocity");
  Param<double> social_weight =
      param("force_factor_social", 2.1).range(0.0, 100.0).doc("weight of minding people and robots");
  Param<double> obstacle_weight =
      param("force_factor_obstacle", 10.0).range(0.0, 100.0).doc("weight of keeping off walls and bodies");
  Param<double> obstacle_sigma =
      param("force_sigma_obstacle", 0.2).unit("m").range(0.01, 0.25).doc("range of keeping off walls and bodies");
  Param<double> gaze_weight =
      param("force_factor_group_gaze", 3.0).range(0.0, 100.0).doc("weight of slowing down to see one's group");
  Param<double> cohesion_weight =
      param("force_factor_group_cohesion", 2.0).range(0.0, 100.0).doc("weight of keeping near one's group");
  Param<double> repulsion_weight =
      param("force_factor_group_repulsion", 1.0).range(0.0, 100.0).doc("weight of leaving one's group elbow-room");
  Param<double> lambda =
      param("lambda", 2.0).range(0.0, 10.0).doc("weight of the relative velocity in an interaction's direction");
  Param<double> gamma = param("gamma", 0.35).range(0.01, 5.0).doc("range of an interaction per unit of its strength");
  Param<double> n = param("n", 2.0).range(0.0, 20.0).doc("angular width of turning aside");
  Param<double> n_prime = param("n_prime", 3.0).range(0.0, 20.0).doc("angular width of slowing down");
  Param<double> robot_awareness =
      param("robot_awareness", 1.0).range(0.0, 1.0).doc("how much people mind robots: 1 like people, 0 not at all");
  Param<double> motion_noise =
      param("motion_noise", 0.0).unit("m/s").range(0.0, 1.0).doc("deviation of the speed that chance adds in a second");

  Status start(const World& world, std::uint64_t seed) override;
  Status step(const Crowd& crowd, Vec2* velocities) override;

 private:
  Vec2 acceleration(const Walker& walker, const Span<Person>& people);
  double keeping_off(double gap_m) const;
  Vec2 from_others(const Walker& walker, const Span<Person>& people, double& speed);
  Vec2 from_group(const Walker& walker, const Span<Person>& people, Vec2 desired) const;
  Vec2 from_walls(const Person& person);

  InteractionShape shape_ = {};
  std::uint64_t seed_ = 0;
  WayFinder ways_;
  Groups groups_;
  NeighborGrid neighbors_;
  WallGrid walls_;
  Walkers walkers_;
  std::vector<WallPoint> wall_points_;
};

}  // namespace dmrp::pedestrians
