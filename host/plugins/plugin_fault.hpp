// SPDX-License-Identifier: MIT
// plugin_fault.hpp: a plugin broke its contract; the trial (or the metric) ends as a fault.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace dmrp::host {

// As in results.sqlite. crash, hang and exit are found by the supervisor, never thrown.
namespace fault_kind {
inline constexpr const char* crash = "crash";
inline constexpr const char* hang = "hang";
inline constexpr const char* out_of_memory = "out_of_memory";
inline constexpr const char* bad_output = "bad_output";
inline constexpr const char* abi_breach = "abi_breach";
inline constexpr const char* error_status = "error_status";
inline constexpr const char* exit = "exit";
}  // namespace fault_kind

// A call into a plugin: who, what, when.
struct CallSite {
  std::string plugin;         // id
  const char* function = "";  // as in the contract: "plan", "step", ...
  std::int64_t step = 0;      // physics steps since the trial's start
  std::int32_t robot = -1;    // of a local controller
};

class PluginFault : public std::runtime_error {
 public:
  PluginFault(const char* kind, const CallSite& site, const std::string& detail)
      : std::runtime_error(detail), kind_(kind), site_(site) {}
  const char* kind() const { return kind_; }
  const CallSite& site() const { return site_; }

 private:
  const char* kind_;
  CallSite site_;
};

}  // namespace dmrp::host
