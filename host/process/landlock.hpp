// SPDX-License-Identifier: MIT
// landlock.hpp: the kernel refuses a process to change files outside of one folder, and to reach processes that are not
// under the same rules.
#pragma once

#include <filesystem>
#include <string>

namespace dmrp::host::landlock {

// Of the kernel's Landlock; 0: it has none.
int version();

// What restrict_writing() cannot refuse on a kernel with this version, in one line; "" if it refuses all.
std::string gap(int version);

// Whether set_apart() does something on a kernel with this version.
bool sets_apart(int version);

// Keeps this thread and all that it starts from looking into processes outside, whoever their user is; from version 6 on,
// they cannot signal them or reach their abstract sockets either. Files stay open to it. Throws MachineError.
void set_apart();

// The same, and they can create, change, rename and delete files in `folder` alone; "": nowhere.
// They can still write to /dev/null and to what they have open. Does nothing where version() is 0. Throws MachineError.
void restrict_writing(const std::filesystem::path& folder);

}  // namespace dmrp::host::landlock
