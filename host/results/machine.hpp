// SPDX-License-Identifier: MIT
// machine.hpp: properties of the machine that can change the bits of a result.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dmrp::host {

struct Machine {
  std::string libc;                       // "glibc 2.36"; libm selects code by CPU features
  std::string cpu_level;                  // "x86-64-v3", as in glibc's hwcaps; the architecture elsewhere
  std::vector<std::string> cpu_features;  // flags, sorted
  std::string compiler;                   // of the host
};

Machine this_machine();

// For tests: the sorted flags in a text like /proc/cpuinfo, and the highest level whose flags are all present.
std::vector<std::string> cpu_features_of(std::string_view cpuinfo);
std::string x86_64_level_of(const std::vector<std::string>& features);

}  // namespace dmrp::host
