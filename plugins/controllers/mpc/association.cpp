// SPDX-License-Identifier: MIT
#include "controllers/mpc/association.hpp"

#include <algorithm>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers::mpc {

void Association::choose(const State& state, double ahead_s, const std::vector<Obstacle>& obstacles,
                         const AssociationRule& rule, const Footprint& footprint) {
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  chosen_.clear();
  Candidate left = {rule.cutoff_m, none};
  Candidate right = {rule.cutoff_m, none};
  const Vec2 robot = toolkit::position(state);
  const Vec2 heading = toolkit::from_angle(state.theta);
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const Obstacle& obstacle = obstacles[i];
    if (least_distance(footprint, robot, obstacle, ahead_s) > rule.cutoff_m) continue;
    const Separation apart = separation(footprint, state, obstacle, ahead_s);
    if (apart.distance_m <= rule.force_inclusion_m) {
      chosen_.push_back({apart.distance_m, i});
      continue;
    }
    // the closest point lies opposite to the gradient
    Candidate& side = toolkit::cross(heading, -apart.gradient) > 0.0 ? left : right;
    if (apart.distance_m < side.distance_m) side = {apart.distance_m, i};
  }
  const auto is_nearer = [](const Candidate& a, const Candidate& b) {
    return a.distance_m < b.distance_m || (a.distance_m == b.distance_m && a.index < b.index);
  };
  if (chosen_.size() > most_obstacles_per_state) {
    std::sort(chosen_.begin(), chosen_.end(), is_nearer);
    chosen_.resize(most_obstacles_per_state);
    std::sort(chosen_.begin(), chosen_.end(), [](const Candidate& a, const Candidate& b) { return a.index < b.index; });
  }
  for (const Candidate& side : {left, right})
    if (side.index != none) chosen_.push_back(side);
}

bool Association::associate(const Trajectory& trajectory, const std::vector<Obstacle>& obstacles,
                            const AssociationRule& rule, Problem& problem) {
  bool differs = false;
  const auto set_size = [&differs](auto& list, std::size_t size) {
    differs = differs || list.size() != size;
    list.resize(size);
  };
  // keeps the lists beyond the trajectory's end, to reuse their memory
  if (problem.obstacles.size() < trajectory.size()) problem.obstacles.resize(trajectory.size());
  set_size(problem.obstacles[0], 0);
  for (std::size_t k = 1; k < trajectory.size(); ++k) {
    choose(trajectory.states[k], static_cast<double>(k) * trajectory.dt_s, obstacles, rule, *problem.footprint);
    std::vector<const Obstacle*>& list = problem.obstacles[k];
    set_size(list, chosen_.size());
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      const Obstacle* obstacle = &obstacles[chosen_[i].index];
      differs = differs || list[i] != obstacle;
      list[i] = obstacle;
    }
  }
  return differs;
}

}  // namespace dmrp::controllers::mpc
