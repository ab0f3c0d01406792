// SPDX-License-Identifier: MIT
// box.hpp: what a process that runs plugins may ask of the kernel. It can compute, start threads and use files; it cannot
// start programs, or reach other processes.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

namespace dmrp::host::box {

// For this process and those that it starts: no box, for debuggers.
void disable();

// What the box lacks on this machine, in one line; "" if it is whole.
std::string gaps();

// Puts this process into the box, for good. From then on a refused system call raises SIGSYS, which kills the process after
// its number was stored in `refused`, if that is given.
void enter(bool processes_allowed, std::atomic<std::int32_t>* refused = nullptr);

// "kill": of a number stored in `refused`; of 0, that the process had blocked the signal, as system() and popen() do.
std::string name_of(std::int32_t system_call);

}  // namespace dmrp::host::box
