// SPDX-License-Identifier: MIT
#include "core/mcap/mcap_writer.hpp"

#include <zstd.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <cassert>
#include <memory>
#include <new>

#include "core/bytes/trace_bytes.hpp"

namespace dmrp::core {
namespace {

constexpr std::size_t chunk_bytes = 1 << 20;  // of records, before compression
constexpr int compression_level = 1;

using Bytes = std::vector<std::uint8_t>;

template <class More>
void append(Bytes& bytes, const More& more) {
  ByteWriter(bytes).put_array(more.data(), more.size());
}

std::uint32_t crc32(const Bytes& bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

template <class WriteBody>
void put_record(Bytes& bytes, McapOpcode opcode, WriteBody write_body) {
  const std::size_t begin = bytes.size();
  ByteWriter out(bytes);
  out.put(opcode);
  out.put(std::uint64_t{0});
  write_body(out);
  const std::uint64_t length = bytes.size() - begin - mcap_record_prefix_bytes;
  std::memcpy(bytes.data() + begin + 1, &length, sizeof(length));
}

// A map or an array: the number of bytes as u32, then the elements.
template <class WriteElements>
void put_counted(Bytes& bytes, WriteElements write_elements) {
  const std::size_t begin = bytes.size();
  ByteWriter out(bytes);
  out.put(std::uint32_t{0});
  write_elements(out);
  const auto length = static_cast<std::uint32_t>(bytes.size() - begin - sizeof(std::uint32_t));
  std::memcpy(bytes.data() + begin, &length, sizeof(length));
}

void put_offsets(Bytes& bytes, const std::map<std::uint16_t, std::uint64_t>& offsets) {
  put_counted(bytes, [&](ByteWriter& out) {
    for (const auto& [channel, offset] : offsets) {
      out.put(channel);
      out.put(offset);
    }
  });
}

// Uses zstd's own checksum, which costs almost nothing: MCAP's CRC-32 takes longer than the compression.
Bytes compress(const Bytes& bytes) {
  const std::unique_ptr<ZSTD_CCtx, std::size_t (*)(ZSTD_CCtx*)> context(ZSTD_createCCtx(), ZSTD_freeCCtx);
  if (!context) throw std::bad_alloc();
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, compression_level);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  Bytes compressed(ZSTD_compressBound(bytes.size()));
  const std::size_t size =
      ZSTD_compress2(context.get(), compressed.data(), compressed.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(size)) throw std::bad_alloc();  // the only possible reason
  compressed.resize(size);
  return compressed;
}

}  // namespace

void McapWriter::TimeRange::add(std::uint64_t t) {
  first = empty ? t : std::min(first, t);
  last = empty ? t : std::max(last, t);
  empty = false;
}

McapWriter::McapWriter(const std::filesystem::path& path) : path_(path), file_(create_file(path)) {
  Bytes begin;
  append(begin, mcap_magic);
  put_record(begin, McapOpcode::header, [](ByteWriter& out) {
    out.put_text("");  // no profile
    out.put_text("dmrp");
  });
  to_file(begin);
}

std::uint16_t McapWriter::add_schema(const McapSchema& schema) {
  const std::uint16_t id = ++schema_count_;  // 0 means no schema
  Bytes record;
  put_record(record, McapOpcode::schema, [&](ByteWriter& out) {
    out.put(id);
    out.put_text(schema.name);
    out.put_text(schema.encoding);
    out.put_text(schema.data);
  });
  append(chunk_, record);
  append(schemas_, record);
  return id;
}

std::uint16_t McapWriter::add_channel(const McapChannel& channel) {
  assert(channel.schema_id <= schema_count_);
  const auto id = static_cast<std::uint16_t>(message_counts_.size());
  message_counts_[id] = 0;
  Bytes record;
  put_record(record, McapOpcode::channel, [&](ByteWriter& out) {
    out.put(id);
    out.put(channel.schema_id);
    out.put_text(channel.topic);
    out.put_text(channel.message_encoding);
    put_counted(record, [&](ByteWriter&) {
      for (const auto& [key, value] : channel.metadata) {
        out.put_text(key);
        out.put_text(value);
      }
    });
  });
  append(chunk_, record);
  append(channels_, record);
  return id;
}

void McapWriter::write(std::uint16_t channel, std::int64_t log_time_ns, std::span<const std::uint8_t> message) {
  assert(channel < message_counts_.size());
  const auto log_time = static_cast<std::uint64_t>(log_time_ns);
  chunk_messages_[channel].push_back({log_time, chunk_.size()});
  chunk_times_.add(log_time);
  const auto sequence = static_cast<std::uint32_t>(message_counts_.at(channel)++);
  put_record(chunk_, McapOpcode::message, [&](ByteWriter& out) {
    out.put(channel);
    out.put(sequence);
    out.put(log_time);  // time of recording
    out.put(log_time);  // time of publication
    out.put_array(message.data(), message.size());
  });
  if (chunk_.size() >= chunk_bytes) write_chunk();
}

void McapWriter::write_chunk() {
  if (chunk_.empty()) return;
  const Bytes compressed = compress(chunk_);
  Bytes record;
  put_record(record, McapOpcode::chunk, [&](ByteWriter& out) {
    out.put(chunk_times_.first);
    out.put(chunk_times_.last);
    out.put(std::uint64_t{chunk_.size()});
    out.put(std::uint32_t{0});  // no CRC-32
    out.put_text(mcap_compression);
    out.put(std::uint64_t{compressed.size()});
    out.put_array(compressed.data(), compressed.size());
  });
  const std::uint64_t chunk_begin = file_size_;
  to_file(record);
  const std::uint64_t indexes_begin = file_size_;
  const auto index_offsets = write_message_indexes();
  if (std::fflush(file_.get()) != 0) throw_file_error(path_);

  put_record(chunk_indexes_, McapOpcode::chunk_index, [&](ByteWriter& out) {
    out.put(chunk_times_.first);
    out.put(chunk_times_.last);
    out.put(chunk_begin);
    out.put(std::uint64_t{record.size()});
    put_offsets(chunk_indexes_, index_offsets);
    out.put(file_size_ - indexes_begin);
    out.put_text(mcap_compression);
    out.put(std::uint64_t{compressed.size()});
    out.put(std::uint64_t{chunk_.size()});
  });
  if (!chunk_times_.empty) {
    file_times_.add(chunk_times_.first);
    file_times_.add(chunk_times_.last);
  }
  ++chunk_count_;
  chunk_.clear();
  chunk_times_ = {};
  chunk_messages_.clear();
}

std::map<std::uint16_t, std::uint64_t> McapWriter::write_message_indexes() {
  std::map<std::uint16_t, std::uint64_t> offsets;
  for (const auto& [channel, messages] : chunk_messages_) {
    offsets[channel] = file_size_;
    Bytes record;
    put_record(record, McapOpcode::message_index, [&, id = channel, &entries = messages](ByteWriter& out) {
      out.put(id);
      put_counted(record, [&](ByteWriter&) { out.put_array(entries.data(), entries.size()); });
    });
    to_file(record);
  }
  return offsets;
}

void McapWriter::put_statistics(Bytes& bytes) const {
  std::uint64_t message_count = 0;
  for (const auto& [channel, count] : message_counts_) message_count += count;
  put_record(bytes, McapOpcode::statistics, [&](ByteWriter& out) {
    out.put(message_count);
    out.put(schema_count_);
    out.put(static_cast<std::uint32_t>(message_counts_.size()));
    out.put(std::uint32_t{0});  // attachments
    out.put(std::uint32_t{0});  // metadata
    out.put(chunk_count_);
    out.put(file_times_.first);
    out.put(file_times_.last);
    put_offsets(bytes, message_counts_);
  });
}

// Writes the summary, the offsets of its groups, and the footer.
void McapWriter::write_summary() {
  const std::uint64_t summary_begin = file_size_;
  Bytes summary;
  Bytes summary_offsets;
  const auto add_group = [&](McapOpcode opcode, const Bytes& records) {
    if (records.empty()) return;
    put_record(summary_offsets, McapOpcode::summary_offset, [&](ByteWriter& out) {
      out.put(opcode);
      out.put(summary_begin + summary.size());
      out.put(std::uint64_t{records.size()});
    });
    append(summary, records);
  };
  Bytes statistics;
  put_statistics(statistics);
  add_group(McapOpcode::schema, schemas_);
  add_group(McapOpcode::channel, channels_);
  add_group(McapOpcode::chunk_index, chunk_indexes_);
  add_group(McapOpcode::statistics, statistics);

  const std::uint64_t offsets_begin = summary_begin + summary.size();
  append(summary, summary_offsets);
  put_record(summary, McapOpcode::footer, [&](ByteWriter& out) {
    out.put(summary_begin);
    out.put(offsets_begin);
    out.put(std::uint32_t{0});
  });
  summary.resize(summary.size() - sizeof(std::uint32_t));  // the checksum is over all before it
  ByteWriter(summary).put(crc32(summary));
  append(summary, mcap_magic);
  to_file(summary);
}

void McapWriter::finish() {
  write_chunk();
  Bytes data_end;
  put_record(data_end, McapOpcode::data_end, [](ByteWriter& out) { out.put(std::uint32_t{0}); });  // no checksum
  to_file(data_end);
  write_summary();
  if (std::fclose(file_.release()) != 0) throw_file_error(path_);
}

void McapWriter::to_file(const Bytes& bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) throw_file_error(path_);
  file_size_ += bytes.size();
}

}  // namespace dmrp::core
