// SPDX-License-Identifier: MIT
// trace_spool.hpp: temporary storage on disk for a trace too large for memory: written once, read once per metric.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "core/bytes/file.hpp"
#include "core/trace/trace.hpp"

namespace dmrp::core {

// Uses an unlinked file, which disappears with the process. Little changes between samples (the position and velocity
// of a person), so only those words (8 bytes) of a record are written that differ from the previous record of its kind,
// in groups of up to 64 after a u64 with one bit for each. This is as small as zstd's result and is read at the speed
// of memory. Throws std::system_error.
class TraceSpool {
 public:
  // `path`: a new file in a folder with enough space; it is unlinked at once.
  explicit TraceSpool(const std::filesystem::path& path);

  // A spool that another process has written, to be read; takes the descriptor over. Processes that have it from one another
  // read it in turns: each begins with rewind().
  explicit TraceSpool(int descriptor);

  TraceSpool(const TraceSpool&) = delete;
  TraceSpool& operator=(const TraceSpool&) = delete;

  // A whole record, with its length and kind.
  void write(std::span<const std::uint8_t> record);

  int descriptor() const;

  // Ends writing. The next record to read is the first.
  void rewind();

  // The next record, valid until the next call; none after the last.
  std::optional<std::span<const std::uint8_t>> next();

 private:
  TraceBytes& last_of_kind(const std::uint8_t* prefix);
  bool fill(std::size_t bytes);
  void write_buffer();

  std::filesystem::path path_;
  File file_;
  bool is_written_ = false;
  TraceBytes buffer_;               // bytes to write, or bytes that were read
  std::size_t position_ = 0;        // in the buffer, of the next byte to read
  std::array<TraceBytes, 8> last_;  // the previous record of each kind
};

}  // namespace dmrp::core
