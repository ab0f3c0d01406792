// SPDX-License-Identifier: MIT
// trace_records.hpp: iterates over the records of a trace, repeatedly, from memory, a spool or a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include "core/mcap/mcap_reader.hpp"
#include "core/trace/trace.hpp"
#include "core/trace/trace_spool.hpp"

namespace dmrp::core {

struct TraceRecord {
  TraceRecordKind kind{};
  std::size_t offset = 0;  // of the body, in the trace
  std::span<const std::uint8_t> body;
  std::span<const std::uint8_t> whole;  // with its length and kind
};

// A small trace of a file is kept in memory at the first reading; of a larger one no more than a chunk is held, however
// long the trial was.
class TraceRecords {
 public:
  // A larger trace stays in its file. Four robots and twelve people reach this size in ten minutes.
  static constexpr std::size_t small_trace_bytes = std::size_t{1} << 26;

  // `bytes`, the whole trace, must outlive this object.
  explicit TraceRecords(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  // Everything that was written to the spool, which must outlive this object.
  explicit TraceRecords(TraceSpool& spool) : spool_(&spool) { spool.rewind(); }

  // A truncated file ends with its last whole chunk. Throws std::system_error.
  explicit TraceRecords(const std::filesystem::path& file, std::size_t most_bytes_in_memory = small_trace_bytes);

  // The next record, valid until the next call; none after the last. Throws TraceError, and std::system_error.
  std::optional<TraceRecord> next();

  // Starts again with the first record.
  void rewind();

 private:
  std::optional<TraceRecord> next_in_memory();
  std::optional<TraceRecord> next_in_spool();
  std::optional<TraceRecord> next_in_file();
  void keep(std::span<const std::uint8_t> record);

  std::span<const std::uint8_t> bytes_;  // of a trace in memory
  TraceSpool* spool_ = nullptr;          // of a trace in a spool
  std::unique_ptr<McapReader> file_;     // of a trace in a file
  std::size_t most_bytes_in_memory_ = 0;
  bool is_small_ = true;  // so far
  TraceBytes kept_;       // the records read so far, while the trace is small
  std::size_t position_ = 0;
};

}  // namespace dmrp::core
