// SPDX-License-Identifier: MIT
#include "core/trace/clock_times.hpp"

#include <catch2/catch.hpp>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/trace/trace_reader.hpp"
#include "tests/unit/core/trace/trace_example.hpp"

using namespace dmrp::core;

namespace {

// None if it cannot be read.
std::optional<TraceBytes> form_of(const TraceBytes& record) {
  try {
    return without_clock_times(record);
  } catch (const TraceError&) {
    return std::nullopt;
  }
}

// The number of bytes of a record that may change without a change of its form.
std::size_t ignored_bytes(const TraceBytes& record) {
  const std::optional<TraceBytes> form = form_of(record);
  REQUIRE(form);
  std::size_t ignored = 0;
  for (std::size_t i = 0; i < record.size(); ++i) {
    TraceBytes changed = record;
    changed[i] ^= 1;
    ignored += form_of(changed) == form ? 1 : 0;
  }
  return ignored;
}

std::vector<TraceBytes> records_of_example() {
  std::vector<TraceBytes> records;
  dmrp::test::example_trace(6, [&](std::int64_t, std::span<const std::uint8_t> record) {
    records.emplace_back(record.begin(), record.end());
  });
  return records;
}

std::size_t bytes_of_calls(const TraceBytes& trace) {
  TraceReader reader(trace);
  std::size_t bytes = 0;
  while (const dmrp_sample* sample = reader.next_sample()) bytes += sample->call_count * sizeof(dmrp_call::duration_ns);
  return bytes;
}

}  // namespace

TEST_CASE("a record without clocks' times lacks these alone") {
  std::size_t in_samples = 0;
  for (const TraceBytes& record : records_of_example()) {
    const auto kind = TraceRecordKind{record[4]};
    INFO("a record of kind " << int{record[4]});
    const TraceBytes form = without_clock_times(record);
    CHECK(form.size() == record.size());
    CHECK(without_clock_times(form) == form);
    const std::size_t ignored = ignored_bytes(record);
    if (kind == TraceRecordKind::sample)
      in_samples += ignored;
    else
      CHECK(ignored ==
            (kind == TraceRecordKind::plan ? sizeof(dmrp_plan::planning_ns) + sizeof(dmrp_plan::processor_ns) : 0));
  }
  CHECK(in_samples > 0);
  CHECK(in_samples == bytes_of_calls(dmrp::test::example_trace(6)));
}

TEST_CASE("a record of another format, cut or of an unknown kind has no form") {
  TraceBytes world = records_of_example().front();
  REQUIRE(form_of(world));
  ++world[5];  // its version
  CHECK_FALSE(form_of(world));
  TraceBytes sample = records_of_example().back();
  sample.pop_back();
  CHECK_FALSE(form_of(sample));
  CHECK_FALSE(form_of({0, 0, 0, 0, 99}));
}
