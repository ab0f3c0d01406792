// SPDX-License-Identifier: MIT
// Cases about single calls: what they allocate, and whether they wait.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

#include "host/check/check_case.hpp"
#include "host/check/examination.hpp"
#include "host/check/process_state.hpp"
#include "host/check/rehearsal/rehearsal.hpp"
#include "host/check/symbol_hooks.hpp"
#include "host/process/sanitized.hpp"

namespace dmrp::host::step_cases {

namespace {

constexpr std::uint32_t ticks = 60;
constexpr std::uint32_t first_ticks = 20;            // in which buffers get their size
constexpr std::int64_t most_kept_bytes_each = 4096;  // by a call after them, if that goes on and on

const char* step_of(const PluginInfo& info) {
  switch (info.kind) {
    case DMRP_KIND_GLOBAL_PLANNER:
      return "plan()";
    case DMRP_KIND_METRIC:
      return "observe()";
    default:
      return info.has_flag(DMRP_FLAG_CENTRAL) ? "step_all()" : "step()";
  }
}

// Of each call of a trial, or of what calls at one time.
std::vector<Allocations> allocations_of_calls(Examination& it) {
  StageSettings settings;
  settings.ticks = ticks;
  const auto instance = it.create();
  count_allocations(it.guard());
  Rehearsal rehearsal(*instance, it.plugin(), settings, it.seed());
  std::vector<Allocations> calls;
  for (Allocations before = host::allocations(); rehearsal.advance();) {
    const Allocations now = host::allocations();
    calls.push_back({now.count - before.count, now.bytes - before.bytes, now.kept_bytes});
    before = now;
  }
  return calls;
}

template <class Value>
Value median(std::vector<Value> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::int64_t waits_of_this_thread() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_nvcsw;
}

// Some kernels in containers do not.
bool kernel_counts_waits() {
  const std::int64_t before = waits_of_this_thread();
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return waits_of_this_thread() > before;
}

}  // namespace

void allocations(Examination& it) {
  if (sanitizer_is_loaded()) throw Skipped{"a sanitizer has its own allocator"};
  const std::vector<Allocations> calls = allocations_of_calls(it);
  if (calls.empty()) return;
  std::vector<std::int64_t> counts;
  std::vector<std::int64_t> bytes;
  const std::size_t first = calls.size() > first_ticks ? first_ticks : 0;
  for (std::size_t i = first; i < calls.size(); ++i) {
    counts.push_back(calls[i].count);
    bytes.push_back(calls[i].bytes);
  }
  it.note(fmt::format("{} allocates {} bytes in {} blocks (medians; at most {} blocks)", step_of(it.plugin()),
                      median(bytes), median(counts), *std::max_element(counts.begin(), counts.end())));
  if (it.plugin().kind != DMRP_KIND_LOCAL_CONTROLLER || calls.size() < ticks) return;
  const std::int64_t in_first_half = calls[(first + ticks) / 2].kept_bytes - calls[first].kept_bytes;
  const std::int64_t in_second_half = calls[ticks - 1].kept_bytes - calls[(first + ticks) / 2].kept_bytes;
  const std::int64_t each = std::min(in_first_half, in_second_half) / ((ticks - first_ticks) / 2);
  if (each > most_kept_bytes_each) it.warn(fmt::format("step() keeps about {} bytes more after each call", each));
}

void waiting(Examination& it) {
  if (!kernel_counts_waits()) throw Skipped{"this kernel does not count how often a thread waits"};
  const auto instance = it.create();
  Rehearsal rehearsal(*instance, it.plugin(), {}, it.seed());
  std::size_t calls = 0;
  std::size_t waited = 0;
  for (std::int64_t before = waits_of_this_thread(); rehearsal.advance(); before = waits_of_this_thread()) {
    ++calls;
    waited += waits_of_this_thread() > before;
  }
  if (thread_count() > 1) throw Skipped{"it has threads, for which a call may wait"};
  if (waited * 2 > calls)
    it.warn(fmt::format("waits in {} of {} calls: sleeps, or waits for a lock or a file", waited, calls));
}

}  // namespace dmrp::host::step_cases

namespace dmrp::host {

std::span<const CheckCase> step_check_cases() {
  static constexpr CheckCase cases[] = {
      {"steps/allocations", for_all, step_cases::allocations,
       "local_controller.h: a step does not allocate without bound",
       "forget what is no longer needed: a trial may take hours"},
      {"steps/waiting", for_controllers, step_cases::waiting, "local_controller.h: a step does not block",
       "read files in start(), and neither sleep nor wait in a step"},
  };
  return cases;
}

}  // namespace dmrp::host
