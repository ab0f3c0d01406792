// SPDX-License-Identifier: MIT
#include "core/mcap/mcap_reader.hpp"

#include <zstd.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <cerrno>
#include <system_error>
#include <utility>

namespace dmrp::core {
namespace {

// A damaged file must not make us allocate whatever it says. Writers end chunks at a few megabytes.
constexpr std::uint64_t largest_chunk_bytes = std::uint64_t{1} << 28;

void decompress(const ByteCursor& in, std::span<const std::uint8_t> compressed, std::uint64_t size,
                std::vector<std::uint8_t>& records) {
  if (size > largest_chunk_bytes || ZSTD_getFrameContentSize(compressed.data(), compressed.size()) != size)
    in.fail("a chunk of another size than it says");
  records.resize(size);
  if (ZSTD_decompress(records.data(), records.size(), compressed.data(), compressed.size()) != size)
    in.fail("a chunk that does not decompress");
}

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw std::system_error(errno != 0 ? errno : EIO, std::generic_category(), path.string());
}

}  // namespace

McapReader::McapReader(const std::filesystem::path& path, std::string topic)
    : path_(path), topic_(std::move(topic)), file_(path, std::ios::binary) {
  if (!file_) fail(path_);
}

void McapReader::rewind() {
  begun_ = false;
  ended_ = false;
  is_whole_ = false;
  channels_.clear();
  chunk_.clear();
  chunk_position_ = 0;
}

std::optional<McapMessage> McapReader::next() {
  if (!begun_) begin();
  for (;;) {
    while (chunk_position_ < chunk_.size())
      if (auto message = next_in_chunk()) return message;
    if (ended_ || !read_record()) return std::nullopt;
    const ByteCursor in(record_, position_ - record_.size());
    if (opcode_ == McapOpcode::channel) take_channel(in);
    if (opcode_ == McapOpcode::chunk) open_chunk(in);
    if (opcode_ != McapOpcode::message) continue;
    if (auto message = take_message(in)) return message;
  }
}

// How long it is, and whether it is one at all.
void McapReader::begin() {
  begun_ = true;
  file_.clear();
  file_.seekg(0, std::ios::end);
  size_ = static_cast<std::uint64_t>(file_.tellg());
  file_.seekg(0);
  position_ = 0;
  if (!file_) fail(path_);
  if (size_ < mcap_magic.size() || !magic_follows()) throw TraceError(0, "not an MCAP file");
}

bool McapReader::magic_follows() {
  read(record_, mcap_magic.size());
  return std::equal(mcap_magic.begin(), mcap_magic.end(), record_.begin());
}

void McapReader::read(std::vector<std::uint8_t>& bytes, std::uint64_t count) {
  bytes.resize(count);
  file_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count));
  if (!file_) fail(path_);
  position_ += count;
}

void McapReader::skip_to(std::uint64_t position) {
  file_.seekg(static_cast<std::streamoff>(position));
  if (!file_) fail(path_);
  position_ = position;
}

// The next record outside chunks, of those that matter; false where there is none, or not all of it.
bool McapReader::read_record() {
  while (size_ - position_ >= mcap_record_prefix_bytes) {
    read(record_, mcap_record_prefix_bytes);
    ByteCursor prefix(record_);
    opcode_ = prefix.take<McapOpcode>();
    const auto length = prefix.take<std::uint64_t>();
    if (length > size_ - position_) break;
    if (opcode_ == McapOpcode::data_end) {
      skip_to(size_ - mcap_magic.size());
      is_whole_ = magic_follows();
      break;
    }
    if (opcode_ == McapOpcode::channel || opcode_ == McapOpcode::message || opcode_ == McapOpcode::chunk) {
      if (opcode_ == McapOpcode::chunk && length > 2 * largest_chunk_bytes)
        throw TraceError(position_, "a chunk of more than anybody writes");
      read(record_, length);
      return true;
    }
    skip_to(position_ + length);
  }
  ended_ = true;
  return false;
}

void McapReader::open_chunk(ByteCursor in) {
  in.take<std::uint64_t>();  // first and ...
  in.take<std::uint64_t>();  // ... last log time
  const auto size = in.take<std::uint64_t>();
  const auto checksum = in.take<std::uint32_t>();
  const std::string_view compression = in.take_text();
  const auto compressed = in.take_bytes(in.take<std::uint64_t>());
  if (compression == mcap_compression)
    decompress(in, compressed, size, chunk_);
  else if (compression.empty())
    chunk_.assign(compressed.begin(), compressed.end());
  else
    in.fail("a chunk compressed by '" + std::string(compression) + "'");
  boost::crc_32_type crc;
  if (checksum != 0) crc.process_bytes(chunk_.data(), chunk_.size());
  if (checksum != 0 && crc.checksum() != checksum) in.fail("a chunk with a wrong checksum");
  chunk_position_ = 0;
}

// Goes on by one record in the chunk; its message, if it is one of the topic.
std::optional<McapMessage> McapReader::next_in_chunk() {
  ByteCursor in(std::span<const std::uint8_t>(chunk_).subspan(chunk_position_), chunk_position_);
  const auto opcode = in.take<McapOpcode>();
  const ByteCursor body = in.part(in.take<std::uint64_t>());
  chunk_position_ = in.position();
  if (opcode == McapOpcode::chunk) in.fail("a chunk within a chunk");
  if (opcode == McapOpcode::channel) take_channel(body);
  return opcode == McapOpcode::message ? take_message(body) : std::nullopt;
}

void McapReader::take_channel(ByteCursor in) {
  const auto id = in.take<std::uint16_t>();
  in.take<std::uint16_t>();  // schema
  if (in.take_text() == topic_) channels_.insert(id);
}

std::optional<McapMessage> McapReader::take_message(ByteCursor in) const {
  const auto id = in.take<std::uint16_t>();
  in.take<std::uint32_t>();  // sequence
  const auto log_time = in.take<std::int64_t>();
  in.take<std::int64_t>();  // publish time
  if (channels_.count(id) == 0) return std::nullopt;
  return McapMessage{log_time, in.rest()};
}

}  // namespace dmrp::core
