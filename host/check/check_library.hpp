// SPDX-License-Identifier: MIT
// check_library.hpp: all cases for a plugin library.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "host/check/case_process.hpp"

namespace dmrp::host {

struct CheckChoice {
  std::filesystem::path file;
  std::string only;  // a regular expression, searched in "ID GROUP/CASE"; empty: all cases
  std::uint64_t seed = 1;
};

// The outcome of a case. `plugin`: nullptr in cases of the library.
struct CheckedCase {
  const PluginInfo* plugin;
  const CheckCase* check_case;
  CaseOutcome outcome;
};

using CheckCounts = std::array<std::size_t, 5>;  // by CheckResult

// What the cases do not try of such a plugin.
std::vector<std::string> not_driven(const PluginInfo& plugin);

// "pass", "skip", "warn", "fail", "crash"
const char* result_name(CheckResult result);

// Runs the cases and passes each outcome to `report`. Throws InputError if the file is no library, or if no case
// is chosen; MachineError.
CheckCounts check_library(const CheckChoice& choice, const std::function<void(const CheckedCase&)>& report);

}  // namespace dmrp::host
