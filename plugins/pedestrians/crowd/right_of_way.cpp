// SPDX-License-Identifier: MIT
#include "pedestrians/crowd/right_of_way.hpp"

#include <algorithm>

namespace dmrp::pedestrians {

namespace {

// Who gets on more slowly than this share of their wish, in a mean that forgets with this time constant, is held up: who stops
// dead is so after 17 s. Stop-and-go waves of a dense crowd are faster.
constexpr double held_up_speed_share = 0.03;
constexpr double held_up_s = 5.0;

}  // namespace

void RightOfWay::begin_step() {
  before_.swap(progress_);
  progress_.clear();
  next_before_ = 0;
}

void RightOfWay::note(const Person& person, dmrp_vec2 way, double step_s) {
  // people move up into the slots of those who leave, but keep their order
  const auto known = std::find_if(before_.begin() + static_cast<std::ptrdiff_t>(next_before_), before_.end(),
                                  [&](const Progress& before) { return before.person_id == person.id; });
  Progress progress = {person.id, person.desired_speed, false, {}};
  if (known != before_.end()) {
    progress = *known;
    next_before_ = static_cast<std::size_t>(known - before_.begin()) + 1;
  }
  progress.speed += (toolkit::dot(person.velocity, way) - progress.speed) * std::min(step_s / held_up_s, 1.0);
  progress.is_held_up = progress.speed < held_up_speed_share * person.desired_speed;
  progress.way = way;
  progress_.push_back(progress);
}

// Of two people one always goes before the other.
bool RightOfWay::goes_before(const Person& one, const Person& other) {
  const double one_m = toolkit::distance(one.position, one.target);
  const double other_m = toolkit::distance(other.position, other.target);
  return one_m < other_m || (one_m == other_m && one.id < other.id);
}

}  // namespace dmrp::pedestrians
