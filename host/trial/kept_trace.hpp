// SPDX-License-Identifier: MIT
// kept_trace.hpp: where a trial's trace is between the trial and its metrics.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "core/trace/trace_file.hpp"
#include "core/trace/trace_records.hpp"
#include "core/trace/trace_spool.hpp"

namespace dmrp::host {

// A small trace stays in memory, a large one in a spool, so that crowds and long trials take no more memory than others.
// Beside that it may be recorded in a file.
//
//   KeptTrace kept(file, scratch);
//   TraceEncoder trace(world, [&](std::int64_t t_ns, auto record) { kept.write(t_ns, record); }, kept.foxglove());
//   ...
//   TraceReader reader(kept.records(), TraceExtent::samples);
class KeptTrace {
 public:
  // `recorded`: the file that is wanted, with what there is to look at; empty for none. `scratch`: a path in a folder
  // with room for the spool. Throws std::system_error, as all it does.
  KeptTrace(const std::filesystem::path& recorded, const std::filesystem::path& scratch,
            std::size_t most_bytes_in_memory = core::TraceRecords::small_trace_bytes);
  KeptTrace(const KeptTrace&) = delete;
  KeptTrace& operator=(const KeptTrace&) = delete;

  void write(std::int64_t t_ns, std::span<const std::uint8_t> record);
  core::FoxgloveChannels* foxglove() { return is_recorded() ? &file_->foxglove() : nullptr; }
  bool is_recorded() const { return file_.has_value(); }

  // All that was written; nothing more is, but to foxglove(). It outlives the reading.
  core::TraceRecords records();

  // Ends the recorded file, if any.
  void finish();

 private:
  void move_to_spool();

  std::filesystem::path scratch_;
  std::size_t most_bytes_in_memory_;
  core::TraceBytes memory_;                // all of it, as long as ...
  std::optional<core::TraceSpool> spool_;  // ... it is not here
  std::optional<core::TraceFileWriter> file_;
};

}  // namespace dmrp::host
