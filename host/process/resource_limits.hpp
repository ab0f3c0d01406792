// SPDX-License-Identifier: MIT
// resource_limits.hpp: limits of a process that runs plugins.
#pragma once

#include <cstdint>
#include <string>

namespace dmrp::host {

// Limits the data of this process to `memory_mb` (0: no limit; never under sanitizers): memory that it can write to and
// shares with nobody, touched or not. Reserved address space does not count. Disables core dumps. A lower limit that is
// already set stays.
void set_resource_limits(std::int64_t memory_mb);

// What a process lacked that found no more memory: its own limit of `memory_mb` (0: it has none), or one that was there
// before, of the shell or job, or the machine.
std::string lack_of_memory(std::int64_t memory_mb);

// The processor time of a process that may take `wall_s`, if so many share the processors: each has its share of them, and
// at least one.
double processor_time_s(double wall_s, unsigned sharers = 1);

// Limits the files that this process writes.
void limit_files(std::int64_t file_mb);

}  // namespace dmrp::host
