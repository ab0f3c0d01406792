// SPDX-License-Identifier: MIT
// trace_elements.hpp: elements of arrays that are stored as in memory, whose size may grow with the plugin contract.
// Internal to traces.
#pragma once

#include <dmrp/sample.h>
#include <dmrp/trial_end.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/trace/record_cursor.hpp"

namespace dmrp::core {

// The size of an element in format version 1, and its least size in later ones: that of version 1.0 of the contract.
struct TraceElementSize {
  std::size_t format_1;
  std::size_t least;
};

template <class Element>
inline constexpr TraceElementSize trace_element_size = Element::not_stored_as_in_memory;
template <>
inline constexpr TraceElementSize trace_element_size<dmrp_goal> = {56, 56};
template <>
inline constexpr TraceElementSize trace_element_size<dmrp_waypoint> = {36, 40};
template <>
inline constexpr TraceElementSize trace_element_size<dmrp_robot_sample> = {88, 96};
template <>
inline constexpr TraceElementSize trace_element_size<dmrp_person> = {112, 120};
template <>
inline constexpr TraceElementSize trace_element_size<dmrp_contact> = {40, 40};
template <>
inline constexpr TraceElementSize trace_element_size<dmrp_call> = {20, 24};
template <>
inline constexpr TraceElementSize trace_element_size<dmrp_robot_end> = {16, 16};

// All at once, unless the owner's version of them is longer.
template <class Element>
void put_elements(ByteWriter& out, const Element* elements, std::uint32_t count, std::uint32_t stride) {
  out.put(count);
  out.put(static_cast<std::uint32_t>(sizeof(Element)));
  if (stride == sizeof(Element)) return out.put_array(elements, count);
  for (std::uint32_t i = 0; i < count; ++i) out.put(*DMRP_AT(Element, elements, stride, i));
}

// The elements that follow in a record.
struct TraceElements {
  std::uint32_t count = 0;
  std::size_t stride = 0;
};

// Checks that the record has room for them.
template <class Element>
TraceElements take_element_count(RecordCursor& in) {
  constexpr TraceElementSize size = trace_element_size<Element>;
  const auto count = in.take<std::uint32_t>();
  const std::size_t stride = in.version() == 1 ? size.format_1 : in.take<std::uint32_t>();
  if (in.version() > 1 && stride < size.least) in.fail("elements shorter than those of version 1.0 of the contract");
  in.require(count, stride);
  return {count, stride};
}

// `to` has place for them. Fields that the trace does not have become zero; fields that it has beyond ours are skipped.
template <class Element>
void take_elements(RecordCursor& in, const TraceElements& elements, Element* to) {
  assert(to || elements.count == 0);
  if (elements.stride == sizeof(Element)) return in.take_array(to, elements.count);
  for (std::uint32_t i = 0; i < elements.count; ++i) {
    to[i] = Element{};
    std::memcpy(&to[i], in.take_bytes(elements.stride).data(), std::min(elements.stride, sizeof(Element)));
  }
}

}  // namespace dmrp::core
