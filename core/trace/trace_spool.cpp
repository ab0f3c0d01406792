// SPDX-License-Identifier: MIT
#include "core/trace/trace_spool.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

#include "core/bytes/trace_bytes.hpp"

namespace dmrp::core {
namespace {

constexpr std::size_t buffer_bytes = 1 << 20;
constexpr std::size_t word_bytes = sizeof(std::uint64_t);
constexpr std::size_t words_per_mask = 64;

// The header before the changed words of a record: its own length and kind, and the number of bytes that follow.
constexpr std::size_t header_bytes = trace_record_prefix_bytes + sizeof(std::uint32_t);

std::uint32_t u32_at(const std::uint8_t* bytes) {
  std::uint32_t value;
  std::memcpy(&value, bytes, sizeof(value));
  return value;
}

// Writes the differences to `to`, copies `record` to `last` and returns the end. Both records have the same size.
std::uint8_t* put_changes(std::span<const std::uint8_t> record, TraceBytes& last, std::uint8_t* to) {
  const std::size_t words = record.size() / word_bytes;
  for (std::size_t begin = 0; begin < words; begin += words_per_mask) {
    std::uint8_t* const mask_at = to;
    std::uint64_t mask = 0;
    to += word_bytes;
    for (std::size_t word = begin; word < std::min(begin + words_per_mask, words); ++word) {
      const std::uint8_t* const now = record.data() + word * word_bytes;
      if (std::memcmp(now, last.data() + word * word_bytes, word_bytes) == 0) continue;
      mask |= std::uint64_t{1} << (word - begin);
      std::memcpy(to, now, word_bytes);
      to += word_bytes;
    }
    std::memcpy(mask_at, &mask, word_bytes);
  }
  const auto rest = record.subspan(words * word_bytes);
  if (!record.empty()) std::memcpy(last.data(), record.data(), record.size());
  return std::copy(rest.begin(), rest.end(), to);
}

// The inverse: applies the differences at `from` to the last record, which becomes the next one.
void take_changes(const std::uint8_t* from, TraceBytes& last) {
  const std::size_t words = last.size() / word_bytes;
  for (std::size_t begin = 0; begin < words; begin += words_per_mask) {
    std::uint64_t mask = 0;
    std::memcpy(&mask, from, word_bytes);
    for (from += word_bytes; mask != 0; mask &= mask - 1, from += word_bytes) {
      const std::size_t word = begin + static_cast<std::size_t>(std::countr_zero(mask));
      std::memcpy(last.data() + word * word_bytes, from, word_bytes);
    }
  }
  std::copy_n(from, last.size() % word_bytes, last.data() + words * word_bytes);
}

}  // namespace

TraceSpool::TraceSpool(const std::filesystem::path& path) : path_(path), file_(create_file(path)) {
  std::filesystem::remove(path);
}

TraceSpool::TraceSpool(int descriptor)
    : path_("the spool of a trace"), file_(fdopen(descriptor, "rb")), is_written_(true) {
  if (!file_) throw_file_error(path_);
}

int TraceSpool::descriptor() const {
  return fileno(file_.get());
}

// The previous record of the kind, resized to the length of the next one; new bytes are zero.
TraceBytes& TraceSpool::last_of_kind(const std::uint8_t* prefix) {
  TraceBytes& last = last_.at(prefix[sizeof(std::uint32_t)]);
  last.resize(trace_record_prefix_bytes + u32_at(prefix));
  return last;
}

void TraceSpool::write(std::span<const std::uint8_t> record) {
  assert(!is_written_ && record.size() >= trace_record_prefix_bytes);
  const std::size_t begin = buffer_.size();
  const std::size_t words = record.size() / word_bytes;
  std::uint8_t* const header =
      lengthen(buffer_, header_bytes + record.size() + (words / words_per_mask + 1) * word_bytes);
  std::uint8_t* const changes = header + header_bytes;
  const std::uint8_t* const end = put_changes(record, last_of_kind(record.data()), changes);
  const auto change_bytes = static_cast<std::uint32_t>(end - changes);
  std::memcpy(header, record.data(), trace_record_prefix_bytes);
  std::memcpy(header + trace_record_prefix_bytes, &change_bytes, sizeof(change_bytes));
  buffer_.resize(begin + header_bytes + change_bytes);
  if (buffer_.size() >= buffer_bytes) write_buffer();
}

void TraceSpool::write_buffer() {
  if (std::fwrite(buffer_.data(), 1, buffer_.size(), file_.get()) != buffer_.size()) throw_file_error(path_);
  buffer_.clear();
}

void TraceSpool::rewind() {
  if (!is_written_) write_buffer();
  is_written_ = true;
  if (std::fseek(file_.get(), 0, SEEK_SET) != 0) throw_file_error(path_);
  for (TraceBytes& last : last_) last.clear();
  buffer_.clear();
  position_ = 0;
}

// Ensures that this many bytes are in the buffer; false at the end of the file.
bool TraceSpool::fill(std::size_t bytes) {
  if (buffer_.size() - position_ >= bytes) return true;
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(position_));
  position_ = 0;
  const std::size_t begin = buffer_.size();
  std::uint8_t* const to = lengthen(buffer_, std::max(buffer_bytes, bytes));
  const std::size_t count = std::fread(to, 1, buffer_.size() - begin, file_.get());
  if (std::ferror(file_.get())) throw_file_error(path_);
  buffer_.resize(begin + count);
  return buffer_.size() >= bytes;
}

std::optional<std::span<const std::uint8_t>> TraceSpool::next() {
  assert(is_written_);
  if (!fill(header_bytes)) return std::nullopt;
  const std::size_t change_bytes = u32_at(buffer_.data() + position_ + trace_record_prefix_bytes);
  if (!fill(header_bytes + change_bytes)) throw_file_error(path_);
  const std::uint8_t* const header = buffer_.data() + position_;
  TraceBytes& record = last_of_kind(header);
  take_changes(header + header_bytes, record);
  position_ += header_bytes + change_bytes;
  return record;
}

}  // namespace dmrp::core
