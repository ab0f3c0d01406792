// SPDX-License-Identifier: MIT
// own_process.hpp: tells a process that runs plugins from the copies that a plugin makes of it. A plugin that calls fork()
// and returns twice would otherwise answer its judge twice.
#pragma once

#include <cstdint>

namespace dmrp::host::own_process {

// Call it before plugins are loaded. Throws MachineError.
void watch();

// Whether this is a copy of the process that called watch(). Costs no system call.
bool is_copy();

// How often this process was copied by fork(). Copies made by system calls alone are not counted.
std::uint64_t copies_made();

// Whether this process has children, alive or dead.
bool has_children();

}  // namespace dmrp::host::own_process
