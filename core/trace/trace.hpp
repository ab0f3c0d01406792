// SPDX-License-Identifier: MIT
// trace.hpp: the encoded trace of a trial: what a trial is measured by, live and later alike.
//
// A trace is a sequence of records: the world first, then plans, samples, scans, trajectories and notes as they came about,
// the end last. (A trial that was cut short has no end.) A record is
//
//   u32 length of the body · u8 kind · body
//
// little-endian, unaligned; doubles keep their bits. Concatenated records are the trace; in a file each is one message
// of the channel `dmrp/trace` (mcap_writer.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/bytes/trace_bytes.hpp"

namespace dmrp::core {

inline constexpr std::uint32_t trace_format_version = 1;
inline constexpr const char* trace_topic = "dmrp/trace";  // of a file's channel

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
