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
//
// The body of a world begins with the format version. The format grows as the plugin contract does (abi.h):
//
//   growable struct               a block: u32 length · its fields in order. A body is a block too
//   array of elements             u32 count · u32 stride · the elements as in memory
//   ... that point to something   u32 count · each element as a block
//
// New fields are appended to a block or an element. A reader takes an element's missing fields as the contract's absent
// values and skips those that it does not know. A new kind of record or any other change of the layout makes a new
// format version; this program reads one version alone.
//
// A route, which continues the one before of its robot, is stored as what differs: how many waypoints it keeps, and those
// that follow.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/bytes/trace_bytes.hpp"

namespace dmrp::core {

inline constexpr std::uint32_t trace_format_version = 4;
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
