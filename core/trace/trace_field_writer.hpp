// SPDX-License-Identifier: MIT
// trace_field_writer.hpp: writes the fields of records (trace_layout.hpp). Internal to traces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string_view>

#include "core/bytes/trace_bytes.hpp"
#include "core/trace/trace_elements.hpp"
#include "core/trace/trace_layout.hpp"

namespace dmrp::core {

// It needs no names of fields.
class TraceFieldWriter {
 public:
  explicit TraceFieldWriter(TraceBytes& bytes) : out_(bytes) {}

  template <class... Values>
  void values(const char*, const Values&... values) {
    (out_.put(values), ...);
  }
  void clock(const char*, std::int64_t value) { out_.put(value); }

  void text(const char*, std::string_view text) { out_.put_text(text); }
  void text(const char*, const char* text) { out_.put_text(text ? std::string_view(text) : std::string_view()); }

  template <class Value>
  void array(const char*, const Value* values, std::uint32_t count) {
    out_.put(count);
    out_.put_array(values, count);
  }
  template <class Value>
  void array(const char* name, std::span<const Value> values) {
    array(name, values.data(), static_cast<std::uint32_t>(values.size()));
  }

  template <class Value>
  void optional_array(const char*, const Value* values, auto... factors) {
    out_.put(static_cast<std::uint8_t>(values != nullptr));
    if (values) out_.put_array(values, (std::size_t{1} * ... * factors));
  }

  // Elements that are stored as in memory: all at once, unless the owner's version of them is longer.
  template <class Element>
  void elements(const char*, const Element* elements, std::uint32_t count, std::uint32_t stride) {
    out_.put(count);
    out_.put(static_cast<std::uint32_t>(sizeof(Element)));
    if (stride == sizeof(Element)) return out_.put_array(elements, count);
    for (std::uint32_t i = 0; i < count; ++i) out_.put_array(DMRP_AT(Element, elements, stride, i), 1);
  }

  template <class Struct>
  void pointer(const char*, const Struct* content) {
    out_.put_block([&] { fields(*this, *content); });
  }
  template <class Struct>
  void optional_pointer(const char* name, const Struct* content) {
    out_.put(static_cast<std::uint8_t>(content != nullptr));
    if (content) pointer(name, content);
  }
  template <class Struct>
  void structs(const char* name, const Struct* content, std::uint32_t count, std::uint32_t stride) {
    out_.put(count);
    for (std::uint32_t i = 0; i < count; ++i) pointer(name, DMRP_AT(Struct, content, stride, i));
  }

 private:
  ByteWriter out_;
};

// Replaces `bytes` by a whole record, with its length and kind. `offset`: of the record in the trace, for errors.
template <class Content>
void write_record(TraceBytes& bytes, TraceRecordKind kind, const Content& content, std::size_t offset) {
  bytes.clear();
  ByteWriter prefix(bytes);
  prefix.put(std::uint32_t{0});
  prefix.put(kind);
  TraceFieldWriter out(bytes);
  fields(out, content);
  const std::size_t body_bytes = bytes.size() - trace_record_prefix_bytes;
  if (body_bytes > std::numeric_limits<std::uint32_t>::max()) throw TraceError(offset, "a record of more than 4 GB");
  const auto length = static_cast<std::uint32_t>(body_bytes);
  std::memcpy(bytes.data(), &length, sizeof(length));
}

}  // namespace dmrp::core
