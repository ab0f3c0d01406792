// SPDX-License-Identifier: MIT
#include "core/trace/canonical_records.hpp"

#include <catch2/catch.hpp>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "core/trace/trace_encoder.hpp"
#include "core/trace/trace_reader.hpp"

using namespace dmrp::core;

namespace {

std::vector<TraceBytes> records_of_v1_trial() {
  std::vector<TraceBytes> all;
  TraceRecords records{std::filesystem::path(DMRP_V1_TRIAL)};
  while (const auto record = records.next()) all.emplace_back(record->whole.begin(), record->whole.end());
  return all;
}

std::vector<TraceBytes> canonical(const std::vector<TraceBytes>& records) {
  std::vector<TraceBytes> all;
  CanonicalRecords form;
  for (const TraceBytes& record : records) all.push_back(form.next(record));
  return all;
}

// The records of a trace read and encoded again: as records of the current version.
std::vector<TraceBytes> encoded_again(const std::vector<TraceBytes>& records) {
  TraceBytes joined;
  for (const TraceBytes& record : records) joined.insert(joined.end(), record.begin(), record.end());
  TraceReader trace{std::span<const std::uint8_t>(joined)};
  std::vector<TraceBytes> again;
  TraceEncoder encoder(trace.world(), [&](std::int64_t, std::span<const std::uint8_t> record) {
    again.emplace_back(record.begin(), record.end());
  });
  std::size_t plan = 0, scan = 0, trajectory = 0, note = 0;
  for (const TraceBytes& record : records) switch (TraceRecordKind{record[4]}) {
      case TraceRecordKind::world:
        break;
      case TraceRecordKind::plan:
        encoder.plan(trace.plans()[plan].plan, trace.plans()[plan].conflicts);
        ++plan;
        break;
      case TraceRecordKind::sample:
        encoder.sample(*trace.next_sample());
        break;
      case TraceRecordKind::scan: {
        const TraceScan& made = trace.scans()[scan++];
        encoder.scan(made.robot,
                     {sizeof(dmrp_scan), static_cast<std::uint32_t>(made.ranges.size()), made.t_ns, made.angle_min,
                      made.angle_increment, made.range_min, made.range_max, made.ranges.data()});
        break;
      }
      case TraceRecordKind::trajectory: {
        const TraceTrajectory& made = trace.trajectories()[trajectory++];
        encoder.trajectory(made.source, made.role, made.poses, made.step_ns);
        break;
      }
      case TraceRecordKind::note:
        encoder.note(trace.notes()[note].source, trace.notes()[note].text);
        ++note;
        break;
      case TraceRecordKind::end:
        encoder.end(*trace.end(), trace.reason());
        break;
    }
  return again;
}

// None if it cannot be read.
std::optional<TraceBytes> form_after(const TraceBytes& world, const TraceBytes& record) {
  try {
    CanonicalRecords form;
    if (record[4] != world[4]) form.next(world);
    return form.next(record);
  } catch (const TraceError&) {
    return std::nullopt;
  }
}

// The number of bytes of a record that may change without a change of its form.
std::size_t ignored_bytes(const TraceBytes& world, const TraceBytes& record) {
  const std::optional<TraceBytes> form = form_after(world, record);
  REQUIRE(form);
  std::size_t ignored = 0;
  for (std::size_t i = 0; i < record.size(); ++i) {
    TraceBytes changed = record;
    changed[i] ^= 1;
    ignored += form_after(world, changed) == form ? 1 : 0;
  }
  return ignored;
}

std::uint32_t calls_of(TraceReader& trace) {
  std::uint32_t calls = 0;
  while (const dmrp_sample* sample = trace.next_sample()) calls += sample->call_count;
  return calls;
}

}  // namespace

TEST_CASE("a trial has the same canonical records in every format version") {
  const std::vector<TraceBytes> records = records_of_v1_trial();
  const std::vector<TraceBytes> again = encoded_again(records);
  REQUIRE(records.size() == 37);
  REQUIRE(again.size() == records.size());
  CHECK(again != records);
  const std::vector<TraceBytes> expected = canonical(records);
  const std::vector<TraceBytes> forms = canonical(again);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    INFO("record " << i << " of kind " << int{records[i][4]});
    CHECK(forms[i] == expected[i]);
  }
}

TEST_CASE("of version 1 the canonical form ignores the walking grid and measured times alone") {
  const std::vector<TraceBytes> records = records_of_v1_trial();
  const TraceBytes& world = records.front();
  TraceReader trace{TraceRecords(std::filesystem::path(DMRP_V1_TRIAL))};
  const std::size_t walking_grid_cells = 24 * 20;  // of 0.25 m
  const std::size_t walking_grid_bytes = 1 + 4 + 4 + 8 + 16 + 3 + walking_grid_cells * (1 + 1 + 4);
  CHECK(ignored_bytes(world, world) == walking_grid_bytes);
  CHECK(world.size() - form_after(world, world)->size() == walking_grid_bytes);

  std::size_t in_samples = 0;
  for (std::size_t i = 1; i < records.size(); ++i) {
    const auto kind = TraceRecordKind{records[i][4]};
    const std::size_t ignored = ignored_bytes(world, records[i]);
    if (kind == TraceRecordKind::sample)
      in_samples += ignored;
    else
      CHECK(ignored == (kind == TraceRecordKind::plan ? sizeof(dmrp_plan::planning_ns) : 0));
  }
  CHECK(in_samples == calls_of(trace) * sizeof(dmrp_call::duration_ns));
}
