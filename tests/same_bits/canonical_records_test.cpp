// SPDX-License-Identifier: MIT
#include "core/trace/canonical_records.hpp"

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
    return canonical_record(record);
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

// The bytes of measured times in samples, and of the strides of arrays without elements, which say nothing.
std::size_t bytes_without_meaning(const TraceBytes& trace) {
  TraceReader reader(trace);
  std::size_t bytes = 0;
  while (const dmrp_sample* sample = reader.next_sample()) {
    bytes += sample->call_count * sizeof(dmrp_call::duration_ns);
    for (const std::uint32_t count : {sample->contact_count, sample->event_count})
      if (count == 0) bytes += sizeof(std::uint32_t);
  }
  return bytes;
}

}  // namespace

TEST_CASE("the canonical form of a record ignores measured times alone") {
  std::size_t in_samples = 0;
  for (const TraceBytes& record : records_of_example()) {
    const auto kind = TraceRecordKind{record[4]};
    INFO("a record of kind " << int{record[4]});
    const std::size_t ignored = ignored_bytes(record);
    if (kind == TraceRecordKind::sample)
      in_samples += ignored;
    else
      CHECK(ignored ==
            (kind == TraceRecordKind::plan ? sizeof(dmrp_plan::planning_ns) + sizeof(dmrp_plan::processor_ns) : 0));
  }
  CHECK(in_samples == bytes_without_meaning(dmrp::test::example_trace(6)));
}

TEST_CASE("the canonical form is the record with 0 for measured times, and its own form") {
  for (const TraceBytes& record : records_of_example()) {
    const TraceBytes form = canonical_record(record);
    const auto kind = TraceRecordKind{record[4]};
    INFO("a record of kind " << int{record[4]});
    CHECK(form.size() == record.size());
    if (kind != TraceRecordKind::plan && kind != TraceRecordKind::sample) CHECK(form == record);
    CHECK(canonical_record(form) == form);
  }
}
