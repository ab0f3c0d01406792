// SPDX-License-Identifier: MIT
// kept_trace.hpp: stores a trial's trace until its metrics are measured.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "core/trace/trace_file.hpp"
#include "core/trace/trace_records.hpp"
#include "core/trace/trace_spool.hpp"

namespace dmrp::host {

// A small trace stays in memory, a large one goes to a spool file: crowds and long trials need no more memory than others.
// In addition the trace can be recorded in an MCAP file.
//
//   KeptTrace kept(file, scratch);
//   TraceEncoder trace(world, [&](std::int64_t t_ns, auto record) { kept.write(t_ns, record); }, kept.foxglove());
//   ...
//   TraceReader reader(kept.records(), TraceExtent::samples);
class KeptTrace {
 public:
  // `recorded`: the MCAP file, with channels for Foxglove; empty for none. `scratch`: the path of the spool. All functions
  // throw std::system_error.
  KeptTrace(const std::filesystem::path& recorded, const std::filesystem::path& scratch,
            std::size_t most_bytes_in_memory = core::TraceRecords::small_trace_bytes);
  KeptTrace(const KeptTrace&) = delete;
  KeptTrace& operator=(const KeptTrace&) = delete;

  void write(std::int64_t t_ns, std::span<const std::uint8_t> record);
  core::FoxgloveChannels* foxglove() { return is_recorded() ? &file_->foxglove() : nullptr; }
  bool is_recorded() const { return file_.has_value(); }

  // All records written so far; write() may not be called afterwards. Valid as long as this object.
  core::TraceRecords records();

  // All records, while they are in memory; then none.
  std::span<const std::uint8_t> in_memory() const { return memory_; }
  // The file that has them otherwise; -1 while they are in memory.
  int spool_descriptor();

  // Ends the recorded file, if any.
  void finish();

 private:
  void move_to_spool();

  std::filesystem::path scratch_;
  std::size_t most_bytes_in_memory_;
  core::TraceBytes memory_;                // the records, until there are too many
  std::optional<core::TraceSpool> spool_;  // then it has all of them
  std::optional<core::TraceFileWriter> file_;
};

}  // namespace dmrp::host
