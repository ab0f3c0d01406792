// SPDX-License-Identifier: MIT
// trace.hpp: the format of a trial's trace, the only input of metrics for live and stored trials.
//
// A trace is a sequence of records: first the world, then plans, samples, scans, trajectories and notes in order of
// time, last the end. (The trace of an interrupted trial has no end record.) A record is
//
//   u32 length of the body · u8 kind · body
//
// little-endian, unaligned; doubles keep their bits. The trace is the concatenation of its records; in a file each
// record is one message of the channel `dmrp/trace` (mcap_writer.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/bytes/trace_bytes.hpp"

namespace dmrp::core {

inline constexpr std::uint32_t trace_format_version = 1;
inline constexpr const char* trace_topic = "dmrp/trace";  // of the channel in a file

enum class TraceRecordKind : std::uint8_t {
  world = 1,
  plan = 2,
  sample = 3,
  trajectory = 4,
  note = 5,
  end = 6,
  scan = 7
};

inline constexpr std::size_t trace_record_prefix_bytes = 5;  // length and kind

}  // namespace dmrp::core
