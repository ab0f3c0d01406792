// SPDX-License-Identifier: MIT
// ban.hpp: the constraints that the high level puts on agents which can be in conflict on different cells.
#pragma once

#include <span>
#include <vector>

#include "planners/large_agents/fleet.hpp"

namespace dmrp::planners {

// What `agent` must not do. The kinds that name an `other` agent forbid all that is in conflict with what that one does:
// the multi-constraints of Li et al. 2019. A split forbids one agent a single place or step, and the other agent all
// that conflicts with it; so each plan without conflicts obeys one of the two.
struct Ban {
  enum class Kind : std::uint8_t {
    place,         // being at `to` at time t
    step,          // the step from `from` that arrives at `to` at time t
    places_near,   // being, at time t, where `other` at `to` excludes it
    steps_near,    // a step that arrives at time t and conflicts with that of `other` from `from` to `to`
    rest_near,     // from time t on, all that conflicts with `other`, which stands at `to`; on all agents but `other`
    finish_by,     // coming to rest at time t or before (target reasoning, Li et al. 2020)
    finish_after,  // coming to rest after time t
  };

  Kind kind = Kind::place;
  AgentIndex agent = -1;  // of rest_near: -1
  AgentIndex other = -1;
  Location from = nowhere;
  Location to = nowhere;
  std::int32_t t = 0;

  bool binds(AgentIndex which) const { return kind == Kind::rest_near ? which != other : which == agent; }
};

// The bans on one agent, by time.
class BanTable {
 public:
  explicit BanTable(const Fleet& fleet) : fleet_(fleet) {}

  void fill(AgentIndex agent, std::span<const Ban> bans);

  // Whether the agent may step from `from` to `to`, arriving at time t.
  bool allows(Location from, Location to, std::int32_t t) const;

  // The first and the last time at which the agent may come to rest at its goal; forever if it never may.
  std::int32_t finish_from() const { return finish_from_; }
  std::int32_t finish_until() const { return finish_until_; }

  // From this time on the bans do not change.
  std::int32_t constant_from() const { return constant_from_; }

 private:
  bool breaks(const Ban& ban, Location from, Location to, std::int32_t t) const;
  void note_finish(const Ban& ban);

  const Fleet& fleet_;
  AgentIndex agent_ = -1;
  std::vector<std::vector<Ban>> at_time_;
  std::vector<Ban> rests_;  // of kind rest_near
  std::int32_t constant_from_ = 0;
  std::int32_t finish_from_ = 0;
  std::int32_t finish_until_ = forever;
};

}  // namespace dmrp::planners
