// SPDX-License-Identifier: MIT
// Traces of other versions of the plugin contract: longer elements, longer structs, elements that lack a field.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "core/trace/trace_field_reader.hpp"
#include "core/trace/trace_reader.hpp"
#include "tests/unit/core/trace/trace_example.hpp"

namespace trace_growth_test {

using namespace dmrp::core;
using dmrp::test::example_trace;

// Writes a trace again as another version of the contract would have: elements and blocks that are longer or shorter.
// It goes through the records by their layout in trace.hpp.
class OtherVersion {
 public:
  // Bytes added to the end of each element and block, or taken away. Elements of `cut_size` bytes alone are cut.
  explicit OtherVersion(std::size_t added, std::size_t cut_size = 0, std::size_t cut = 0)
      : added_(added), cut_size_(cut_size), cut_(cut) {}

  TraceBytes of(const TraceBytes& trace) {
    TraceBytes all;
    TraceRecords records{std::span(trace)};
    while (const auto record = records.next()) {
      TraceBytes bytes;
      ByteWriter out(bytes);
      RecordCursor in(record->body, record->offset);
      body(record->kind, in, out);
      out.put_array(filling_.data(), added_);
      ByteWriter whole(all);
      whole.put(static_cast<std::uint32_t>(bytes.size()));
      whole.put(record->kind);
      whole.put_array(bytes.data(), bytes.size());
    }
    return all;
  }

 private:
  static void copy(RecordCursor& in, ByteWriter& out, std::uint64_t count) {
    const auto bytes = in.take_bytes(count);
    out.put_array(bytes.data(), bytes.size());
  }

  static std::uint32_t copy_count(RecordCursor& in, ByteWriter& out) {
    const auto count = in.take<std::uint32_t>();
    out.put(count);
    return count;
  }

  static void copy_array(RecordCursor& in, ByteWriter& out, std::size_t element_bytes) {
    copy(in, out, copy_count(in, out) * std::uint64_t{element_bytes});
  }

  template <class CopyFields>
  void block(RecordCursor& in, ByteWriter& out, CopyFields&& copy_fields) {
    out.put_block([&] {
      in.take_block(copy_fields);
      out.put_array(filling_.data(), added_);
    });
  }

  void elements(RecordCursor& in, ByteWriter& out) {
    const std::uint32_t count = copy_count(in, out);
    const auto stride = in.take<std::uint32_t>();
    const std::size_t kept = stride == cut_size_ ? stride - cut_ : stride;
    out.put(static_cast<std::uint32_t>(kept + added_));
    for (std::uint32_t i = 0; i < count; ++i) {
      out.put_array(in.take_bytes(stride).data(), kept);
      out.put_array(filling_.data(), added_);
    }
  }

  void world(RecordCursor& in, ByteWriter& out) {
    copy(in, out, 4 + 4 + 32 + 32 + 8);
    for (std::uint32_t robots = copy_count(in, out); robots > 0; --robots)
      block(in, out, [&](RecordCursor& robot) {
        copy_array(robot, out, 1);
        copy_array(robot, out, 1);
        copy(robot, out, 4 + 24);
        block(robot, out, [&](RecordCursor& limits) { copy(limits, out, limits.rest().size()); });
        block(robot, out, [&](RecordCursor& footprint) {
          copy(footprint, out, 16);
          for (std::uint32_t parts = copy_count(footprint, out); parts > 0; --parts)
            block(footprint, out, [&](RecordCursor& part) { copy_array(part, out, 16); });
        });
        elements(robot, out);
      });
    for (std::uint32_t shapes = copy_count(in, out); shapes > 0; --shapes)
      block(in, out, [&](RecordCursor& shape) { copy(shape, out, shape.rest().size()); });
    copy_array(in, out, 32);
    copy(in, out, 1);
    block(in, out, [&](RecordCursor& grid) { copy(grid, out, grid.rest().size()); });
  }

  void plan(RecordCursor& in, ByteWriter& out) {
    copy(in, out, 6 * 8 + 2 * 4);
    for (std::uint32_t paths = copy_count(in, out); paths > 0; --paths)
      block(in, out, [&](RecordCursor& path) {
        copy(path, out, 4);
        elements(path, out);
      });
    for (std::uint32_t statistics = copy_count(in, out); statistics > 0; --statistics)
      block(in, out, [&](RecordCursor& statistic) { copy(statistic, out, statistic.rest().size()); });
  }

  void body(TraceRecordKind kind, RecordCursor& in, ByteWriter& out) {
    if (kind == TraceRecordKind::world) world(in, out);
    if (kind == TraceRecordKind::plan) plan(in, out);
    if (kind == TraceRecordKind::sample) {
      copy(in, out, 8 + 8 + 4 + 8);
      for (int arrays = 0; arrays < 5; ++arrays) elements(in, out);
      for (std::uint32_t routes = copy_count(in, out); routes > 0; --routes)
        block(in, out, [&](RecordCursor& route) {
          copy(route, out, 4 * 4);
          elements(route, out);
        });
    }
    if (kind == TraceRecordKind::end) {
      copy(in, out, 4 + 8);
      elements(in, out);
    }
    copy(in, out, in.rest().size());
  }

  std::size_t added_;
  std::size_t cut_size_;
  std::size_t cut_;
  std::vector<std::uint8_t> filling_ = std::vector<std::uint8_t>(64, 0xa5);
};

// What a trace says, encoded again.
TraceBytes said_by(const TraceBytes& bytes) {
  TraceReader trace(bytes);
  TraceBytes again;
  TraceEncoder encoder(trace.world(), [&](std::int64_t, std::span<const std::uint8_t> record) {
    again.insert(again.end(), record.begin(), record.end());
  });
  for (const TracePlan& made : trace.plans()) encoder.plan(made.plan, made.conflicts);
  while (const dmrp_sample* sample = trace.next_sample()) encoder.sample(*sample);
  for (const TraceScan& scan : trace.scans())
    encoder.scan(scan.robot,
                 {sizeof(dmrp_scan), static_cast<std::uint32_t>(scan.ranges.size()), scan.t_ns, scan.angle_min,
                  scan.angle_increment, scan.range_min, scan.range_max, scan.ranges.data()});
  for (const TraceTrajectory& line : trace.trajectories())
    encoder.trajectory(line.source, line.role, line.poses, line.step_ns);
  for (const TraceNote& note : trace.notes()) encoder.note(note.source, note.text);
  encoder.end(*trace.end(), trace.reason());
  return again;
}

TEST_CASE("fields that a trace has beyond ours are skipped", "[trace]") {
  const TraceBytes trace = example_trace(8);
  const TraceBytes as_written = said_by(trace);
  CHECK(OtherVersion(0).of(trace) == trace);
  for (const std::size_t added : {8u, 24u}) {
    const TraceBytes grown = OtherVersion(added).of(trace);
    CHECK(grown.size() > trace.size());
    CHECK(said_by(grown) == as_written);
  }
}

TEST_CASE("elements shorter than those of version 1.0 of the contract are refused", "[trace]") {
  const TraceBytes trace = example_trace(8);
  for (const std::size_t size :
       {sizeof(dmrp_goal), sizeof(dmrp_waypoint), sizeof(dmrp_robot_sample), sizeof(dmrp_person), sizeof(dmrp_contact),
        sizeof(dmrp_call), sizeof(dmrp_robot_event), sizeof(dmrp_robot_end)}) {
    const TraceBytes cut = OtherVersion(0, size, 8).of(trace);
    CHECK(cut.size() < trace.size());
    CHECK_THROWS_WITH(TraceReader(cut), Catch::Contains("elements shorter than those of version 1.0"));
  }
}

TEST_CASE("contacts of unknown kinds are left out", "[trace]") {
  const dmrp::test::ExampleWorld world;
  dmrp::test::ExampleSample sample(0, nullptr);
  sample.contacts[0].kind = 99;
  sample.contacts[0].a = 1000;
  TraceBytes bytes;
  TraceEncoder encoder(world.world, [&](std::int64_t, std::span<const std::uint8_t> record) {
    bytes.insert(bytes.end(), record.begin(), record.end());
  });
  encoder.sample(sample.sample);
  TraceReader trace(bytes);
  const dmrp_sample* read = trace.next_sample();
  REQUIRE(read);
  REQUIRE(read->contact_count == 1);
  CHECK(read->contacts[0].kind == DMRP_CONTACT_PERSON);
}

}  // namespace trace_growth_test
