// SPDX-License-Identifier: MIT
// landlock.hpp: the kernel refuses a process to reach processes that are not under the same rules.
#pragma once

namespace dmrp::host::landlock {

// Of the kernel's Landlock; 0: it has none.
int version();

// Whether set_apart() does something on a kernel with this version.
bool sets_apart(int version);

// Keeps this thread and all that it starts from looking into processes outside, whoever their user is; from version 6 on,
// they cannot signal them or reach their abstract sockets either. Files stay open to it. Throws MachineError.
void set_apart();

}  // namespace dmrp::host::landlock
