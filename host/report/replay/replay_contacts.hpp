// SPDX-License-Identifier: MIT
// replay_contacts.hpp: contacts of a trial as events, from their flags in the trace.
#pragma once

#include <dmrp/metric.h>

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

namespace dmrp::host {

struct ReplayContact {
  std::uint32_t kind = 0;   // DMRP_CONTACT_*
  std::uint32_t robot = 0;  // a of the trace's contact
  std::uint64_t other = 0;  // b; of a person the id, not the index
  std::uint32_t flags = 0;  // DMRP_CONTACT_*, of its first sample
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;  // of its last sample
  double depth_m = 0.0;    // the deepest
  dmrp_vec2 point{};       // where it began
};

// Given every sample in order, tells the events apart.
class ReplayContacts {
 public:
  void observe(const dmrp_sample& sample);
  const std::vector<ReplayContact>& events() const { return events_; }  // in order of their beginning

 private:
  using Pair = std::tuple<std::uint32_t, std::uint32_t, std::uint64_t>;  // kind, robot, other

  std::vector<ReplayContact> events_;
  std::map<Pair, std::size_t> latest_;  // index of the pair's last event
};

}  // namespace dmrp::host
