// SPDX-License-Identifier: MIT
// time_span.hpp: the length of a union of time spans.
#pragma once

#include <algorithm>
#include <cstdint>

namespace dmrp::metrics {

// Spans must be added in the order of their beginnings.
class UnionLength {
 public:
  void add(std::int64_t from_ns, std::int64_t to_ns) {
    length_ns_ += std::max<std::int64_t>(0, to_ns - std::max(from_ns, covered_to_ns_));
    covered_to_ns_ = std::max(covered_to_ns_, to_ns);
  }
  std::int64_t value_ns() const { return length_ns_; }

 private:
  std::int64_t covered_to_ns_ = INT64_MIN;
  std::int64_t length_ns_ = 0;
};

}  // namespace dmrp::metrics
