// SPDX-License-Identifier: MIT
// mcap.hpp: definitions for the writer and the reader of MCAP files (https://mcap.dev/spec): time-stamped messages on
// channels, in compressed chunks, with an index at the end. Written by hand: Debian packages no MCAP library for C++.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace dmrp::core {

inline constexpr std::array<std::uint8_t, 8> mcap_magic{0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};

enum class McapOpcode : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  statistics = 0x0B,
  summary_offset = 0x0E,
  data_end = 0x0F
};

// Every record begins with its opcode and the length of the rest as u64.
inline constexpr std::size_t mcap_record_prefix_bytes = 9;

inline constexpr const char* mcap_compression = "zstd";

struct McapSchema {
  std::string name;      // for example "foxglove.SceneUpdate"
  std::string encoding;  // for example "jsonschema"
  std::string data;
};

struct McapChannel {
  std::string topic;
  std::string message_encoding;  // for example "json"
  std::uint16_t schema_id = 0;   // from McapWriter::add_schema; 0: none
  std::map<std::string, std::string> metadata;
};

}  // namespace dmrp::core
