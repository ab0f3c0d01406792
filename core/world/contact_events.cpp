// SPDX-License-Identifier: MIT
#include "core/world/contact_events.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::core {
namespace {

dmrp_vec2 position_of(const dmrp_agent& agent) {
  return toolkit::position(agent.pose);
}

// The component of mover's velocity toward `other`, m/s.
double speed_toward(const dmrp_agent& mover, const dmrp_agent& other) {
  return toolkit::dot(mover.velocity, toolkit::normalized(position_of(other) - position_of(mover)));
}

// Whether the two will touch at constant velocities.
bool on_collision_course(const dmrp_agent& one, const dmrp_agent& two) {
  const dmrp_vec2 apart = position_of(two) - position_of(one);
  const dmrp_vec2 velocity = two.velocity - one.velocity;
  const double touching_m = one.radius_m + two.radius_m;
  if (toolkit::squared_norm(apart) <= touching_m * touching_m) return true;
  const double squared_speed = toolkit::squared_norm(velocity);
  const double approach = -toolkit::dot(apart, velocity);
  if (!(approach > 0.0)) return false;
  // their least distance, on the line of relative motion
  const double aside = toolkit::cross(apart, velocity);
  return aside * aside <= touching_m * touching_m * squared_speed;
}

}  // namespace

// The memory covers braking that ends in the fault window.
ContactTracker::ContactTracker(std::vector<Braking> robots, Sight sight)
    : robots_(std::move(robots)), sight_(std::move(sight)) {
  for (const Braking& robot : robots_)
    memory_ns_ = std::max<std::int64_t>(memory_ns_, fault_window_ns +
                                                        std::llround(1e9 * robot.v_max / (full_braking * robot.a_max)) +
                                                        robot.latency_ns + sight_.control_period_ns);
}

void ContactTracker::update(std::int64_t t_ns, std::span<const dmrp_agent> robots, std::span<const dmrp_agent> people,
                            std::span<dmrp_contact> contacts) {
  assert(robots.size() == robots_.size());
  assert(history_.empty() || t_ns > history_.back().t_ns);
  for (dmrp_contact& contact : contacts) {
    const std::uint64_t b = contact.kind == DMRP_CONTACT_PERSON ? people[contact.b].id : contact.b;
    const auto [event, is_first] = events_.try_emplace(Pair(contact.kind, contact.a, b));
    const bool begins = is_first || t_ns - event->second.last_ns >= event_gap_ns;
    if (begins) event->second.fault = fault_of(contact, b, t_ns);
    event->second.last_ns = t_ns;
    contact.flags = event->second.fault | (begins ? DMRP_CONTACT_BEGINS : 0u);
  }

  // store the bodies, reusing the buffers of moments that are no longer needed
  Moment moment;
  while (history_.size() > 1 && history_[1].t_ns <= t_ns - memory_ns_) {
    moment = std::move(history_.front());
    history_.pop_front();
  }
  moment.t_ns = t_ns;
  moment.robots.assign(robots.begin(), robots.end());
  moment.people.assign(people.begin(), people.end());
  history_.push_back(std::move(moment));
}

std::uint32_t ContactTracker::fault_of(const dmrp_contact& contact, std::uint64_t b, std::int64_t t_ns) const {
  if (contact.kind == DMRP_CONTACT_STATIC) return DMRP_CONTACT_FAULT_A;
  const Motion motion = motion_before(contact, b, t_ns);
  if (contact.kind == DMRP_CONTACT_ROBOT)
    return (motion.a_moved ? DMRP_CONTACT_FAULT_A : 0u) | (motion.b_moved ? DMRP_CONTACT_FAULT_B : 0u);
  const bool is_robots = motion.a_moved && !braked_at_once(contact, b);
  return (is_robots ? DMRP_CONTACT_FAULT_A : DMRP_CONTACT_FAULT_B) |
         (was_unavoidable(contact, b, t_ns, motion.a_speed) ? DMRP_CONTACT_UNAVOIDABLE : 0u);
}

const dmrp_agent* ContactTracker::body_b(const Moment& moment, const dmrp_contact& contact, std::uint64_t b) {
  if (contact.kind == DMRP_CONTACT_ROBOT) return &moment.robots[contact.b];
  if (contact.b < moment.people.size() && moment.people[contact.b].id == b) return &moment.people[contact.b];
  // indices changed since then
  const auto person =
      std::find_if(moment.people.begin(), moment.people.end(), [b](const dmrp_agent& agent) { return agent.id == b; });
  return person != moment.people.end() ? &*person : nullptr;
}

ContactTracker::Motion ContactTracker::motion_before(const dmrp_contact& contact, std::uint64_t b,
                                                     std::int64_t t_ns) const {
  Motion motion;
  for (const Moment& moment : history_) {
    if (moment.t_ns < t_ns - fault_window_ns) continue;
    const dmrp_agent& robot = moment.robots[contact.a];
    const dmrp_agent* const other = body_b(moment, contact, b);
    if (other == nullptr) continue;
    motion.a_speed = std::max(motion.a_speed, toolkit::norm(robot.velocity));
    motion.a_moved = motion.a_moved || speed_toward(robot, *other) > fault_speed;
    motion.b_moved = motion.b_moved || speed_toward(*other, robot) > fault_speed;
  }
  return motion;
}

// Since the first tick at which the person was in sight until now.
bool ContactTracker::braked_at_once(const dmrp_contact& contact, std::uint64_t b) const {
  const auto is_seen = [&](const Moment& moment) {
    const dmrp_agent* const person = body_b(moment, contact, b);
    return person != nullptr &&
           (!sight_.sees || sight_.sees(contact.a, position_of(moment.robots[contact.a]), position_of(*person)));
  };
  std::size_t first = history_.size();
  while (first > 0 && is_seen(history_[first - 1])) --first;
  while (first < history_.size() && sight_.control_period_ns > 0 &&
         history_[first].t_ns % sight_.control_period_ns != 0)
    ++first;
  if (first == history_.size()) return true;  // no tick since: the robot could not react

  const Braking& robot = robots_[contact.a];
  const std::int64_t reacts_ns = history_[first].t_ns + robot.latency_ns;
  for (std::size_t i = first; i + 1 < history_.size(); ++i) {
    if (history_[i].t_ns < reacts_ns) continue;
    const double before = toolkit::norm(history_[i].robots[contact.a].velocity);
    const double after = toolkit::norm(history_[i + 1].robots[contact.a].velocity);
    const double step_s = 1e-9 * static_cast<double>(history_[i + 1].t_ns - history_[i].t_ns);
    if (after > std::max(before - full_braking * robot.a_max * step_s, standing_m_s)) return false;
  }
  return true;
}

bool ContactTracker::was_unavoidable(const dmrp_contact& contact, std::uint64_t b, std::int64_t t_ns,
                                     double speed) const {
  const Braking& robot = robots_[contact.a];
  const std::int64_t then_ns = t_ns - std::llround(1e9 * speed / robot.a_max) - robot.latency_ns;
  // the latest moment at least a braking time ago, or the first one
  for (auto moment = history_.rbegin(); moment != history_.rend(); ++moment) {
    if (moment->t_ns > then_ns && std::next(moment) != history_.rend()) continue;
    const dmrp_agent* const person = body_b(*moment, contact, b);
    return person != nullptr && !on_collision_course(moment->robots[contact.a], *person);
  }
  return false;
}

}  // namespace dmrp::core
