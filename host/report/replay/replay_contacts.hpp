// SPDX-License-Identifier: MIT
// replay_contacts.hpp: turns the contacts of samples into events with beginning and end.
#pragma once

#include <dmrp/sample.h>

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

namespace dmrp::host {

struct ReplayContact {
  std::uint32_t kind = 0;   // DMRP_CONTACT_*
  std::uint32_t robot = 0;  // `a` of the contact in the trace
  std::uint64_t other = 0;  // `b`; the id, not the index, of a person
  std::uint32_t flags = 0;  // DMRP_CONTACT_*, of the first sample
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;     // of the last sample
  double depth_m = 0.0;       // maximum
  dmrp_vec2 point{};          // at the beginning
  double impact_speed = 0.0;  // m/s; NaN: not known
};

// Expects every sample in order.
class ReplayContacts {
 public:
  void observe(const dmrp_sample& sample);
  const std::vector<ReplayContact>& events() const { return events_; }  // by beginning

 private:
  using Pair = std::tuple<std::uint32_t, std::uint32_t, std::uint64_t>;  // kind, robot, other

  std::vector<ReplayContact> events_;
  std::map<Pair, std::size_t> latest_;  // index of the pair's last event
};

}  // namespace dmrp::host
