// SPDX-License-Identifier: MIT
// guest_program.hpp: what the process of a guest does: loads one library, in the box, and does what its judge asks.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/guests/exchange/guest_memory.hpp"
#include "host/plugins/plugin_use.hpp"

namespace dmrp::host {

// What the fork server is told.
struct GuestOrder {
  enum class Program { library, check_case, python } program;
  std::vector<std::string> arguments;
  VisiblePaths visible;          // in the guest's view
  std::vector<int> descriptors;  // three at most
};

// What the process of a guest does, with the descriptors as it has them. Returns the exit status.
using GuestProgram = int (*)(const std::vector<std::string>& arguments, const std::vector<int>& descriptors);

struct GuestSetup {
  std::string written;  // how the experiment names the library
  std::filesystem::path library;
  std::filesystem::path scratch;      // for temporary files
  std::int64_t data_mb = 0;           // a limit on its data; 0: none
  bool processes = false;             // plugins may start processes
  std::int32_t plain_log_level = -1;  // of GuestLimits
  VisiblePaths visible{};             // in its view
  int spool = -1;                     // of a trace that is too large for memory
  GuestMemory::Place memory{};
};

GuestOrder order_of(const GuestSetup& setup);

// The library, what it needs, and what the experiment shows it.
VisiblePaths visible_paths_of(const LibraryUse& library);

// The program of a library, which runs until the judge ends it.
int run_guest(const std::vector<std::string>& arguments, const std::vector<int>& descriptors);

// The exit status of a guest whose memory cannot have the addresses of its judge's: another one can.
inline constexpr int address_taken_exit = 88;

}  // namespace dmrp::host
