// SPDX-License-Identifier: MIT
#include "host/results/trace_path.hpp"

#include <fmt/format.h>

namespace dmrp::host {

std::filesystem::path trace_path(const std::filesystem::path& run_directory, std::uint64_t trial) {
  return run_directory / "traces" / fmt::format("trial_{:06}.mcap", trial);
}

}  // namespace dmrp::host
