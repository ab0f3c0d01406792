// SPDX-License-Identifier: MIT
// trial_trace.hpp: the recorded trace of a trial that the user named.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace dmrp::host {

struct TrialTrace {
  std::filesystem::path file;
  std::string title;  // for pictures: "quickstart, trial 0: mall, CBS + DWA + social force"
};

// `option`: of the trial on the command line, for messages. Throws InputError if there is no such run, trial or trace.
TrialTrace trace_of(const std::filesystem::path& run_directory, const char* option, std::uint64_t trial);

}  // namespace dmrp::host
