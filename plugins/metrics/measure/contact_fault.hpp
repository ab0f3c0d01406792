// SPDX-License-Identifier: MIT
// contact_fault.hpp: who takes part in a contact and whose fault it is.
#pragma once

#include <dmrp/plugin.hpp>

namespace dmrp::metrics {

inline bool between_robots(const Contact& contact) {
  return contact.kind == DMRP_CONTACT_ROBOT;
}

inline bool begins(const Contact& contact) {
  return (contact.flags & DMRP_CONTACT_BEGINS) != 0;
}

// A contact that nobody could have avoided is no robot's fault, however the robot moved.
inline bool unavoidable(const Contact& contact) {
  return (contact.flags & DMRP_CONTACT_UNAVOIDABLE) != 0;
}

inline bool fault_of_a(const Contact& contact) {
  return (contact.flags & DMRP_CONTACT_FAULT_A) != 0 && !unavoidable(contact);
}

// `b` as a robot; a person's fault is not asked for here.
inline bool fault_of_b(const Contact& contact) {
  return between_robots(contact) && (contact.flags & DMRP_CONTACT_FAULT_B) != 0 && !unavoidable(contact);
}

}  // namespace dmrp::metrics
