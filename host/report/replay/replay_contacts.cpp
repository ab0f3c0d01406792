// SPDX-License-Identifier: MIT
#include "host/report/replay/replay_contacts.hpp"

#include <algorithm>

namespace dmrp::host {

void ReplayContacts::observe(const dmrp_sample& sample) {
  for (std::uint32_t i = 0; i < sample.contact_count; ++i) {
    const dmrp_contact& contact = sample.contacts[i];
    const std::uint64_t other = contact.kind == DMRP_CONTACT_PERSON ? sample.people[contact.b].id : contact.b;
    const auto [latest, first_of_pair] = latest_.try_emplace({contact.kind, contact.a, other}, events_.size());
    if (first_of_pair || (contact.flags & DMRP_CONTACT_BEGINS) != 0) {
      latest->second = events_.size();
      events_.push_back({contact.kind, contact.a, other, contact.flags, sample.t_ns, sample.t_ns, 0.0, contact.point,
                         contact.impact_speed});
    }
    ReplayContact& event = events_[latest->second];
    event.to_ns = sample.t_ns;
    event.depth_m = std::max(event.depth_m, contact.depth_m);
  }
}

}  // namespace dmrp::host
