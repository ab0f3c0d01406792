// SPDX-License-Identifier: MIT
// trial_trace.hpp: the recorded trace of a trial that the user named.
#pragma once

#include <cstdint>
#include <filesystem>

namespace dmrp::host {

// `option`: of the trial on the command line, for messages. Throws InputError if there is no such run, trial or trace.
std::filesystem::path trace_of(const std::filesystem::path& run_directory, const char* option, std::uint64_t trial);

}  // namespace dmrp::host
