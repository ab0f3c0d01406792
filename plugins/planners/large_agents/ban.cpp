// SPDX-License-Identifier: MIT
#include "planners/large_agents/ban.hpp"

#include <algorithm>

namespace dmrp::planners {

void BanTable::fill(AgentIndex agent, std::span<const Ban> bans) {
  agent_ = agent;
  at_time_.clear();
  rests_.clear();
  constant_from_ = 0;
  finish_from_ = 0;
  finish_until_ = forever;
  for (const Ban& ban : bans) {
    if (!ban.binds(agent)) continue;
    note_finish(ban);
    constant_from_ = std::max(constant_from_, ban.t + 1);
    if (ban.kind == Ban::Kind::rest_near) {
      rests_.push_back(ban);
    } else if (ban.kind != Ban::Kind::finish_by && ban.kind != Ban::Kind::finish_after) {
      const auto t = static_cast<std::size_t>(ban.t);
      if (at_time_.size() <= t) at_time_.resize(t + 1);
      at_time_[t].push_back(ban);
    }
  }
}

bool BanTable::allows(Location from, Location to, std::int32_t t) const {
  const auto is_broken = [&](const Ban& ban) { return breaks(ban, from, to, t); };
  if (static_cast<std::size_t>(t) < at_time_.size()) {
    const std::vector<Ban>& now = at_time_[static_cast<std::size_t>(t)];
    if (std::any_of(now.begin(), now.end(), is_broken)) return false;
  }
  return std::none_of(rests_.begin(), rests_.end(), is_broken);
}

bool BanTable::breaks(const Ban& ban, Location from, Location to, std::int32_t t) const {
  switch (ban.kind) {
    case Ban::Kind::place:
      return to == ban.to;
    case Ban::Kind::step:
      return from == ban.from && to == ban.to;
    case Ban::Kind::places_near:
      return fleet_.exclude(agent_, to, ban.other, ban.to);
    case Ban::Kind::steps_near:
      return fleet_.clash(agent_, from, to, ban.other, ban.from, ban.to) != Clash::none;
    case Ban::Kind::rest_near:
      if (t < ban.t) return false;
      if (t == ban.t) return fleet_.exclude(agent_, to, ban.other, ban.to);
      return fleet_.clash(agent_, from, to, ban.other, ban.to, ban.to) != Clash::none;
    default:
      return false;
  }
}

// What the ban means for an agent that rests at its goal.
void BanTable::note_finish(const Ban& ban) {
  if (ban.kind == Ban::Kind::finish_by) {
    finish_from_ = std::max(finish_from_, ban.t + 1);
  } else if (ban.kind == Ban::Kind::finish_after) {
    finish_until_ = std::min(finish_until_, ban.t);
  } else if (const Location goal = fleet_.agents[static_cast<std::size_t>(agent_)].last_goal();
             breaks(ban, goal, goal, ban.t)) {
    if (ban.kind == Ban::Kind::rest_near) {
      finish_from_ = forever;
    } else {
      // an agent that arrives in a step has not rested in it
      const bool is_step = ban.kind == Ban::Kind::step || ban.kind == Ban::Kind::steps_near;
      finish_from_ = std::max(finish_from_, is_step ? ban.t : ban.t + 1);
    }
  }
}

}  // namespace dmrp::planners
