// SPDX-License-Identifier: MIT
#include "core/world/contact_events.hpp"

#include <algorithm>
#include <cassert>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>

namespace dmrp::core {
namespace {

bool is_at_fault(dmrp_vec2 velocity, dmrp_vec2 toward_other) {
  return toolkit::norm(velocity) >= rest_speed && toolkit::dot(velocity, toward_other) >= 0.0;
}

}  // namespace

void ContactTracker::update(std::int64_t t_ns, const ContactBodies& bodies, std::span<const dmrp_vec2> normals,
                            std::span<dmrp_contact> contacts) {
  assert(normals.size() == contacts.size());
  assert(robots_.empty() || bodies.robots.size() == robots_.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    dmrp_contact& contact = contacts[i];
    const std::uint64_t b = contact.kind == DMRP_CONTACT_PERSON ? bodies.people[contact.b].id : contact.b;
    const auto [event, is_first] = events_.try_emplace(Pair(contact.kind, contact.a, b));
    const bool begins = is_first || t_ns - event->second.last_ns >= event_gap_ns;
    contact.impact_speed = std::numeric_limits<double>::quiet_NaN();
    if (begins) {
      const dmrp_vec2 velocity_a = velocity_of_robot(contact.a, contact.point, bodies);
      const dmrp_vec2 velocity_b = velocity_of_b(contact, b, bodies);
      event->second.fault = (is_at_fault(velocity_a, -normals[i]) ? DMRP_CONTACT_FAULT_A : 0u) |
                            (is_at_fault(velocity_b, normals[i]) ? DMRP_CONTACT_FAULT_B : 0u);
      contact.impact_speed = std::max(0.0, toolkit::dot(velocity_b - velocity_a, normals[i]));
    }
    event->second.last_ns = t_ns;
    contact.flags = event->second.fault | (begins ? DMRP_CONTACT_BEGINS : 0u);
  }
  robots_.assign(bodies.robots.begin(), bodies.robots.end());
  people_.assign(bodies.people.begin(), bodies.people.end());
  turning_.assign(bodies.turning.begin(), bodies.turning.end());
}

dmrp_vec2 ContactTracker::velocity_of_robot(std::uint32_t robot, dmrp_vec2 point, const ContactBodies& bodies) const {
  const dmrp_agent& body = robots_.empty() ? bodies.robots[robot] : robots_[robot];
  const double turning = robot < turning_.size() ? turning_[robot] : 0.0;
  return body.velocity + turning * toolkit::perpendicular(point - toolkit::position(body.pose));
}

// A wall is at rest. A person who was not there before has the present velocity.
dmrp_vec2 ContactTracker::velocity_of_b(const dmrp_contact& contact, std::uint64_t id,
                                        const ContactBodies& bodies) const {
  if (contact.kind == DMRP_CONTACT_STATIC) return {0.0, 0.0};
  if (contact.kind == DMRP_CONTACT_ROBOT) return velocity_of_robot(contact.b, contact.point, bodies);
  const auto before =
      std::find_if(people_.begin(), people_.end(), [id](const dmrp_agent& person) { return person.id == id; });
  return before != people_.end() ? before->velocity : bodies.people[contact.b].velocity;
}

}  // namespace dmrp::core
