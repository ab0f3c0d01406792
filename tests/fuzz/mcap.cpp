// SPDX-License-Identifier: MIT
// Trace files: MCAP, and in it the records of a trial.
#include "core/trace/trace_reader.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/unit/host/experiment/experiment_example.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dmrp;
  static const test::ExperimentFolder folder;
  fuzz::write_file("trial.mcap", fuzz::text(data, size));
  try {
    core::TraceReader trace(core::TraceRecords(std::filesystem::path("trial.mcap")));
    while (trace.next_sample()) {
    }
  } catch (const core::TraceError&) {
  }
  return 0;
}
