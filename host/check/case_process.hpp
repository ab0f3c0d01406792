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
  std::string printed{};     // the beginning of what the child printed, escaped
  std::int64_t call_ns = 0;  // of the processor; 0: not measured
};

// `plugin`: nullptr in cases of the library. `ticks`: calls of a usual trial. Throws MachineError.
CaseOutcome run_case(const CheckCase& check_case, const std::filesystem::path& file, const PluginInfo* plugin,
                     std::uint64_t seed, std::uint32_t ticks);

// The guest's program (host/guests/inside/guest_program.hpp).
int run_case_in_guest(const std::vector<std::string>& arguments, const std::vector<int>& descriptors);

}  // namespace dmrp::host
