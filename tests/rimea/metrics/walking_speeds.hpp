// SPDX-License-Identifier: MIT
// walking_speeds.hpp: people's speeds over an interval: the distance between their positions at its ends, divided by
// its length. So swaying in place does not count as walking.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <map>
#include <optional>

namespace dmrp::rimea {

class WalkingSpeeds {
 public:
  void clear() { before_.clear(), now_.clear(); }

  // Stores the positions of all people. Call it once an interval.
  void update(const Span<Person>& people);

  // The speed over the last interval; nothing for people who were absent at its beginning.
  std::optional<double> speed(const Person& person, double interval_s) const;

 private:
  std::map<std::uint64_t, Vec2> before_;  // by id
  std::map<std::uint64_t, Vec2> now_;
};

}  // namespace dmrp::rimea
