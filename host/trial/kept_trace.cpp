// SPDX-License-Identifier: MIT
#include "host/trial/kept_trace.hpp"

#include <utility>

namespace dmrp::host {

namespace fs = std::filesystem;

KeptTrace::KeptTrace(const fs::path& recorded, const fs::path& scratch, std::size_t most_bytes_in_memory)
    : recorded_(recorded), scratch_(scratch), most_bytes_in_memory_(most_bytes_in_memory) {
  // all at once: what is not used takes no memory, and growing would take it twice
  memory_.reserve(most_bytes_in_memory_);
  if (is_recorded()) file_.emplace(recorded_);
}

void KeptTrace::write(std::int64_t t_ns, std::span<const std::uint8_t> record) {
  if (is_in_memory_ && record.size() > most_bytes_in_memory_ - memory_.size()) {
    if (!is_recorded()) move_to_scratch();
    core::TraceBytes().swap(memory_);
    is_in_memory_ = false;
  }
  if (is_in_memory_) memory_.insert(memory_.end(), record.begin(), record.end());
  if (file_) file_->write(t_ns, record);
}

// The name goes at once: whatever happens to the process, nothing is left behind.
void KeptTrace::move_to_scratch() {
  file_.emplace(scratch_);
  nameless_.emplace(scratch_);
  fs::remove(scratch_);
  core::TraceRecords so_far(memory_);
  while (const auto record = so_far.next()) file_->write(0, record->whole);
}

core::TraceRecords KeptTrace::records() {
  if (file_) file_->flush();
  if (is_in_memory_) return core::TraceRecords(memory_);
  return nameless_ ? std::move(*nameless_) : core::TraceRecords(recorded_);
}

void KeptTrace::finish() {
  if (is_recorded()) file_->finish();
}

}  // namespace dmrp::host
