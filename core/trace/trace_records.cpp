// SPDX-License-Identifier: MIT
#include "core/trace/trace_records.hpp"

#include "core/bytes/trace_bytes.hpp"

namespace dmrp::core {
namespace {

// The record at the beginning of `bytes`, which begin at byte `origin` of the trace.
TraceRecord first_record(std::span<const std::uint8_t> bytes, std::size_t origin) {
  ByteCursor in(bytes, origin);
  const auto body_bytes = in.take<std::uint32_t>();
  const auto kind = in.take<TraceRecordKind>();
  if (body_bytes > in.rest().size()) throw TraceError(origin, "the last record is truncated");
  return {kind, in.position(), in.rest().first(body_bytes), bytes.first(trace_record_prefix_bytes + body_bytes)};
}

}  // namespace

TraceRecords::TraceRecords(const std::filesystem::path& file, std::size_t most_bytes_in_memory)
    : file_(std::make_unique<McapReader>(file, trace_topic)), most_bytes_in_memory_(most_bytes_in_memory) {}

std::optional<TraceRecord> TraceRecords::next() {
  if (file_) return next_in_file();
  return spool_ ? next_in_spool() : next_in_memory();
}

std::optional<TraceRecord> TraceRecords::next_in_spool() {
  const auto bytes = spool_->next();
  if (!bytes) return std::nullopt;
  const TraceRecord record = first_record(*bytes, position_);
  position_ += record.whole.size();
  return record;
}

std::optional<TraceRecord> TraceRecords::next_in_memory() {
  if (position_ == bytes_.size()) return std::nullopt;
  const TraceRecord record = first_record(bytes_.subspan(position_), position_);
  position_ += record.whole.size();
  return record;
}

std::optional<TraceRecord> TraceRecords::next_in_file() {
  const auto message = file_->next();
  if (!message) {
    if (!is_small_) return std::nullopt;
    // The whole trace is now in memory.
    bytes_ = kept_;
    file_.reset();
    return std::nullopt;
  }
  const TraceRecord record = first_record(message->data, position_);
  position_ += record.whole.size();
  keep(message->data);
  return record;
}

void TraceRecords::keep(std::span<const std::uint8_t> record) {
  if (!is_small_) return;
  // Reserve everything at once: unused pages take no memory, and growing would need twice the memory.
  if (kept_.empty()) kept_.reserve(most_bytes_in_memory_);
  is_small_ = record.size() <= most_bytes_in_memory_ - kept_.size();
  if (is_small_)
    kept_.insert(kept_.end(), record.begin(), record.end());
  else
    TraceBytes().swap(kept_);
}

void TraceRecords::rewind() {
  position_ = 0;
  if (spool_) spool_->rewind();
  if (!file_) return;
  file_->rewind();
  kept_.clear();
}

}  // namespace dmrp::core
