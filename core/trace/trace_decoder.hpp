// SPDX-License-Identifier: MIT
// trace_decoder.hpp: decodes the bodies of trace records into the structs of the plugin contract.
#pragma once

#include <dmrp/sample.h>
#include <dmrp/trial_end.h>
#include <dmrp/world.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/bytes/trace_bytes.hpp"
#include "core/foxglove/annotation_source.hpp"
#include "core/trace/record_cursor.hpp"

namespace dmrp::core {

struct TracePlan {
  dmrp_plan plan{};
  std::int64_t made_at_ns = 0;  // simulated time of the sample before the plan
  std::uint32_t conflicts = 0;  // between robots
};

// Beam i points at angle_min + i * angle_increment from the robot's heading.
struct TraceScan {
  std::int64_t t_ns = 0;
  std::uint32_t robot = 0;
  double angle_min = 0.0;
  double angle_increment = 0.0;
  double range_min = 0.0;
  double range_max = 0.0;
  std::span<const float> ranges;  // infinite for beams without a hit
};

struct TraceTrajectory {
  AnnotationSource source;
  std::int64_t t_ns = 0;
  std::int64_t step_ns = 0;
  std::uint32_t role = 0;  // DMRP_ANNOTATE_*
  std::span<const dmrp_pose> poses;
};

struct TraceNote {
  AnnotationSource source;
  std::int64_t t_ns = 0;
  std::string_view text;
};

// Holds everything that decoded structs point to.
using TraceStorage = std::pmr::monotonic_buffer_resource;

// `count` zeroed elements, valid as long as the storage; null for count 0.
template <class Element>
Element* allocate(TraceStorage& storage, std::size_t count) {
  static_assert(std::is_trivially_destructible_v<Element>);
  if (count == 0) return nullptr;
  void* memory = storage.allocate(count * sizeof(Element), alignof(Element));
  auto* elements = static_cast<Element*>(memory);
  std::uninitialized_value_construct_n(elements, count);
  return elements;
}

template <class Value>
const Value* take_stored(ByteCursor& in, TraceStorage& storage, std::size_t count) {
  Value* values = allocate<Value>(storage, count);
  in.take_array(values, count);
  return values;
}

const char* take_stored_text(ByteCursor& in, TraceStorage& storage);

// The body of a record, except for the format version before the world and the reason after the end. All throw
// TraceError.
dmrp_world take_world(RecordCursor& in, TraceStorage& storage);
TracePlan take_plan(RecordCursor& in, TraceStorage& storage, std::uint32_t robot_count);
dmrp_trial_end take_end(RecordCursor& in, TraceStorage& storage, std::uint32_t robot_count);

// The calls of a sample.
void take_calls(RecordCursor& in, std::vector<dmrp_call>& calls);

}  // namespace dmrp::core
