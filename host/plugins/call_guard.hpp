// SPDX-License-Identifier: MIT
// call_guard.hpp: the only way to call a plugin function. Records the call in the call note, measures its time, checks the
// floating-point control bits, and turns statuses that end the trial into a PluginFault.
#pragma once

#include <dmrp/status.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>

#include "host/plugins/plugin_fault.hpp"
#include "host/process/call_note.hpp"

namespace dmrp::host {

// One per process: only one plugin function runs at a time.
class CallGuard {
 public:
  explicit CallGuard(CallNote& note) : note_(note) {}

  struct Result {
    std::int32_t status;
    std::int64_t duration_ns;
  };

  // Calls `function`, which returns a status. should_stop() returns true after `budget_ns`. Throws PluginFault for
  // OUT_OF_MEMORY, ERROR, FATAL, unknown statuses, changed control bits and exceptions.
  template <class Function>
  Result call(const CallSite& site, std::int64_t budget_ns, Function&& function) {
    enter(site, budget_ns);
    std::int32_t status = DMRP_ERROR;
    bool threw = false;
    try {
      status = function();
    } catch (...) {
      threw = true;
    }
    return leave(site, status, threw);
  }

  // The functions of host.h for the plugin that runs, from any of its threads.
  bool should_stop();
  void set_error(const char* text);

  // Whether should_stop() has returned true since reset_stopped().
  bool stopped() const { return stopped_; }
  void reset_stopped() { stopped_ = false; }

  // The last text of set_error() in this call.
  std::string error() const;

 private:
  void enter(const CallSite& site, std::int64_t budget_ns);
  Result leave(const CallSite& site, std::int32_t status, bool threw);

  CallNote& note_;
  mutable std::mutex error_mutex_;
  std::string error_;
  std::int64_t start_ns_ = 0;
  std::atomic<std::int64_t> deadline_ns_ = 0;
  std::uint32_t control_bits_ = 0;
  std::atomic<bool> stopped_ = false;
};

}  // namespace dmrp::host
