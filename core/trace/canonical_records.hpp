// SPDX-License-Identifier: MIT
// canonical_records.hpp: the records of a trace in a form that does not depend on clocks.
#pragma once

#include <cstdint>
#include <span>

#include "core/bytes/trace_bytes.hpp"

namespace dmrp::core {

// A record of a trace, with its length and kind, and 0 for what a clock measured: planning_ns and processor_ns of plans,
// duration_ns of calls. Fields that this program does not know are left out. Throws TraceError.
TraceBytes canonical_record(std::span<const std::uint8_t> record);

}  // namespace dmrp::core
