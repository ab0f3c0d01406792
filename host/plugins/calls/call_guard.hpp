// SPDX-License-Identifier: MIT
// call_guard.hpp: the only way to call a plugin function. Records the call in the call note, measures its time, checks the
// floating-point control bits, and turns statuses that end the trial into a PluginFault. A copy of the process that a plugin
// made with fork() ends as it returns from the plugin.
#pragma once

#include <dmrp/host.h>
#include <dmrp/status.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "host/plugins/calls/plugin_fault.hpp"
#include "host/plugins/calls/timing_reason.hpp"
#include "host/process/call_note.hpp"

namespace dmrp::host {

// What a function may return besides DMRP_OK, DMRP_WARNING and the errors: the table in status.h.
enum class Answers { no_other, unsupported, no_solution, plan };

// One per process: only one plugin function runs at a time.
class CallGuard {
 public:
  explicit CallGuard(CallNote& note) : note_(note) {}

  struct Result {
    std::int32_t status;
    std::int64_t duration_ns;
  };

  // Calls `function`, which returns a status. `caller`: the host of the library or instance; should_stop() of that host
  // returns true after `budget_ns`. Throws PluginFault for OUT_OF_MEMORY, ERROR, FATAL, UNSUPPORTED, statuses that the
  // function may not return, changed control bits, exceptions and copies of the process.
  template <class Function>
  Result call(const dmrp_host* caller, const CallSite& site, std::int64_t budget_ns, Answers answers,
              Function&& function) {
    enter(caller, site, budget_ns);
    std::int32_t status = DMRP_ERROR;
    bool threw = false;
    try {
      status = function();
    } catch (...) {
      threw = true;
    }
    return leave(site, answers, status, threw);
  }

  // How long a call may take with this budget; a longer one counts as hanging.
  static std::int64_t longest_ns(std::int64_t budget_ns);

  // The functions of host.h, from any thread. Outside a call of the caller should_stop() returns true and set_error()
  // does nothing.
  bool should_stop(const dmrp_host* caller) noexcept;
  std::int64_t budget_left_ns(const dmrp_host* caller) noexcept;
  void set_error(const dmrp_host* caller, const char* text) noexcept;

  // The host refuses what the call that runs has asked of an extension: a breach, whatever the call returns.
  void refuse(const std::string& text) noexcept;

  // From now on should_stop() returns true after so many asks in a call, whatever the time. How often the calls have asked
  // since.
  void stop_after_asks(std::int64_t count);
  std::int64_t asks() const { return asks_; }

  // The function of ext/timing.h, as set_error().
  void depends_on_timing(const dmrp_host* caller, const std::string& plugin, const char* text) noexcept;

  // Why results since reset_timing() depend on timing: calls that asked for the time left or were stopped, and what plugins say of
  // themselves with depends_on_timing(). The first reason of each plugin.
  std::vector<TimingReason> timing() const;
  void reset_timing();

  // Whether a call runs.
  bool in_call() const { return caller_ != nullptr; }

  // Throws PluginFault, in the name of the last call, if a plugin has left a process behind.
  void check_no_children() const;

  // Plugins may start processes.
  void allow_processes() { processes_allowed_ = true; }

  // The last text of set_error() in this call, or in the last one; escaped.
  std::string error() const;

 private:
  void enter(const dmrp_host* caller, const CallSite& site, std::int64_t budget_ns);
  Result leave(const CallSite& site, Answers answers, std::int32_t status, bool threw);

  void add_timing(const std::string& plugin, const std::string& text);

  CallNote& note_;
  mutable std::mutex text_mutex_;
  std::string error_;
  std::string refusal_;  // of the call that runs: the first
  std::vector<TimingReason> timing_;
  std::int64_t start_ns_ = 0;
  std::atomic<const dmrp_host*> caller_ = nullptr;  // of the call that runs
  std::atomic<std::int64_t> deadline_ns_ = 0;
  std::uint32_t control_bits_ = 0;
  bool processes_allowed_ = false;
  std::atomic<bool> stopped_ = false;     // the call that runs
  std::atomic<bool> asked_time_ = false;  // the call that runs asked for the time left
  std::atomic<std::int64_t> asks_ = 0;
  std::int64_t asks_before_ = 0;  // the call that runs
  std::int64_t most_asks_ = -1;   // -1: time alone counts
};

}  // namespace dmrp::host
