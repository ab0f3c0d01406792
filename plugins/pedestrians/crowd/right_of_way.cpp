// SPDX-License-Identifier: MIT
#include "right_of_way.hpp"

#include <algorithm>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::pedestrians {

namespace {

// Who is slower than this share of their wish, on average over about so long, is held up. Stop-and-go waves of a dense
// crowd are faster.
constexpr double held_up_speed_share = 0.03;
constexpr double held_up_s = 5.0;

}  // namespace

void RightOfWay::update(const Span<Person>& people, double step_s) {
  before_.swap(progress_);
  progress_.clear();
  auto next = before_.begin();
  for (const Person& person : people) {
    // people move up into the slots of those who leave, but keep their order
    const auto known =
        std::find_if(next, before_.end(), [&](const Progress& before) { return before.person_id == person.id; });
    Progress progress = {person.id, {person.desired_speed, 0.0}, false};
    if (known != before_.end()) {
      progress = *known;
      next = known + 1;
    }
    progress.velocity += (person.velocity - progress.velocity) * std::min(step_s / held_up_s, 1.0);
    progress.is_held_up = toolkit::norm(progress.velocity) < held_up_speed_share * person.desired_speed;
    progress_.push_back(progress);
  }
}

// Of two people one always goes before the other.
bool RightOfWay::goes_before(const Person& one, const Person& other) {
  const double one_m = toolkit::distance(one.position, one.target);
  const double other_m = toolkit::distance(other.position, other.target);
  return one_m < other_m || (one_m == other_m && one.id < other.id);
}

}  // namespace dmrp::pedestrians
