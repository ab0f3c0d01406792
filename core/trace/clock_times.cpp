// SPDX-License-Identifier: MIT
#include "core/trace/clock_times.hpp"

#include <algorithm>
#include <map>
#include <sstream>
#include <string>

#include "core/trace/trace.hpp"
#include "core/trace/trace_schema.hpp"

namespace dmrp::core {
namespace {

constexpr std::size_t clock_bytes = sizeof(std::int64_t);

// A number, a struct of numbers, or elements of one.
struct Field {
  std::size_t bytes = 0;
  std::vector<std::size_t> clocks{};  // where they are
  bool elements = false;
};

// The fields of each kind of record, but for those after a text, a block or an array: no clock's time comes after one.
std::map<TraceRecordKind, std::vector<Field>> read_list() {
  std::map<std::string, Field> types = {{"u8", {1}},  {"u16", {2}}, {"u32", {4}},
                                        {"u64", {8}}, {"i32", {4}}, {"i64", {8}},
                                        {"f32", {4}}, {"f64", {8}}, {"clock", {clock_bytes, {0}}}};
  std::map<TraceRecordKind, std::vector<Field>> records;
  std::istringstream list(trace_schema());
  for (std::string name, head, field; std::getline(list, head, ':');) {
    std::istringstream words(head);
    int kind = 0;  // of what is no record
    words >> name >> field >> kind;
    std::getline(list, head);
    std::istringstream fields(head);
    Field whole;
    while (std::getline(fields, field, ',')) {
      std::istringstream type(field);
      type >> field;
      const bool elements = field == "elements";
      if (elements) type >> field;
      if (!types.contains(field)) break;
      Field one = types[field];
      one.elements = elements;
      for (const std::size_t clock : one.clocks) whole.clocks.push_back(whole.bytes + clock);
      whole.bytes += one.bytes;
      records[static_cast<TraceRecordKind>(kind)].push_back(std::move(one));
    }
    types[name] = std::move(whole);
  }
  return records;
}

}  // namespace

TraceBytes without_clock_times(std::span<const std::uint8_t> record) {
  static const auto list = read_list();
  TraceBytes bytes(record.begin(), record.end());
  ByteCursor in(record);
  if (in.take<std::uint32_t>() + sizeof(TraceRecordKind) != in.rest().size())
    in.fail("a message that is not one record");
  const auto kind = in.take<TraceRecordKind>();
  if (kind == TraceRecordKind::world && ByteCursor(in).take<std::uint32_t>() != trace_format_version)
    in.fail("a format version that is not known");
  const auto fields = list.find(kind);
  if (fields == list.end()) in.fail("the kind of the record is unknown");
  for (const Field& field : fields->second) {
    const auto count = field.elements ? in.take<std::uint32_t>() : 1;
    const std::size_t stride = field.elements ? in.take<std::uint32_t>() : field.bytes;
    in.require(count, std::max<std::size_t>(stride, 1));
    for (std::uint32_t i = 0; i < count; ++i) {
      const ByteCursor one = in.part(stride);
      one.require(field.bytes, 1);
      for (const std::size_t clock : field.clocks)
        std::fill_n(bytes.data() + one.position() + clock, clock_bytes, std::uint8_t{0});
    }
  }
  return bytes;
}

}  // namespace dmrp::core
