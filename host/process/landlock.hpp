// SPDX-License-Identifier: MIT
// landlock.hpp: the kernel refuses a process to change files outside of one folder.
#pragma once

#include <filesystem>
#include <string>

namespace dmrp::host::landlock {

// Of the kernel's Landlock; 0: it has none.
int version();

// What restrict_writing() cannot refuse on a kernel with this version, in one line; "" if it refuses all.
std::string gap(int version);

// From now on, this thread and all that it starts can create, change, rename and delete files in `folder` alone; "": nowhere.
// They can still write to /dev/null and to what they have open. Does nothing where version() is 0. Throws MachineError.
void restrict_writing(const std::filesystem::path& folder);

}  // namespace dmrp::host::landlock
