// SPDX-License-Identifier: MIT
// trace_spool.hpp: a trace too large for memory while it is measured: written once, read as often as there are metrics.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>

#include "core/trace/trace.hpp"

namespace dmrp::core {

// In a file without a name, which is gone with the process. From sample to sample little changes, of a person the
// position and the velocity: of a record only those words (8 bytes) are written that differ from the same words of the
// last record of its kind, 64 of them after a u64 that has a bit for each. That is as small as zstd makes it, and is
// read at the speed of memory. Throws std::system_error.
class TraceSpool {
 public:
  // `path`: where there is room; the name goes at once.
  explicit TraceSpool(const std::filesystem::path& path);
  TraceSpool(const TraceSpool&) = delete;
  TraceSpool& operator=(const TraceSpool&) = delete;

  // A whole record, with its length and kind.
  void write(std::span<const std::uint8_t> record);

  // From now on records are read, the first one next.
  void rewind();

  // The next record, valid until the next call; none after the last.
  std::optional<std::span<const std::uint8_t>> next();

 private:
  TraceBytes& last_of_kind(const std::uint8_t* prefix);
  bool fill(std::size_t bytes);
  void write_buffer();

  std::filesystem::path path_;
  std::fstream file_;
  bool is_written_ = false;
  TraceBytes buffer_;               // what is not yet in the file, or was read of it
  std::size_t position_ = 0;        // in the buffer, of what is to be read next
  std::array<TraceBytes, 8> last_;  // records, by kind
};

}  // namespace dmrp::core
