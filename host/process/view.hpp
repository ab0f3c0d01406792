// SPDX-License-Identifier: MIT
// view.hpp: what a process that runs a plugin sees of the machine: the system's programs and libraries, the files that it was
// given, all of them read-only, and an empty folder for temporary files. No other process, no network, nothing of its user.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dmrp::host::view {

// Why processes cannot have a view of their own here, in one line; "" if they can. Tries it once, in a child; processes that
// this one starts know.
std::string gap();

// The folder for temporary files.
inline constexpr const char* scratch = "/tmp";

// In a path: the files of its folder, but for experiments and results, and without subfolders.
inline constexpr const char* all_files = "*";

// Gives this process, which has one thread, a view of its own, with `visible`, absolute paths. The processes that it starts
// from now on are in a namespace of processes: when the first of them ends, the kernel ends the others. Throws MachineError.
void leave(const std::vector<std::string>& visible);

}  // namespace dmrp::host::view
