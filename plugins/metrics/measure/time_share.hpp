// SPDX-License-Identifier: MIT
// time_share.hpp: the share of time in which a condition held. Sums integers, so only the last division rounds.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>

namespace dmrp::metrics {

class TimeShare {
 public:
  void add(bool held, std::int64_t duration_ns) {
    whole_ns_ += duration_ns;
    if (held) part_ns_ += duration_ns;
  }

  // NaN if no time was added.
  double percent() const {
    return whole_ns_ > 0 ? 100.0 * static_cast<double>(part_ns_) / static_cast<double>(whole_ns_) : undefined;
  }

 private:
  std::int64_t part_ns_ = 0;
  std::int64_t whole_ns_ = 0;
};

}  // namespace dmrp::metrics
