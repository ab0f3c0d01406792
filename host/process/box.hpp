// SPDX-License-Identifier: MIT
// box.hpp: what a process that runs plugins may ask of the kernel. It can compute, start threads and use files; it cannot
// start programs, reach other processes, or type into the user's terminal. In a sandbox it cannot open sockets either, and
// writes in one folder alone.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>

namespace dmrp::host::box {

// For this process and those that it starts: no box, for debuggers.
void disable();

// For this process and those that it starts: the box is a sandbox.
void demand_sandbox();

// What the box lacks on this machine, in one line; "" if it is whole.
std::string gaps();

// What the sandbox lacks beyond that, in one line; "" if it is whole.
std::string sandbox_gaps();

// "sandbox", "box", or "none" where it is disabled, or sanitizers exclude it.
std::string kind();

// Closes the memory, descriptors and environment of this process to other processes of its user.
void hide();

// Puts this process into the box, for good. From then on a refused system call raises SIGSYS, which kills the process after
// its number was stored in `refused`, if that is given. What a sandbox refuses in addition fails with an error. `scratch`:
// the folder in which it may write; "": it may write in none. Throws MachineError.
void enter(bool processes_allowed, std::atomic<std::int32_t>* refused = nullptr,
           const std::filesystem::path& scratch = {});

// "kill": of a number stored in `refused`; of 0, that the process had blocked the signal, as system() and popen() do.
std::string name_of(std::int32_t system_call);

}  // namespace dmrp::host::box
