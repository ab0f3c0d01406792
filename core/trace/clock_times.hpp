// SPDX-License-Identifier: MIT
// clock_times.hpp: what clocks measured in the records of a trace, by the list of fields of the schema.
#pragma once

#include <cstdint>
#include <span>

#include "core/bytes/trace_bytes.hpp"

namespace dmrp::core {

// A record of a trace, with its length and kind, and 0 for each `clock` of its list of fields. Throws TraceError.
TraceBytes without_clock_times(std::span<const std::uint8_t> record);

}  // namespace dmrp::core
