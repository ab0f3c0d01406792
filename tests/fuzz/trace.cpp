// SPDX-License-Identifier: MIT
// The records of a trial by themselves, without the checksums and the compression of MCAP.
#include "core/trace/trace_reader.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    dmrp::core::TraceReader trace(std::span<const std::uint8_t>(data, size));
    while (trace.next_sample()) {
    }
  } catch (const dmrp::core::TraceError&) {
  }
  return 0;
}
