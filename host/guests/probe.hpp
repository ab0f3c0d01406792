// SPDX-License-Identifier: MIT
// probe.hpp: reads the descriptors of a library in a guest that loads it: a truncated file raises SIGBUS inside dlopen, static
// initialisers may do anything, and neither may end the host.
#pragma once

#include <filesystem>

#include "host/plugins/library.hpp"
#include "host/plugins/plugin_use.hpp"

namespace dmrp::host {

// Calls init() too, so that a library that cannot work here is found before a run begins. Throws std::runtime_error in one
// line, or MachineError.
Probe probe_library(const std::filesystem::path& file, const VisiblePaths& visible = {});

}  // namespace dmrp::host
