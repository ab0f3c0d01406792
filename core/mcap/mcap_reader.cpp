// SPDX-License-Identifier: MIT
#include "core/mcap/mcap_reader.hpp"

#include <zstd.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <utility>

namespace dmrp::core {
namespace {

// A limit on allocations for damaged files. Writers end chunks at a few megabytes.
constexpr std::uint64_t largest_chunk_bytes = std::uint64_t{1} << 28;

void decompress(const ByteCursor& in, std::span<const std::uint8_t> compressed, std::uint64_t size,
                std::vector<std::uint8_t>& records) {
  if (size > largest_chunk_bytes || ZSTD_getFrameContentSize(compressed.data(), compressed.size()) != size)
    in.fail("the size of the chunk differs from its header");
  records.resize(size);
  if (ZSTD_decompress(records.data(), records.size(), compressed.data(), compressed.size()) != size)
    in.fail("the chunk cannot be decompressed");
}

}  // namespace

McapReader::McapReader(const std::filesystem::path& path, std::string topic)
    : path_(path), topic_(std::move(topic)), file_(open_file(path, Links::refused)) {}

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

// Finds the size of the file and checks its first bytes.
void McapReader::begin() {
  begun_ = true;
  if (fseeko(file_.get(), 0, SEEK_END) != 0) throw_file_error(path_);
  size_ = static_cast<std::uint64_t>(ftello(file_.get()));
  skip_to(0);
  if (size_ < mcap_magic.size() || !magic_follows()) throw TraceError(0, "not an MCAP file");
}

bool McapReader::magic_follows() {
  read(record_, mcap_magic.size());
  return std::equal(mcap_magic.begin(), mcap_magic.end(), record_.begin());
}

void McapReader::read(std::vector<std::uint8_t>& bytes, std::uint64_t count) {
  bytes.resize(count);
  if (std::fread(bytes.data(), 1, count, file_.get()) != count) throw_file_error(path_);
  position_ += count;
}

void McapReader::skip_to(std::uint64_t position) {
  if (fseeko(file_.get(), static_cast<off_t>(position), SEEK_SET) != 0) throw_file_error(path_);
  position_ = position;
}

// Reads the next record outside chunks of a kind that next() handles; false if there is no complete one.
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
        throw TraceError(position_, "the chunk is too large");
      read(record_, length);
      return true;
    }
    skip_to(position_ + length);
  }
  ended_ = true;
  return false;
}

void McapReader::open_chunk(ByteCursor in) {
  in.take<std::uint64_t>();  // first log time
  in.take<std::uint64_t>();  // last log time
  const auto size = in.take<std::uint64_t>();
  const auto checksum = in.take<std::uint32_t>();
  const std::string_view compression = in.take_text();
  const auto compressed = in.take_bytes(in.take<std::uint64_t>());
  if (compression == mcap_compression)
    decompress(in, compressed, size, chunk_);
  else if (compression.empty())
    chunk_.assign(compressed.begin(), compressed.end());
  else
    in.fail("unknown compression '" + std::string(compression) + "' of the chunk");
  boost::crc_32_type crc;
  if (checksum != 0) crc.process_bytes(chunk_.data(), chunk_.size());
  if (checksum != 0 && crc.checksum() != checksum) in.fail("the checksum of the chunk is wrong");
  chunk_position_ = 0;
}

// Reads one record of the chunk. Returns its message if it belongs to the topic.
std::optional<McapMessage> McapReader::next_in_chunk() {
  ByteCursor in(std::span<const std::uint8_t>(chunk_).subspan(chunk_position_), chunk_position_);
  const auto opcode = in.take<McapOpcode>();
  const ByteCursor body = in.part(in.take<std::uint64_t>());
  chunk_position_ = in.position();
  if (opcode == McapOpcode::chunk) in.fail("a chunk inside a chunk");
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
