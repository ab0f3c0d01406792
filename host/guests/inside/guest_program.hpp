// SPDX-License-Identifier: MIT
// guest_program.hpp: what the process of a guest does: loads one library, in the box, and does what its judge asks.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/guests/exchange/guest_memory.hpp"

namespace dmrp::host {

struct GuestSetup {
  std::string written;  // how the experiment names the library
  std::filesystem::path library;
  std::filesystem::path scratch;      // where it may write
  std::int64_t data_mb = 0;           // a limit on its data; 0: none
  bool processes = false;             // plugins may start processes
  std::int32_t plain_log_level = -1;  // of GuestLimits
  int spool = -1;                     // of a trace that is too large for memory
  GuestMemory::Place memory{};
};

// As texts, without the descriptors.
std::vector<std::string> arguments_of(const GuestSetup& setup);

// Runs until the judge ends it. Returns the exit status. `arguments`: all of arguments_of(); `descriptors`: of the judge's
// part of the memory, the guest's, and the spool, if there is one.
int run_guest(const std::vector<std::string>& arguments, const std::vector<int>& descriptors);

// The exit status of a guest whose memory cannot have the addresses of its judge's: another one can.
inline constexpr int address_taken_exit = 88;

}  // namespace dmrp::host
