// SPDX-License-Identifier: MIT
#include "core/trace/canonical_records.hpp"

#include <cstddef>
#include <cstring>

#include "core/trace/record_cursor.hpp"
#include "core/trace/trace.hpp"
#include "core/trace/trace_elements.hpp"

namespace dmrp::core {
namespace {

// Copies fields from a record of either version to one of version 1.
class Transcript {
 public:
  Transcript(RecordCursor& in, ByteWriter& out) : in_(in), out_(out) {}

  std::uint32_t version() const { return in_.version(); }

  void bytes(std::uint64_t count) {
    const auto taken = in_.take_bytes(count);
    out_.put_array(taken.data(), taken.size());
  }

  template <class Value>
  Value value() {
    const Value taken = in_.take<Value>();
    out_.put(taken);
    return taken;
  }

  void array(std::size_t element_bytes) { bytes(std::uint64_t{value<std::uint32_t>()} * element_bytes); }
  void text() { array(1); }

  void clock_time() {
    in_.take<std::int64_t>();
    out_.put(std::int64_t{0});
  }

  template <class CopyFields>
  void block(CopyFields&& copy) {
    in_.take_block([&](RecordCursor& fields) {
      Transcript inner(fields, out_);
      copy(inner);
    });
  }

  template <class CopyFields>
  void blocks(CopyFields&& copy) {
    const auto count = value<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) block(copy);
  }

  template <class Element, class CopyFields>
  void elements(CopyFields&& copy) {
    const TraceElements stored = take_element_count<Element>(in_);
    out_.put(stored.count);
    for (std::uint32_t i = 0; i < stored.count; ++i) {
      const std::size_t begin = in_.position();
      RecordCursor fields(in_.take_bytes(stored.stride), begin, version());
      Transcript inner(fields, out_);
      copy(inner);
    }
  }

  template <class Element>
  void elements() {
    elements<Element>([](Transcript& copy) { copy.bytes(trace_element_size<Element>.format_1); });
  }

  void skip(std::uint64_t count) { in_.take_bytes(count); }
  void put_count(std::uint32_t count) { out_.put(count); }
  std::uint32_t take_count() { return in_.take<std::uint32_t>(); }

 private:
  RecordCursor& in_;
  ByteWriter& out_;
};

void copy_footprint(Transcript& copy) {
  copy.bytes(16);  // radii
  const auto vertices = [](Transcript& part) { part.array(sizeof(dmrp_vec2)); };
  const std::uint32_t parts = copy.version() == 1 ? 1 : copy.take_count();
  if (parts == 0) copy.put_count(0);  // of vertices: a disc
  for (std::uint32_t i = 0; i < parts; ++i) copy.block(vertices);
}

void copy_robot(Transcript& copy) {
  copy.text();                        // name
  copy.bytes(4 + sizeof(dmrp_pose));  // kinematics, start
  copy.block([](Transcript& limits) { limits.bytes(48); });
  copy.block(copy_footprint);
  copy.elements<dmrp_goal>();
}

void copy_shape(Transcript& copy) {
  copy.text();                                // name
  copy.bytes(4 + sizeof(dmrp_vec2) + 8 + 8);  // kind, centre, radius, height
  copy.array(sizeof(dmrp_vec2));              // vertices
}

void copy_grid(Transcript& copy) {
  if (copy.value<std::uint8_t>() == 0) return;
  copy.block([](Transcript& grid) {
    const std::uint64_t width = grid.value<std::uint32_t>();
    const std::uint64_t cells = width * grid.value<std::uint32_t>();
    grid.bytes(8 + sizeof(dmrp_vec2));  // resolution, origin
    for (const std::size_t cell_bytes : {sizeof(std::uint8_t), sizeof(std::uint8_t), sizeof(float)})
      if (grid.value<std::uint8_t>() != 0) grid.bytes(cells * cell_bytes);
  });
}

void copy_world(Transcript& copy) {
  copy.take_count();  // format version
  copy.put_count(1);
  copy.bytes(4 + 2 * sizeof(dmrp_vec2) + 4 * 8);  // people, corners, four times
  copy.blocks(copy_robot);
  copy.blocks(copy_shape);
  copy.array(sizeof(dmrp_segment));
  copy_grid(copy);  // for planners
}

void copy_plan(Transcript& copy) {
  copy.bytes(4 * 8);  // made at, revision, from, step duration
  copy.clock_time();
  copy.bytes(4 + 4);  // status, conflicts
  copy.blocks([](Transcript& path) { path.elements<dmrp_waypoint>(); });
  copy.blocks([](Transcript& statistic) {
    statistic.text();
    statistic.bytes(8);
  });
}

void copy_call(Transcript& copy) {
  copy.bytes(3 * 4);                     // kind, robot, status
  if (copy.version() > 1) copy.skip(4);  // reserved
  copy.clock_time();
}

void copy_sample(Transcript& copy) {
  copy.bytes(8 + 8 + 4 + 8);  // time, time step, control tick, revision
  copy.elements<dmrp_robot_sample>();
  copy.elements<dmrp_person>();
  copy.elements<dmrp_contact>();
  copy.elements<dmrp_call>(copy_call);
}

void copy_scan(Transcript& copy) {
  copy.bytes(8 + 4 + 4 * 8);  // time, robot, angles and ranges
  copy.array(sizeof(float));
}

void copy_trajectory(Transcript& copy) {
  copy.bytes(8 + 8 + 4 + 8);  // time, source, role, time step
  copy.array(sizeof(dmrp_pose));
}

void copy_note(Transcript& copy) {
  copy.bytes(8 + 8);  // time, source
  copy.text();
}

void copy_end(Transcript& copy) {
  copy.bytes(4 + 8);  // ending, time
  copy.elements<dmrp_robot_end>();
  copy.text();  // reason
}

void copy_body(TraceRecordKind kind, Transcript& copy) {
  switch (kind) {
    case TraceRecordKind::world:
      return copy_world(copy);
    case TraceRecordKind::plan:
      return copy_plan(copy);
    case TraceRecordKind::sample:
      return copy_sample(copy);
    case TraceRecordKind::scan:
      return copy_scan(copy);
    case TraceRecordKind::trajectory:
      return copy_trajectory(copy);
    case TraceRecordKind::note:
      return copy_note(copy);
    case TraceRecordKind::end:
      return copy_end(copy);
  }
  throw TraceError(0, "the kind of the record is unknown");
}

}  // namespace

TraceBytes CanonicalRecords::next(std::span<const std::uint8_t> record) {
  ByteCursor prefix(record);
  const auto body_bytes = prefix.take<std::uint32_t>();
  const auto kind = prefix.take<TraceRecordKind>();
  if (body_bytes != prefix.rest().size()) prefix.fail("a message that is not one record");
  if (kind == TraceRecordKind::world) version_ = ByteCursor(prefix).take<std::uint32_t>();
  if (version_ == 0 || version_ > trace_format_version) prefix.fail("a format version that is not known");

  TraceBytes bytes;
  ByteWriter out(bytes);
  out.put(std::uint32_t{0});
  out.put(kind);
  RecordCursor body(prefix.rest(), prefix.position(), version_);
  Transcript copy(body, out);
  copy_body(kind, copy);
  const auto length = static_cast<std::uint32_t>(bytes.size() - trace_record_prefix_bytes);
  std::memcpy(bytes.data(), &length, sizeof(length));
  return bytes;
}

}  // namespace dmrp::core
