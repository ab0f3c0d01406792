// SPDX-License-Identifier: MIT
// association.hpp: assigns to each state of a trajectory the obstacles that constrain it.
#pragma once

#include "controllers/mpc/problem.hpp"

namespace dmrp::controllers::mpc {

struct AssociationRule {
  double force_inclusion_m = 0.5;  // every obstacle closer than this constrains the state
  double cutoff_m = 2.5;           // and the closest one on the left and on the right, up to this distance
};

// At most this many obstacles are included by force in one state: the closest ones.
inline constexpr std::size_t most_obstacles_per_state = 12;

class Association {
 public:
  void reserve(std::size_t obstacles) { chosen_.reserve(obstacles); }

  // Fills problem.obstacles for a trajectory. True if the lists differ from the previous ones.
  bool associate(const Trajectory& trajectory, const std::vector<Obstacle>& obstacles, const AssociationRule& rule,
                 Problem& problem);

 private:
  struct Candidate {
    double distance_m;
    std::size_t index;
  };
  void choose(const State& state, double ahead_s, const std::vector<Obstacle>& obstacles, const AssociationRule& rule,
              const Footprint& footprint);

  std::vector<Candidate> chosen_;
};

}  // namespace dmrp::controllers::mpc
