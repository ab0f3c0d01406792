// SPDX-License-Identifier: MIT
// contact_fault.hpp: the parties of a contact and the fault of each.
#pragma once

#include <dmrp/plugin.hpp>

namespace dmrp::metrics {

// A contact of another kind is skipped.
inline bool is_known(const Contact& contact) {
  return contact.kind == DMRP_CONTACT_STATIC || contact.kind == DMRP_CONTACT_ROBOT ||
         contact.kind == DMRP_CONTACT_PERSON;
}

inline bool between_robots(const Contact& contact) {
  return contact.kind == DMRP_CONTACT_ROBOT;
}

inline bool begins(const Contact& contact) {
  return (contact.flags & DMRP_CONTACT_BEGINS) != 0;
}

inline bool fault_of_a(const Contact& contact) {
  return (contact.flags & DMRP_CONTACT_FAULT_A) != 0;
}

// A robot or a person.
inline bool fault_of_b(const Contact& contact) {
  return (contact.flags & DMRP_CONTACT_FAULT_B) != 0;
}

// NaN: an older host does not know it.
inline double impact_speed(const Sample& sample, const Contact& contact) {
  return DMRP_STRIDE_HAS(Contact, sample.contacts.stride(), impact_speed) ? contact.impact_speed : undefined;
}

}  // namespace dmrp::metrics
