// SPDX-License-Identifier: MIT
#include "mcap_reader.hpp"

#include <zstd.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <set>
#include <string>
#include <vector>

#include "trace_bytes.hpp"

namespace dmrp::core {
namespace {

// A damaged file must not make us allocate whatever it says. Writers end chunks at a few megabytes.
constexpr std::uint64_t largest_chunk_bytes = std::uint64_t{1} << 28;

std::vector<std::uint8_t> decompress(const ByteCursor& in, std::span<const std::uint8_t> compressed,
                                     std::uint64_t size) {
  if (size > largest_chunk_bytes || ZSTD_getFrameContentSize(compressed.data(), compressed.size()) != size)
    in.fail("a chunk of another size than it says");
  std::vector<std::uint8_t> records(size);
  if (ZSTD_decompress(records.data(), records.size(), compressed.data(), compressed.size()) != size)
    in.fail("a chunk that does not decompress");
  return records;
}

enum class ScanEnd {
  data_end,       // the data section's last record
  between,        // the bytes end after a whole record
  within_record,  // the bytes end within a record
};

class Scan {
 public:
  Scan(std::string_view topic, const McapMessageSink& sink) : topic_(topic), sink_(sink) {}

  // Goes through the records of `bytes` from `begin` on, and says where it stopped.
  ScanEnd records(std::span<const std::uint8_t> bytes, std::size_t begin) {
    while (bytes.size() - begin >= mcap_record_prefix_bytes) {
      ByteCursor prefix(bytes, begin, bytes.size());
      const auto opcode = prefix.take<McapOpcode>();
      const auto length = prefix.take<std::uint64_t>();
      if (length > bytes.size() - prefix.position()) return ScanEnd::within_record;
      const std::size_t body_begin = prefix.position();
      begin = body_begin + length;
      if (opcode == McapOpcode::data_end) return ScanEnd::data_end;
      record(opcode, bytes, body_begin, begin);
    }
    return begin == bytes.size() ? ScanEnd::between : ScanEnd::within_record;
  }

 private:
  void record(McapOpcode opcode, std::span<const std::uint8_t> bytes, std::size_t begin, std::size_t end) {
    ByteCursor in(bytes, begin, end);
    if (opcode == McapOpcode::channel) channel(in);
    if (opcode == McapOpcode::message) message(in, bytes, end);
    if (opcode == McapOpcode::chunk) chunk(in, bytes);
  }

  void channel(ByteCursor& in) {
    const auto id = in.take<std::uint16_t>();
    in.take<std::uint16_t>();  // schema
    if (in.take_text() == topic_) channels_.insert(id);
  }

  void message(ByteCursor& in, std::span<const std::uint8_t> bytes, std::size_t end) {
    const auto id = in.take<std::uint16_t>();
    in.take<std::uint32_t>();  // sequence
    const auto log_time = in.take<std::int64_t>();
    in.take<std::int64_t>();  // publish time
    if (channels_.count(id) > 0) sink_(log_time, bytes.subspan(in.position(), end - in.position()));
  }

  void chunk(ByteCursor& in, std::span<const std::uint8_t> bytes) {
    if (in_chunk_) in.fail("a chunk within a chunk");
    in.take<std::uint64_t>();  // first and ...
    in.take<std::uint64_t>();  // ... last log time
    const auto size = in.take<std::uint64_t>();
    const auto checksum = in.take<std::uint32_t>();
    const std::string compression(in.take_text());
    const auto compressed_size = in.take<std::uint64_t>();
    in.require(compressed_size, 1);
    const auto compressed = bytes.subspan(in.position(), compressed_size);

    std::vector<std::uint8_t> decompressed;
    if (compression == mcap_compression)
      decompressed = decompress(in, compressed, size);
    else if (compression.empty())
      decompressed.assign(compressed.begin(), compressed.end());
    else
      in.fail("a chunk compressed by '" + compression + "'");
    boost::crc_32_type crc;
    crc.process_bytes(decompressed.data(), decompressed.size());
    if (checksum != 0 && crc.checksum() != checksum) in.fail("a chunk with a wrong checksum");

    in_chunk_ = true;
    if (records(decompressed, 0) != ScanEnd::between) in.fail("a chunk that ends within a record");
    in_chunk_ = false;
  }

  std::string_view topic_;
  const McapMessageSink& sink_;
  std::set<std::uint16_t> channels_;
  bool in_chunk_ = false;
};

}  // namespace

bool read_mcap(std::span<const std::uint8_t> file, std::string_view topic, const McapMessageSink& sink) {
  const auto magic_at = [&](std::size_t offset) {
    return std::equal(mcap_magic.begin(), mcap_magic.end(), file.begin() + static_cast<std::ptrdiff_t>(offset));
  };
  if (file.size() < mcap_magic.size() || !magic_at(0)) throw TraceError(0, "not an MCAP file");
  const ScanEnd end = Scan(topic, sink).records(file, mcap_magic.size());
  return end == ScanEnd::data_end && magic_at(file.size() - mcap_magic.size());
}

}  // namespace dmrp::core
