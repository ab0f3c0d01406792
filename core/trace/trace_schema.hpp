// SPDX-License-Identifier: MIT
// trace_schema.hpp: the fields of every record in text, which stands in the file as the schema of the channel, so that
// readers in other languages follow the file and not this program.
//
// A line is `name: fields`, or `name = kind: fields` of a record; a field is a type and a name. Types are numbers (u8,
// u16, u32, u64, i32, i64, f32, f64), names of earlier lines, whose fields then stand in place, without padding, and
//
//   clock                 i64 of nanoseconds that a clock measured: others at each run; clock_times.hpp finds them
//   text                  u32 count · UTF-8
//   array T               u32 count · the values
//   elements T            u32 count · u32 stride · the elements, each a T and what the contract appended to it
//   block T               u32 length · a T and what was appended to it
//   blocks T              u32 count · each as a block
//   optional block T      u8 0 or 1 · if 1, the block
//   optional T NAME*A*B   u8 0 or 1 · if 1, values, as many as the product of earlier fields and numbers
//
// It comes from trace_layout.hpp, by which records are written and read; tests/python compares what both say of a file.
#pragma once

#include <string>

namespace dmrp::core {

inline constexpr const char* trace_schema_name = "dmrp.Trace";
inline constexpr const char* trace_schema_encoding = "dmrpfields";
std::string trace_schema();

}  // namespace dmrp::core
