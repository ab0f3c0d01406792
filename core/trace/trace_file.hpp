// SPDX-License-Identifier: MIT
// trace_file.hpp: a trace as a file, traces/trial_000000.mcap: its records on a channel of their own, and beside it
// channels for people to look at.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "core/foxglove/foxglove_channels.hpp"
#include "core/mcap/mcap_writer.hpp"
#include "core/trace/trace.hpp"

namespace dmrp::core {

// Writes records as the encoder makes them. Throws std::system_error.
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

  // Lets what was written so far outlive the process.
  void flush() { mcap_.flush(); }
  void finish() { mcap_.finish(); }

 private:
  McapWriter mcap_;
  std::uint16_t channel_;
  FoxgloveChannels foxglove_;
};

}  // namespace dmrp::core
