// SPDX-License-Identifier: MIT
// box.hpp: what a process that runs plugins may ask of the kernel. It can compute, start threads and read what it sees
// (view.hpp); it cannot start programs, unless they say that they do, reach other processes, or type into the user's terminal.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>

#include "host/process/view.hpp"

namespace dmrp::host::box {

// For this process and those that it starts: no box, for debuggers.
void disable();

// What the box lacks on this machine, in one line; "" if it is whole.
std::string gaps();

// "namespaces", "calls" where the kernel refuses those, or "none" where it is disabled, or sanitizers exclude it.
std::string kind();

// Whether guests have a view of their own.
bool has_view();

// Closes the memory, descriptors and environment of this process to other processes of its user.
void hide();

// Puts this process into the box, for good. From then on a refused system call raises SIGSYS, which kills the process after
// its number was stored in `refused`, if that is given. `scratch`: the folder for temporary files. Throws MachineError.
void enter(bool processes_allowed, std::atomic<std::int32_t>* refused = nullptr,
           const std::filesystem::path& scratch = view::scratch);

// "kill": of a number stored in `refused`; of 0, that the process had blocked the signal, as system() and popen() do.
std::string name_of(std::int32_t system_call);

}  // namespace dmrp::host::box
