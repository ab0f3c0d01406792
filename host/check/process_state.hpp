// SPDX-License-Identifier: MIT
// process_state.hpp: what a plugin may not change in its process.
#pragma once

#include <string>
#include <vector>

namespace dmrp::host {

struct ProcessState {
  std::string locale;
  std::string folder;                    // working directory
  std::vector<std::string> environment;  // sorted
  std::vector<const void*> handlers;     // of signals
  std::vector<std::string> descriptors;  // "3: file 17 of device 1", sorted
  unsigned file_mode_mask = 0;

  static ProcessState now();

  // The first difference from `before`, in one line; "" if there is none.
  std::string change_since(const ProcessState& before) const;
};

// Threads of this process.
std::size_t thread_count();

}  // namespace dmrp::host
