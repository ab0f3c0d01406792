// SPDX-License-Identifier: MIT
#include "host/verify/trace_digest.hpp"

#include "core/mcap/mcap_reader.hpp"
#include "core/trace/clock_times.hpp"
#include "core/trace/trace.hpp"
#include "host/errors/input_error.hpp"
#include "host/files/sha256.hpp"

namespace dmrp::host {

namespace {

std::string digest_of_messages(const std::filesystem::path& trace) {
  core::McapReader file(trace.string(), core::trace_topic);
  Sha256 hash;
  std::size_t count = 0;
  for (auto message = file.next(); message; message = file.next(), ++count) {
    const core::TraceBytes record = core::without_clock_times(message->data);
    hash.add(&message->log_time_ns, sizeof(message->log_time_ns));
    hash.add(record.data(), record.size());
  }
  if (count == 0) throw InputError(trace.string() + ": has no message of the channel " + core::trace_topic);
  if (!file.is_whole()) throw InputError(trace.string() + ": was cut short");
  return hash.finish();
}

}  // namespace

std::string trace_digest(const std::filesystem::path& trace) {
  try {
    return digest_of_messages(trace);
  } catch (const core::TraceError& error) {
    throw InputError(trace.string() + ": " + error.what());
  }
}

}  // namespace dmrp::host
