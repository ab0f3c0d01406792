// SPDX-License-Identifier: MIT
// association.hpp: which obstacles each state of the trajectory has to keep away from.
#ifndef DMRP_CONTROLLERS_MPC_ASSOCIATION_HPP
#define DMRP_CONTROLLERS_MPC_ASSOCIATION_HPP

#include "controllers/mpc/problem.hpp"

namespace dmrp::controllers::mpc {

struct AssociationRule {
  double force_inclusion_m = 0.5;  // every obstacle nearer than this counts ...
  double cutoff_m = 2.5;           // ... none beyond this, and in between the nearest on the left and on the right
};

// More obstacles than this are not looked at in one state: the nearest are.
inline constexpr std::size_t most_obstacles_a_state = 12;

class Association {
 public:
  void reserve(std::size_t obstacles) { chosen_.reserve(obstacles); }

  // Fills problem.obstacles for this trajectory. True where the lists differ from those there were.
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

#endif
