// SPDX-License-Identifier: MIT
// trace_digest [--records] TRACE.mcap...: for each file a line `SHA-256  file` over its channel dmrp/trace, that which
// metrics read, but for what was measured by a clock. With --records a line for each record in its place, `number kind
// log_time_ns bytes SHA-256`, so that the diff of two lists shows where two trials part.
//
// In the digest: every message of the channel, in the order of the file: its log time, and its record in the form of
// canonical_records.hpp, which is the same for all format versions. (The world's call_budget_ns is a setting.) Not in
// the digest: how the messages are spread over compressed chunks, and the channels for people to look at, of which /log
// names the planning time.
//
// Exit status 1 where a trace is damaged or was cut short.
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/bytes/trace_bytes.hpp"
#include "core/mcap/mcap_reader.hpp"
#include "core/trace/trace.hpp"
#include "host/files/sha256.hpp"
#include "tests/same_bits/canonical_records.hpp"

namespace {

using dmrp::core::McapReader;
using dmrp::core::TraceBytes;
using dmrp::host::Sha256;

// On standard output: a line a record, or one for all.
void print_digest(const char* path, bool each_record) {
  McapReader file(path, dmrp::core::trace_topic);
  dmrp::test::CanonicalRecords records;
  Sha256 all;
  std::size_t number = 0;
  for (auto message = file.next(); message; message = file.next(), ++number) {
    const TraceBytes record = records.next(message->data);
    all.add(&message->log_time_ns, sizeof(message->log_time_ns));
    all.add(record.data(), record.size());
    if (!each_record) continue;
    Sha256 one;
    one.add(record.data(), record.size());
    std::printf("%zu %d %lld %zu %s\n", number, record[4], static_cast<long long>(message->log_time_ns), record.size(),
                one.finish().c_str());
  }
  if (number == 0) throw std::runtime_error("no message of the channel " + std::string(dmrp::core::trace_topic));
  if (!file.is_whole()) throw std::runtime_error("the file was cut short");
  if (!each_record) std::printf("%s  %s\n", all.finish().c_str(), path);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<const char*> paths(argv + 1, argv + argc);
  const bool each_record = !paths.empty() && std::strcmp(paths[0], "--records") == 0;
  if (each_record) paths.erase(paths.begin());
  if (paths.empty()) {
    std::fprintf(stderr, "usage: trace_digest [--records] TRACE.mcap...\n");
    return 2;
  }
  int status = 0;
  for (const char* path : paths) try {
      print_digest(path, each_record);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "trace_digest: %s: %s\n", path, error.what());
      status = 1;
    }
  return status;
}
