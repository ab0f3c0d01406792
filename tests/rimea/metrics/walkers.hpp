// SPDX-License-Identifier: MIT
// walkers.hpp: how fast people walk: the way between where they are and where they were one interval ago over the
// interval, so that swaying on the spot does not count as walking.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <map>
#include <optional>

namespace dmrp::rimea {

class Walkers {
 public:
  void clear() { before_.clear(), now_.clear(); }

  // Positions of all people, one interval after the last ones.
  void update(const Span<Person>& people);

  // Speed over the last interval; nothing of somebody who was not there at its beginning.
  std::optional<double> speed(const Person& person, double interval_s) const;

 private:
  std::map<std::uint64_t, Vec2> before_;  // by id
  std::map<std::uint64_t, Vec2> now_;
};

}  // namespace dmrp::rimea
