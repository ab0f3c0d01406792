// SPDX-License-Identifier: MIT
// mcap_writer.hpp: writes a new MCAP file message by message. Throws std::system_error.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <vector>

#include "core/bytes/file.hpp"
#include "core/mcap/mcap.hpp"

namespace dmrp::core {

// Collects messages in chunks and writes each chunk as a whole: after a crash all but the last chunk are readable.
//
//   McapWriter file(path);
//   const std::uint16_t channel = file.add_channel({"robots", "json", file.add_schema(schema), {}});
//   file.write(channel, t_ns, message);
//   file.finish();
class McapWriter {
 public:
  explicit McapWriter(const std::filesystem::path& path);
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  std::uint16_t add_schema(const McapSchema& schema);
  std::uint16_t add_channel(const McapChannel& channel);
  void write(std::uint16_t channel, std::int64_t log_time_ns, std::span<const std::uint8_t> message);

  // Writes the collected messages as a chunk.
  void flush() { write_chunk(); }

  // Writes the last chunk, the index and the end. Without this call the file counts as truncated.
  void finish();

 private:
  using Bytes = std::vector<std::uint8_t>;

  struct TimeRange {
    std::uint64_t first = 0;
    std::uint64_t last = 0;
    bool empty = true;
    void add(std::uint64_t t);
  };
  struct IndexEntry {
    std::uint64_t log_time;
    std::uint64_t offset;  // in the uncompressed chunk
  };

  void write_chunk();
  std::map<std::uint16_t, std::uint64_t> write_message_indexes();  // returns the offset of each channel's index
  void write_summary();
  void put_statistics(Bytes& bytes) const;
  void to_file(const Bytes& bytes);

  std::filesystem::path path_;
  File file_;
  std::uint64_t file_size_ = 0;

  Bytes chunk_;  // records not yet written
  TimeRange chunk_times_;
  std::map<std::uint16_t, std::vector<IndexEntry>> chunk_messages_;  // by channel

  Bytes schemas_;        // records for the summary
  Bytes channels_;       // records for the summary
  Bytes chunk_indexes_;  // records for the summary
  TimeRange file_times_;
  std::map<std::uint16_t, std::uint64_t> message_counts_;  // of every channel
  std::uint16_t schema_count_ = 0;
  std::uint32_t chunk_count_ = 0;
};

}  // namespace dmrp::core
