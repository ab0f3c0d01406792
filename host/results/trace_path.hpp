// SPDX-License-Identifier: MIT
// trace_path.hpp: the place of a trial's trace.
#pragma once

#include <cstdint>
#include <filesystem>

namespace dmrp::host {

std::filesystem::path trace_path(const std::filesystem::path& run_directory, std::uint64_t trial);

}  // namespace dmrp::host
