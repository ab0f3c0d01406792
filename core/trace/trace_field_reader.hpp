// SPDX-License-Identifier: MIT
// trace_field_reader.hpp: reads the fields of records (trace_layout.hpp). Internal to traces.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <memory_resource>
#include <span>
#include <string_view>
#include <type_traits>

#include "core/trace/record_cursor.hpp"
#include "core/trace/trace_elements.hpp"
#include "core/trace/trace_layout.hpp"

namespace dmrp::core {

// Holds everything that the structs read point to.
using TraceStorage = std::pmr::monotonic_buffer_resource;

// The least number of bytes of one struct in a record: bounds for damaged counts.
template <class Struct>
inline constexpr std::size_t least_trace_bytes = Struct::not_stored_as_a_block;
template <>
inline constexpr std::size_t least_trace_bytes<dmrp_robot> = 4 + 4 + 24 + 48 + 20 + 4;
template <>
inline constexpr std::size_t least_trace_bytes<dmrp_polygon> = 8;
template <>
inline constexpr std::size_t least_trace_bytes<dmrp_shape> = 4 + 4 + 16 + 8 + 8 + 4;
template <>
inline constexpr std::size_t least_trace_bytes<dmrp_path> = 4;
template <>
inline constexpr std::size_t least_trace_bytes<dmrp_statistic> = 12;
template <>
inline constexpr std::size_t least_trace_bytes<TraceRoute> = 16 + 8;

// All functions throw TraceError. It needs no names of fields.
class TraceFieldReader {
 public:
  // Without a storage it passes over arrays and texts, which stay empty; for records that have no structs in arrays.
  TraceFieldReader(RecordCursor& in, TraceStorage* storage) : in_(in), storage_(storage) {}

  template <class... Values>
  void values(const char*, Values&... values) {
    ((values = in_.take<Values>()), ...);
  }
  void clock(const char*, std::int64_t& value) { value = in_.take<std::int64_t>(); }

  void text(const char*, const char*& to) {
    const std::string_view text = in_.take_text();
    if (!storage_) return;
    char* copy = allocate<char>(text.size() + 1);
    std::copy(text.begin(), text.end(), copy);
    to = copy;
  }
  void text(const char* name, std::string_view& to) {
    const char* copy = "";
    text(name, copy);
    to = copy;
  }

  template <class Value>
  void array(const char*, const Value*& to, std::uint32_t& count) {
    count = in_.take_count(sizeof(Value));
    take_array(to, count);
  }
  template <class Value>
  void array(const char* name, std::span<const Value>& to) {
    const Value* values = nullptr;
    std::uint32_t count = 0;
    array(name, values, count);
    if (storage_) to = {values, count};
  }
  template <class Value>
  void optional_array(const char*, const Value*& to, auto... factors) {
    if (!is_present()) return;
    const std::size_t count = (std::size_t{1} * ... * factors);
    in_.require(count, sizeof(Value));
    take_array(to, count);
  }

  // Elements that are stored as in memory. Fields that the trace does not have become absent_fields; fields that it has
  // beyond ours are skipped.
  template <class Element>
  void elements(const char*, const Element*& to, std::uint32_t& count, std::uint32_t& to_stride) {
    count = in_.take<std::uint32_t>();
    to_stride = sizeof(Element);
    const std::size_t stride = in_.take<std::uint32_t>();
    if (stride < least_element_bytes<Element>) in_.fail("elements shorter than those of version 1.0 of the contract");
    in_.require(count, stride);
    auto* elements = allocate<Element>(count);
    to = elements;
    if (stride == sizeof(Element)) return in_.take_array(elements, count);
    for (std::uint32_t i = 0; i < count; ++i) take_element(stride, elements[i]);
  }

  template <class Struct>
  void pointer(const char*, const Struct*& to) {
    Struct* made = allocate<Struct>(1);
    to = made;
    block(*made);
  }
  template <class Struct>
  void optional_pointer(const char* name, const Struct*& to) {
    if (is_present()) pointer(name, to);
  }
  template <class Struct>
  void structs(const char*, const Struct*& to, std::uint32_t& count, std::uint32_t& stride) {
    count = in_.take_count(least_trace_bytes<Struct>);
    stride = sizeof(Struct);
    Struct* made = allocate<Struct>(count);
    to = made;
    for (std::uint32_t i = 0; i < count; ++i) block(made[i]);
  }

 private:
  // `count` zeroed elements, valid as long as the storage; null for count 0.
  template <class Element>
  Element* allocate(std::size_t count) {
    static_assert(std::is_trivially_destructible_v<Element>);
    if (count == 0) return nullptr;
    auto* elements = static_cast<Element*>(storage_->allocate(count * sizeof(Element), alignof(Element)));
    std::uninitialized_value_construct_n(elements, count);
    return elements;
  }

  template <class Value>
  void take_array(const Value*& to, std::size_t count) {
    if (!storage_) {
      in_.take_bytes(count * sizeof(Value));
      return;
    }
    Value* values = allocate<Value>(count);
    in_.take_array(values, count);
    to = values;
  }

  template <class Element>
  void take_element(std::size_t stride, Element& to) {
    to = absent_fields<Element>;
    std::memcpy(&to, in_.take_bytes(stride).data(), std::min(stride, sizeof(Element)));
  }

  bool is_present() {
    const auto presence = in_.take<std::uint8_t>();
    if (presence > 1) in_.fail("a presence flag other than 0 and 1");
    return presence == 1;
  }

  template <class Struct>
  void block(Struct& content) {
    if constexpr (requires { content.struct_size; }) content.struct_size = sizeof(Struct);
    in_.take_block([&](RecordCursor& in) {
      TraceFieldReader inner(in, storage_);
      fields(inner, content);
    });
  }

  RecordCursor& in_;
  TraceStorage* storage_;
};

template <class Content>
Content read_fields(RecordCursor& in, TraceStorage* storage) {
  Content content;
  TraceFieldReader reader(in, storage);
  fields(reader, content);
  return content;
}

}  // namespace dmrp::core
