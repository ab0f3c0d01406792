// SPDX-License-Identifier: MIT
// canonical_records.hpp: the records of a trace in a form that depends neither on clocks nor on the format version.
#pragma once

#include <cstdint>
#include <span>

#include "core/bytes/trace_bytes.hpp"

namespace dmrp::core {

// The form is that of format version 1 without its walking grid, with 0 for what a clock measured: planning_ns of
// plans, duration_ns of calls. What version 1 does not have is left out, but for a footprint of several polygons.
class CanonicalRecords {
 public:
  // The next record of the trace, with its length and kind. Throws TraceError.
  TraceBytes next(std::span<const std::uint8_t> record);

 private:
  std::uint32_t version_ = 0;  // of the trace's format; from the world, the first record
};

}  // namespace dmrp::core
