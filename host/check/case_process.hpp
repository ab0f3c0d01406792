// SPDX-License-Identifier: MIT
// case_process.hpp: runs one case in a guest, with limits of time, memory and files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "host/check/check_case.hpp"
#include "host/check/examination.hpp"
#include "host/plugins/plugin_info.hpp"

namespace dmrp::host {

struct CaseOutcome {
  CheckResult result = CheckResult::pass;
  std::string detail;  // one line; "" if it passed
  bool hung = false;
  std::string printed;  // the beginning of what the child printed, escaped
};

// `plugin`: nullptr in cases of the library. Throws MachineError.
CaseOutcome run_case(const CheckCase& check_case, const std::filesystem::path& file, const PluginInfo* plugin,
                     std::uint64_t seed);

// The guest's program (host/guests/inside/guest_program.hpp).
int run_case_in_guest(const std::vector<std::string>& arguments, const std::vector<int>& descriptors);

}  // namespace dmrp::host
