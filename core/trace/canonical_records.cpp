// SPDX-License-Identifier: MIT
#include "core/trace/canonical_records.hpp"

#include "core/trace/trace_field_reader.hpp"
#include "core/trace/trace_field_writer.hpp"

namespace dmrp::core {
namespace {

template <class Content>
TraceBytes written_again(RecordCursor& in, TraceRecordKind kind) {
  TraceStorage storage;
  const auto content = read_fields<Content>(in, &storage);
  TraceBytes bytes;
  write_record(bytes, kind, content, TraceForm::canonical, 0);
  return bytes;
}

}  // namespace

TraceBytes canonical_record(std::span<const std::uint8_t> record) {
  ByteCursor prefix(record);
  const auto body_bytes = prefix.take<std::uint32_t>();
  const auto kind = prefix.take<TraceRecordKind>();
  if (body_bytes != prefix.rest().size()) prefix.fail("a message that is not one record");
  if (kind == TraceRecordKind::world && ByteCursor(prefix).take<std::uint32_t>() != trace_format_version)
    prefix.fail("a format version that is not known");
  RecordCursor body(prefix.rest(), prefix.position());
  switch (kind) {
    case TraceRecordKind::world:
      return written_again<TraceWorld>(body, kind);
    case TraceRecordKind::plan:
      return written_again<TracePlan>(body, kind);
    case TraceRecordKind::sample:
      return written_again<TraceSample>(body, kind);
    case TraceRecordKind::scan:
      return written_again<TraceScan>(body, kind);
    case TraceRecordKind::trajectory:
      return written_again<TraceTrajectory>(body, kind);
    case TraceRecordKind::note:
      return written_again<TraceNote>(body, kind);
    case TraceRecordKind::end:
      return written_again<TraceEnd>(body, kind);
  }
  throw TraceError(0, "the kind of the record is unknown");
}

}  // namespace dmrp::core
