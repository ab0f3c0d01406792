// SPDX-License-Identifier: MIT
// own_process.hpp: tells a process that runs plugins from the copies that a plugin makes of it. A plugin that calls fork()
// and returns twice would otherwise run the same trial twice, with one channel to the supervisor.
#pragma once

#include <cstdint>
#include <initializer_list>

namespace dmrp::host::own_process {

// Call it before plugins are loaded. Copies close `descriptors`. Throws MachineError.
void watch(std::initializer_list<int> descriptors);

// Whether the descriptors are what they were.
bool has_descriptors();

// Whether this is a copy of the process that called watch(). Costs no system call.
bool is_copy();

// As is_copy(), and true as well in processes that share the memory of the one that called watch().
bool is_other_process();

// How often this process was copied by fork(). Copies made by system calls alone are not counted.
std::uint64_t copies_made();

// Whether this process has children, alive or dead.
bool has_children();

}  // namespace dmrp::host::own_process
