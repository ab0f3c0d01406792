// SPDX-License-Identifier: MIT
#include "controllers/oracle/oracle.hpp"

#include <algorithm>
#include <dmrp/toolkit/vec2.hpp>
#include <iterator>

namespace dmrp::controllers {

namespace {

// People farther from the robot do not matter to its trajectory.
constexpr double near_m = 10.0;

Span<Agent> people_of(const dmrp_people_frame& frame) {
  return {frame.people, frame.count, frame.stride};
}

const Agent* find(Span<Agent> people, std::uint64_t id) {
  const auto found = std::find_if(people.begin(), people.end(), [id](const Agent& person) { return person.id == id; });
  return found == people.end() ? nullptr : &*found;
}

}  // namespace

Descriptor Oracle::describe() {
  return describe_controller("dmrp.controller.oracle", "Oracle")
      .summary("MPC that is told where people will be: what perfect prediction is worth, no controller for robots")
      .source("a baseline without a publication")
      .kinematics(1u << DMRP_KINEMATICS_DIFFERENTIAL | 1u << DMRP_KINEMATICS_HOLONOMIC |
                  1u << DMRP_KINEMATICS_ACKERMANN)
      .flags(DMRP_FLAG_BACKWARDS)
      .needs(DMRP_EXT_LOCAL_COSTMAP)
      .needs(DMRP_EXT_OBSTACLE_CLUSTERS)
      .needs(DMRP_DRAFT_PEOPLE_FUTURE)
      .uses(DMRP_EXT_ANNOTATE);
}

Status Oracle::start(const Start& start) {
  future_ = &extension<dmrp_people_future>();
  strayed_.clear();
  return Mpc::start(start);
}

void Oracle::foresee(const Observation& now, std::vector<Obstacle>& obstacles) {
  const Span<Agent> recorded = people_of(*future_->at(future_, 0));
  // the ways are pointed to: no reallocation below
  ways_.clear();
  ways_.reserve((recorded.size() + now.agents.size()) * (future_->last + 2));
  seen_.clear();
  std::size_t place = obstacles.size() - now.agents.size();
  for (const Agent& agent : now.agents) {
    Obstacle& obstacle = obstacles[place++];
    if (agent.kind != DMRP_AGENT_PERSON) continue;
    seen_.push_back(agent.id);
    const Agent* there = find(recorded, agent.id);
    if (!there) continue;
    if (toolkit::distance(toolkit::position(there->pose), toolkit::position(agent.pose)) > told_within) {
      if (!has_strayed(agent.id))
        strayed_.insert(std::lower_bound(strayed_.begin(), strayed_.end(), agent.id), agent.id);
    } else {
      follow_record(*there, seconds(now.dt_ns), obstacle);
    }
  }
  add_unseen(now, obstacles);
}

bool Oracle::has_strayed(std::uint64_t person) const {
  return std::binary_search(strayed_.begin(), strayed_.end(), person);
}

// As far as the person is in the record: it may leave.
void Oracle::follow_record(const Agent& person, double period_s, Obstacle& obstacle) {
  const Vec2 from = toolkit::position(person.pose);
  const auto first = static_cast<std::ptrdiff_t>(ways_.size());
  for (std::uint32_t i = 0; i <= future_->last; ++i) {
    const Agent* there = find(people_of(*future_->at(future_, i)), person.id);
    if (!there) break;
    ways_.push_back(toolkit::position(there->pose) - from);
    obstacle.velocity = there->velocity;
  }
  obstacle.way = &*std::next(ways_.begin(), first);
  obstacle.way_count = static_cast<std::uint32_t>(ways_.size() - static_cast<std::size_t>(first));
  obstacle.way_period_s = period_s;
}

// People whom the robot does not see, where the record has them; none who has left it.
void Oracle::add_unseen(const Observation& now, std::vector<Obstacle>& obstacles) {
  for (const Agent& person : people_of(*future_->at(future_, 0))) {
    const Vec2 at = toolkit::position(person.pose);
    const bool is_seen = std::find(seen_.begin(), seen_.end(), person.id) != seen_.end();
    if (is_seen || has_strayed(person.id) || toolkit::distance(at, toolkit::position(now.pose)) > near_m) continue;
    ways_.push_back(at);
    Obstacle& obstacle = obstacles.emplace_back();
    obstacle.vertices = &ways_.back();
    obstacle.vertex_count = 1;
    obstacle.center = at;
    obstacle.radius_m = person.radius_m;
    obstacle.is_agent = true;
    follow_record(person, seconds(now.dt_ns), obstacle);
  }
}

}  // namespace dmrp::controllers
