// SPDX-License-Identifier: MIT
#include "host/plugins/calls/call_guard.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

#include "host/errors/escaped_text.hpp"
#include "host/plugins/calls/fp_control.hpp"
#include "host/plugins/calls/own_process.hpp"
#include "host/program/monotonic_time.hpp"

namespace dmrp::host {

namespace {

// A call counts as hanging only long after should_stop() has returned true: a slow machine must not cause faults.
constexpr std::int64_t grace_factor = 2;
constexpr std::int64_t grace_ns = 5'000'000'000;

// To start a process takes longer than this: shorter calls are spared system calls.
constexpr std::int64_t shortest_start_ns = 10'000;

template <std::size_t n>
void copy_text(std::array<char, n>& to, std::string_view from) {
  const std::size_t length = std::min(from.size(), n - 1);
  std::memcpy(to.data(), from.data(), length);
  to[length] = '\0';
}

std::string status_detail(const char* status, const std::string& error) {
  return error.empty() ? fmt::format("returned {} without a text", status) : error;
}

std::string disallowed_detail(const char* name, std::int32_t status) {
  return fmt::format("returned {} ({}), which status.h does not allow this function", name, status);
}

// What a status of a later minor version is read as (status.h).
std::int32_t known_status(std::int32_t status) {
  if (status >= 16 && status <= 31) return DMRP_NO_SOLUTION;
  return status >= 32 && status <= 63 ? DMRP_ERROR : status;
}

}  // namespace

std::int64_t CallGuard::longest_ns(std::int64_t budget_ns) {
  return budget_ns * grace_factor + grace_ns;
}

bool CallGuard::should_stop(const dmrp_host* caller) noexcept {
  if (caller_ != caller) return true;
  const std::int64_t asked = ++asks_ - asks_before_;
  const bool over = most_asks_ < 0 ? monotonic_ns() >= deadline_ns_ : asked > most_asks_;
  if (over) stopped_ = true;
  return over;
}

std::int64_t CallGuard::budget_left_ns(const dmrp_host* caller) noexcept {
  if (caller_ != caller) return 0;
  asked_time_ = true;
  return should_stop(caller) ? 0 : std::max<std::int64_t>(0, deadline_ns_ - monotonic_ns());
}

void CallGuard::stop_after_asks(std::int64_t count) {
  most_asks_ = count;
  asks_ = 0;
}

void CallGuard::set_error(const dmrp_host* caller, const char* text) noexcept {
  const std::lock_guard lock(text_mutex_);
  if (caller_ != caller) return;
  try {
    error_ = escaped(text);
  } catch (...) {  // out of memory: the text is lost
  }
}

void CallGuard::refuse(const std::string& text) noexcept {
  const std::lock_guard lock(text_mutex_);
  try {
    if (caller_ && refusal_.empty()) refusal_ = text;
  } catch (...) {  // out of memory: the text is lost
  }
}

void CallGuard::depends_on_timing(const dmrp_host* caller, const std::string& plugin, const char* text) noexcept {
  const std::lock_guard lock(text_mutex_);
  if (caller_ != caller) return;
  try {
    add_timing(plugin, escaped(text));
  } catch (...) {  // out of memory: the reason is lost
  }
}

std::vector<TimingReason> CallGuard::timing() const {
  const std::lock_guard lock(text_mutex_);
  return timing_;
}

void CallGuard::reset_timing() {
  const std::lock_guard lock(text_mutex_);
  timing_.clear();
}

void CallGuard::add_timing(const std::string& plugin, const std::string& text) {
  const bool known =
      std::any_of(timing_.begin(), timing_.end(), [&](const TimingReason& reason) { return reason.plugin == plugin; });
  if (!known) timing_.push_back({plugin, text});
}

std::string CallGuard::error() const {
  const std::lock_guard lock(text_mutex_);
  return error_;
}

void CallGuard::check_no_children() const {
  if (processes_allowed_ || !own_process::has_children()) return;
  const NotedCall last = read_call(note_);
  throw PluginFault(fault_kind::abi_breach, {last.plugin, last.function.c_str(), last.step, last.robot},
                    "after it had returned: a plugin has left a process behind", true);
}

void CallGuard::enter(const dmrp_host* caller, const CallSite& site, std::int64_t budget_ns) {
  {
    const std::lock_guard lock(text_mutex_);
    error_.clear();
  }
  copy_text(note_.plugin, site.plugin);
  copy_text(note_.function, site.function);
  note_.step.store(site.step, std::memory_order_relaxed);
  note_.robot.store(site.robot, std::memory_order_relaxed);
  note_.limit_ns.store(longest_ns(budget_ns), std::memory_order_relaxed);
  control_bits_ = fp_control();
  asks_before_ = asks_;
  start_ns_ = monotonic_ns();
  deadline_ns_ = start_ns_ + budget_ns;
  caller_ = caller;
  note_.start_ns.store(start_ns_, std::memory_order_relaxed);
  note_.call_number.fetch_add(1, std::memory_order_release);
}

CallGuard::Result CallGuard::leave(const CallSite& site, Answers answers, std::int32_t status, bool threw) {
  if (own_process::is_copy()) _exit(0);
  const std::int64_t duration_ns = monotonic_ns() - start_ns_;
  std::string refusal;
  {
    const std::lock_guard lock(text_mutex_);
    caller_ = nullptr;
    refusal.swap(refusal_);
    if (stopped_.exchange(false))
      add_timing(std::string(site.plugin), fmt::format("{}() was stopped by its time budget", site.function));
    if (asked_time_.exchange(false))
      add_timing(std::string(site.plugin), fmt::format("{}() asked how much time it has left", site.function));
  }
  const bool is_long = duration_ns > shortest_start_ns;
  note_.call_number.fetch_add(1);  // before the note of the next call
  if (fp_control() != control_bits_) {
    set_fp_control(control_bits_);
    throw PluginFault(fault_kind::abi_breach, site, "changed the floating-point control bits");
  }
  if (!processes_allowed_ && is_long && own_process::has_children())
    throw PluginFault(fault_kind::abi_breach, site, "left a process behind", true);
  if (threw) throw PluginFault(fault_kind::abi_breach, site, "let a C++ exception out");
  if (!refusal.empty()) throw PluginFault(fault_kind::abi_breach, site, refusal);
  switch (known_status(status)) {
    case DMRP_OK:
    case DMRP_WARNING:
      return {status, duration_ns};
    case DMRP_NO_SOLUTION:
      if (answers == Answers::no_solution || answers == Answers::plan) return {DMRP_NO_SOLUTION, duration_ns};
      throw PluginFault(fault_kind::abi_breach, site, disallowed_detail("DMRP_NO_SOLUTION", status));
    case DMRP_TIMEOUT:
      if (answers == Answers::plan) return {status, duration_ns};
      throw PluginFault(fault_kind::abi_breach, site, disallowed_detail("DMRP_TIMEOUT", status));
    case DMRP_UNSUPPORTED:
      if (answers == Answers::plan || answers == Answers::unsupported)
        throw PluginFault(fault_kind::unsupported, site, status_detail("DMRP_UNSUPPORTED", error()));
      throw PluginFault(fault_kind::abi_breach, site, disallowed_detail("DMRP_UNSUPPORTED", status));
    case DMRP_OUT_OF_MEMORY:
      throw PluginFault(fault_kind::out_of_memory, site, status_detail("DMRP_OUT_OF_MEMORY", error()));
    case DMRP_ERROR:
      throw PluginFault(fault_kind::error_status, site, status_detail("DMRP_ERROR", error()));
    case DMRP_FATAL:
      throw PluginFault(fault_kind::error_status, site, status_detail("DMRP_FATAL", error()), true);
    default:
      throw PluginFault(fault_kind::abi_breach, site, fmt::format("returned the unknown status {}", status));
  }
}

}  // namespace dmrp::host
