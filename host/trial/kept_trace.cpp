// SPDX-License-Identifier: MIT
#include "host/trial/kept_trace.hpp"

namespace dmrp::host {

namespace fs = std::filesystem;

KeptTrace::KeptTrace(const fs::path& recorded, const fs::path& scratch, std::size_t most_bytes_in_memory)
    : scratch_(scratch), most_bytes_in_memory_(most_bytes_in_memory) {
  // at once: unused pages take no memory, and a growing array would need twice as much
  memory_.reserve(most_bytes_in_memory_);
  if (!recorded.empty()) file_.emplace(recorded);
}

void KeptTrace::write(std::int64_t t_ns, std::span<const std::uint8_t> record) {
  if (file_) file_->write(t_ns, record);
  if (!spool_ && record.size() > most_bytes_in_memory_ - memory_.size()) move_to_spool();
  if (spool_)
    spool_->write(record);
  else
    memory_.insert(memory_.end(), record.begin(), record.end());
}

void KeptTrace::move_to_spool() {
  spool_.emplace(scratch_);
  core::TraceRecords so_far(memory_);
  while (const auto record = so_far.next()) spool_->write(record->whole);
  core::TraceBytes().swap(memory_);
}

core::TraceRecords KeptTrace::records() {
  if (file_) file_->flush();  // it is complete even if a metric crashes
  return spool_ ? core::TraceRecords(*spool_) : core::TraceRecords(memory_);
}

int KeptTrace::spool_descriptor() {
  if (!spool_) return -1;
  spool_->rewind();  // which writes what is buffered
  return spool_->descriptor();
}

void KeptTrace::finish() {
  if (file_) file_->finish();
}

}  // namespace dmrp::host
