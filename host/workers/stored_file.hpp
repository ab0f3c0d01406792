// SPDX-License-Identifier: MIT
// stored_file.hpp: the way of a trace or a plan from the worker's scratch folder into the run directory.
#pragma once

#include <filesystem>
#include <functional>

namespace dmrp::host {

// Moves the file `written` to `stored`, in place of one that may be there; it outlives a power cut from then on. False if
// `written` is no regular file that can be read: plugins can have done anything to it, and to the folder of `stored`,
// which `make_folder` makes again where it is missing. Throws std::system_error if the machine fails.
bool store_file(const std::filesystem::path& written, const std::filesystem::path& stored,
                const std::function<void()>& make_folder);

}  // namespace dmrp::host
