// SPDX-License-Identifier: MIT
// own_process.hpp: tells a process that runs plugins from the copies that a plugin makes of it. A plugin that calls fork()
// and returns twice would otherwise answer its judge twice.
#pragma once

namespace dmrp::host::own_process {

// Call it before plugins are loaded. Throws MachineError.
void watch();

// Whether this is a copy of the process that called watch(). Costs no system call.
bool is_copy();

// Whether this process has children, alive or dead.
bool has_children();

}  // namespace dmrp::host::own_process
