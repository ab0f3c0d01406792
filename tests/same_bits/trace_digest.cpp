// SPDX-License-Identifier: MIT
// trace_digest [--records] TRACE.mcap...: for each file a line `SHA-256  file`, the digest that host/verify/trace_digest.hpp
// defines. With --records a line for each record in its place, `number kind
// log_time_ns bytes SHA-256`, so that the diff of two lists shows where two trials part.
//
// Exit status 1 where a trace is damaged or was cut short.
#include "host/verify/trace_digest.hpp"

#include <cstddef>
#include <cstdio>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/bytes/trace_bytes.hpp"
#include "core/mcap/mcap_reader.hpp"
#include "core/trace/clock_times.hpp"
#include "core/trace/trace.hpp"
#include "host/files/sha256.hpp"

namespace {

using dmrp::core::McapReader;
using dmrp::core::TraceBytes;
using dmrp::host::Sha256;

// On standard output: a line a record.
void print_records(const char* path) {
  McapReader file(path, dmrp::core::trace_topic);
  std::size_t number = 0;
  for (auto message = file.next(); message; message = file.next(), ++number) {
    const TraceBytes record = dmrp::core::without_clock_times(message->data);
    Sha256 one;
    one.add(record.data(), record.size());
    std::printf("%zu %d %lld %zu %s\n", number, record[4], static_cast<long long>(message->log_time_ns), record.size(),
                one.finish().c_str());
  }
}

void print_digest(const char* path) {
  std::printf("%s  %s\n", dmrp::host::trace_digest(path).c_str(), path);
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
      each_record ? print_records(path) : print_digest(path);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "trace_digest: %s: %s\n", path, error.what());
      status = 1;
    }
  return status;
}
