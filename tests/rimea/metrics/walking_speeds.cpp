// SPDX-License-Identifier: MIT
#include "tests/rimea/metrics/walking_speeds.hpp"

#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::rimea {

void WalkingSpeeds::update(const Span<Person>& people) {
  before_.swap(now_);
  now_.clear();
  for (const Person& person : people) now_[person.id] = person.position;
}

std::optional<double> WalkingSpeeds::speed(const Person& person, double interval_s) const {
  const auto before = before_.find(person.id);
  if (before == before_.end()) return std::nullopt;
  return toolkit::distance(person.position, before->second) / interval_s;
}

}  // namespace dmrp::rimea
