// SPDX-License-Identifier: MIT
// orphans.hpp: processes that plugins started, also those that outlive the child which ran the plugin.
#pragma once

#include <sys/types.h>

#include <vector>

namespace dmrp::host {

// From now on processes whose parent ends become children of this process, instead of the machine's first process.
void adopt_orphans();

// The children of all threads of a process. Empty where the kernel does not say.
std::vector<pid_t> children_of(pid_t process);

// Kills all children of this process but those to keep, and the children that they leave.
void kill_orphans(const std::vector<pid_t>& keep);

}  // namespace dmrp::host
