// SPDX-License-Identifier: MIT
// mcap_reader.hpp: reads the messages of one channel of an MCAP file, in the order in which they were written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/bytes/file.hpp"
#include "core/bytes/trace_bytes.hpp"
#include "core/mcap/mcap.hpp"

namespace dmrp::core {

struct McapMessage {
  std::int64_t log_time_ns = 0;
  std::span<const std::uint8_t> data;
};

// Holds one chunk of the file at a time. Reads chunks without compression or with zstd.
//
//   McapReader file(path, "robots");
//   while (const auto message = file.next()) ...
class McapReader {
 public:
  // Throws std::system_error if the file cannot be opened, or is no regular file.
  McapReader(const std::filesystem::path& path, std::string topic);

  // The next message of the channel `topic`, valid until the next call; none after the last. A truncated file ends with
  // its last whole chunk. Throws TraceError if the file is damaged, and std::system_error if it cannot be read.
  std::optional<McapMessage> next();

  // Starts again with the first message.
  void rewind();

  // After the last message: whether the file is complete, not truncated.
  bool is_whole() const { return is_whole_; }

 private:
  void begin();
  bool magic_follows();
  void read(std::vector<std::uint8_t>& bytes, std::uint64_t count);
  void skip_to(std::uint64_t position);
  bool read_record();
  void open_chunk(ByteCursor in);
  std::optional<McapMessage> next_in_chunk();
  void take_channel(ByteCursor in);
  std::optional<McapMessage> take_message(ByteCursor in) const;

  std::filesystem::path path_;
  std::string topic_;
  File file_;
  std::uint64_t size_ = 0;      // of the file at the start of reading
  std::uint64_t position_ = 0;  // in the file
  bool begun_ = false;
  bool ended_ = false;
  bool is_whole_ = false;
  std::set<std::uint16_t> channels_;  // of the topic
  McapOpcode opcode_{};               // of the last record outside chunks
  std::vector<std::uint8_t> record_;  // its body
  std::vector<std::uint8_t> chunk_;   // decompressed
  std::size_t chunk_position_ = 0;
};

}  // namespace dmrp::core
