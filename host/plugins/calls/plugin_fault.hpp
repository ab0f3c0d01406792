// SPDX-License-Identifier: MIT
// plugin_fault.hpp: a plugin broke its contract; the trial, or the metric, ends as a fault.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "host/process/fault_kind.hpp"

namespace dmrp::host {

// A call into a plugin.
struct CallSite {
  std::string_view plugin;    // id; valid as long as the instance
  const char* function = "";  // as in the contract: "plan", "step", ...
  std::int64_t step = 0;      // physics steps since the trial's start
  std::int32_t robot = -1;    // of a local controller
};

// "org.example.planner: plan(): TEXT"
inline std::string call_text(const std::string& plugin, const std::string& function, const std::string& text) {
  return plugin + ": " + function + "(): " + text;
}

class PluginFault : public std::runtime_error {
 public:
  // `fatal`: the library is unusable, no function of it may be called again.
  PluginFault(const char* kind, const CallSite& site, const std::string& detail, bool fatal = false)
      : std::runtime_error(detail),
        kind_(kind),
        plugin_(site.plugin),
        function_(site.function),
        step_(site.step),
        robot_(site.robot),
        fatal_(fatal) {}
  const char* kind() const { return kind_; }
  const std::string& plugin() const { return plugin_; }
  const std::string& function() const { return function_; }
  std::int64_t step() const { return step_; }
  std::int32_t robot() const { return robot_; }
  bool fatal() const { return fatal_; }

  std::string text() const { return call_text(plugin_, function_, what()); }

 private:
  const char* kind_;
  std::string plugin_;
  std::string function_;
  std::int64_t step_;
  std::int32_t robot_;
  bool fatal_;
};

// Calls `function`; a fault gets `reason`, which is known by then, at the end of its text.
template <class Function>
auto with_reason(Function&& function, const std::string& reason) {
  try {
    return function();
  } catch (const PluginFault& fault) {
    throw PluginFault(fault.kind(), {fault.plugin(), fault.function().c_str(), fault.step(), fault.robot()},
                      fault.what() + reason, fault.fatal());
  }
}

}  // namespace dmrp::host
