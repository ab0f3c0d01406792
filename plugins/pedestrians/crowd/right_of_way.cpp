// SPDX-License-Identifier: MIT
#include "pedestrians/crowd/right_of_way.hpp"

#include <algorithm>

namespace dmrp::pedestrians {

namespace {

// Shares of the desired speed: below the first people become blocked, above the second they are free again. With one
// threshold for both, a step ahead would free them, and the others would turn them back.
constexpr double blocked_speed_share = 0.03;
constexpr double free_speed_share = 0.09;
constexpr double time_constant_s = 5.0;

}  // namespace

void RightOfWay::begin_step() {
  before_.swap(progress_);
  progress_.clear();
  next_before_ = 0;
}

void RightOfWay::update(const Person& person, Vec2 way, double step_s) {
  // when people leave, the others move to lower slots but keep their order
  const auto known = std::find_if(before_.begin() + static_cast<std::ptrdiff_t>(next_before_), before_.end(),
                                  [&](const Progress& before) { return before.person_id == person.id; });
  Progress progress = {person.id, person.desired_speed, false, {}};
  if (known != before_.end()) {
    progress = *known;
    next_before_ = static_cast<std::size_t>(known - before_.begin()) + 1;
  }
  progress.mean_speed +=
      (toolkit::dot(person.velocity, way) - progress.mean_speed) * std::min(step_s / time_constant_s, 1.0);
  const double share = progress.is_blocked ? free_speed_share : blocked_speed_share;
  progress.is_blocked = progress.mean_speed < share * person.desired_speed;
  progress.way = way;
  progress_.push_back(progress);
}

// The shorter way to the target decides, then the lower id. So of two people exactly one has priority.
bool RightOfWay::has_priority(const Person& one, const Person& other) {
  const double one_m = toolkit::distance(one.position, one.target);
  const double other_m = toolkit::distance(other.position, other.target);
  return one_m < other_m || (one_m == other_m && one.id < other.id);
}

}  // namespace dmrp::pedestrians
