// SPDX-License-Identifier: MIT
#include "pedestrians/crowd/reactions.hpp"

#include <stdexcept>

namespace dmrp::pedestrians {

void Reactions::start(std::uint64_t seed, const toolkit::GridView& grid, bool is_on, double robot_awareness,
                      const ReactionShares& shares) {
  is_on_ = is_on;
  leaves_out_own_ = false;
  robot_awareness_ = robot_awareness;
  right_of_way_.start();
  past_robots_.start(seed, grid);
  to_robots_.start(seed, grid, shares);
  if (!is_on && to_robots_.any_share())
    throw std::invalid_argument("shares of people who react to robots need reactions = \"on\"");
}

void Reactions::begin_step() {
  right_of_way_.begin_step();
  past_robots_.begin_step();
  to_robots_.begin_step();
}

Wish Reactions::wish(const Person& person, Vec2 way, const Span<Agent>& robots, double step_s) {
  const std::uint32_t reaction = to_robots_.of(person);
  Wish wish = {way, person.desired_speed, robot_awareness_};
  if (reaction == DMRP_REACTION_REGULAR) wish.robot_weight = 1.0;
  if (reaction == DMRP_REACTION_IMPASSIVE) wish.robot_weight = 0.0;
  if (!is_on_) {
    leaves_out_own_ = leaves_out_own_ || is_answer(reaction);
    return wish;
  }
  if (const auto answer = to_robots_.answer(reaction, person, way, robots, step_s)) {
    wish.way = answer->way;
    wish.speed = answer->speed;
  } else if (wish.robot_weight > 0.0) {
    wish.way = past_robots_.direction(person, way, robots, step_s);
  }
  right_of_way_.update(person, wish.way, step_s);
  return wish;
}

}  // namespace dmrp::pedestrians
