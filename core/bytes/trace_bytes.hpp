// SPDX-License-Identifier: MIT
// trace_bytes.hpp: writes and reads little-endian values; internal to traces and their files.
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace dmrp::core {

using TraceBytes = std::vector<std::uint8_t>;

// The trace is truncated or damaged, or has another format.
class TraceError : public std::runtime_error {
 public:
  TraceError(std::size_t offset, const std::string& what)
      : std::runtime_error("trace, byte " + std::to_string(offset) + ": " + what), offset_(offset) {}

  std::size_t offset() const { return offset_; }  // of the first invalid byte

 private:
  std::size_t offset_;
};

static_assert(std::endian::native == std::endian::little, "values are copied in their memory layout");

// A number, or a frozen value type of the SDK (no padding).
template <class Value>
concept TraceValue = std::is_arithmetic_v<Value> ||
    (std::is_trivially_copyable_v<Value> && !std::is_pointer_v<Value> && std::is_standard_layout_v<Value>);

// Appends `count` bytes and returns a pointer to them. Not inline: gcc 12 gives a false warning there.
std::uint8_t* lengthen(TraceBytes& bytes, std::size_t count);

class ByteWriter {
 public:
  explicit ByteWriter(TraceBytes& bytes) : bytes_(bytes) {}

  template <TraceValue Value>
  void put(const Value& value) {
    put_array(&value, 1);
  }

  template <TraceValue Value>
  void put_array(const Value* values, std::size_t count) {
    assert(values || count == 0);
    if (count > 0) std::memcpy(lengthen(bytes_, count * sizeof(Value)), values, count * sizeof(Value));
  }

  void put_text(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    put_array(text.data(), text.size());
  }

  // The u32 length of what `put_content` writes, then that.
  template <class PutContent>
  void put_block(PutContent&& put_content) {
    put(std::uint32_t{0});
    const std::size_t begin = bytes_.size();
    put_content();
    const auto length = static_cast<std::uint32_t>(bytes_.size() - begin);
    std::memcpy(bytes_.data() + begin - sizeof(length), &length, sizeof(length));
  }

 private:
  TraceBytes& bytes_;
};

// Reads bytes in sequence; throws TraceError at the end. `origin`: the offset of the bytes in the whole trace, for
// errors.
class ByteCursor {
 public:
  explicit ByteCursor(std::span<const std::uint8_t> bytes, std::size_t origin = 0) : rest_(bytes), position_(origin) {}

  std::size_t position() const { return position_; }  // from the beginning of the whole trace
  bool at_end() const { return rest_.empty(); }
  std::span<const std::uint8_t> rest() const { return rest_; }

  template <TraceValue Value>
  Value take() {
    Value value;
    take_array(&value, 1);
    return value;
  }

  template <TraceValue Value>
  void take_array(Value* values, std::size_t count) {
    require(count, sizeof(Value));
    if (count > 0) std::memcpy(values, rest_.data(), count * sizeof(Value));
    skip(count * sizeof(Value));
  }

  std::span<const std::uint8_t> take_bytes(std::uint64_t count) {
    require(count, 1);
    const auto taken = rest_.first(count);
    skip(count);
    return taken;
  }

  // A cursor over the next `count` bytes alone.
  ByteCursor part(std::uint64_t count) {
    const std::size_t begin = position_;
    return ByteCursor(take_bytes(count), begin);
  }

  // A count of elements of at least `element_bytes` each. Checks that the rest has room for them, so that a damaged
  // count never causes an allocation of more than a small multiple of the trace.
  std::uint32_t take_count(std::size_t element_bytes) {
    const auto count = take<std::uint32_t>();
    require(count, element_bytes);
    return count;
  }

  std::string_view take_text() {
    const auto bytes = take_bytes(take<std::uint32_t>());
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

  [[noreturn]] void fail(const std::string& what) const { throw TraceError(position_, what); }

  void require(std::uint64_t count, std::size_t element_bytes) const {
    if (count > rest_.size() / element_bytes) fail("the record ends too early");
  }

 private:
  void skip(std::size_t count) {
    rest_ = rest_.subspan(count);
    position_ += count;
  }

  std::span<const std::uint8_t> rest_;
  std::size_t position_;
};

}  // namespace dmrp::core
