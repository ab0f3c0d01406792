// SPDX-License-Identifier: MIT
// trace_file.hpp: writes a trace file, traces/trial_000000.mcap: one channel with the records of the trace, and
// channels for visualisation.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "core/foxglove/foxglove_channels.hpp"
#include "core/mcap/mcap_writer.hpp"
#include "core/trace/trace.hpp"

namespace dmrp::core {

// Writes the records of an encoder. Throws std::system_error.
//
//   TraceFileWriter file(path);
//   TraceEncoder trace(world, [&](std::int64_t t_ns, auto record) { file.write(t_ns, record); }, &file.foxglove());
//   ...
//   file.finish();
class TraceFileWriter {
 public:
  explicit TraceFileWriter(const std::filesystem::path& path);

  void write(std::int64_t t_ns, std::span<const std::uint8_t> record) { mcap_.write(channel_, t_ns, record); }
  FoxgloveChannels& foxglove() { return foxglove_; }

  // Passes all records so far to the file, so that they survive the process.
  void flush() { mcap_.flush(); }
  void finish() { mcap_.finish(); }

 private:
  McapWriter mcap_;
  std::uint16_t channel_;
  FoxgloveChannels foxglove_;
};

}  // namespace dmrp::core
