// SPDX-License-Identifier: MIT
// stored_trace.hpp: the way of a trace from the worker's scratch folder into the run's traces.
#pragma once

#include <filesystem>

namespace dmrp::host {

// Moves the file `written` to `stored`, in place of one that may be there; it outlives a power cut from then on. False if
// `written` is no regular file that can be read: plugins can have done anything to it. Throws std::system_error if the
// machine fails.
bool store_trace(const std::filesystem::path& written, const std::filesystem::path& stored);

}  // namespace dmrp::host
