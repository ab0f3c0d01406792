// SPDX-License-Identifier: MIT
// Cases about calls: should_stop, threads.
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <exception>
#include <latch>
#include <limits>
#include <memory>
#include <thread>
#include <vector>

#include "host/check/check_case.hpp"
#include "host/check/examination.hpp"
#include "host/check/rehearsal/rehearsal.hpp"
#include "host/process/sanitized.hpp"

namespace dmrp::host {

namespace should_stop_cases {

namespace {

constexpr std::int64_t most_asks_after = 10'000;  // in one call, once the host has said stop

StageSettings with_much_to_do() {
  return {.robots = 16, .people = 60, .is_large = true, .ticks = 4};
}

// The most that calls at one time ask.
std::int64_t most_asks(Examination& it, const StageSettings& settings) {
  const auto instance = it.create();
  std::int64_t most = 0;
  Rehearsal rehearsal(*instance, it.plugin(), settings, it.seed());
  for (bool goes_on = true; goes_on;) {
    const std::int64_t before = it.guard().asks();
    goes_on = rehearsal.advance();
    most = std::max(most, it.guard().asks() - before);
  }
  return most;
}

std::int64_t cpu_ns_of_this_thread() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

// A trial in which should_stop() says stop from an ask on, in each call.
void stop_at(Examination& it, std::int64_t ask) {
  it.guard().stop_after_asks(ask);
  it.at(ask == 0 ? "stopped at the first ask" : fmt::format("stopped after {} asks", ask));
  std::int64_t most = most_asks(it, {});
  if (most == 0) most = most_asks(it, with_much_to_do());
  if (most == 0) throw Skipped{"it does not ask should_stop(), neither here nor with 16 robots in a hall of 60 x 50 m"};
  if (most > ask + most_asks_after)
    it.fail(fmt::format("asks should_stop() {} times in a call after it was told to stop", most - ask));
}

}  // namespace

void first_ask(Examination& it) {
  stop_at(it, 0);
}

void later_ask(Examination& it) {
  stop_at(it, 5);
}

// A call that takes so long at an ordinary place needs the ask.
void asks(Examination& it) {
  constexpr std::int64_t most_ns = 20'000'000;
  constexpr int calls = 9;
  if (sanitizer_is_loaded()) throw Skipped{"a sanitizer changes how long it computes"};
  it.guard().stop_after_asks(std::numeric_limits<std::int64_t>::max());  // counts them
  const auto instance = it.create();
  Rehearsal rehearsal(*instance, it.plugin(), {}, it.seed());
  std::vector<std::int64_t> taken_ns;
  for (int call = 0; call < calls; ++call) {
    const std::int64_t before_ns = cpu_ns_of_this_thread();
    if (!rehearsal.advance()) break;
    taken_ns.push_back(cpu_ns_of_this_thread() - before_ns);
  }
  if (taken_ns.empty() || it.guard().asks() > 0) return;
  std::nth_element(taken_ns.begin(), taken_ns.begin() + taken_ns.size() / 2, taken_ns.end());
  if (const std::int64_t median_ns = taken_ns[taken_ns.size() / 2]; median_ns > most_ns)
    it.fail(fmt::format("computes for {} ms in a call, and never asks should_stop()", median_ns / 1'000'000));
}

// Finds plugins that ask rarely or never, not those that ask a little late: time of the processor, which other programs hardly change,
// and two hundred times what the contract allows, since machines differ.
void often(Examination& it) {
  constexpr std::int64_t most_ns = 200'000'000;
  if (sanitizer_is_loaded()) throw Skipped{"a sanitizer changes how long it computes"};
  it.guard().stop_after_asks(std::numeric_limits<std::int64_t>::max());  // counts them
  const auto instance = it.create();
  Rehearsal rehearsal(*instance, it.plugin(), with_much_to_do(), it.seed());
  std::int64_t longest_ns = 0;
  for (bool goes_on = true; goes_on;) {
    const std::int64_t asks_before = it.guard().asks();
    const std::int64_t before_ns = cpu_ns_of_this_thread();
    goes_on = rehearsal.advance();
    const std::int64_t asks = it.guard().asks() - asks_before;
    longest_ns = std::max(longest_ns, (cpu_ns_of_this_thread() - before_ns) / (asks + 1));
  }
  if (longest_ns > most_ns)
    it.warn(fmt::format("computes for {} ms on average between two asks, with 16 robots in a hall of 60 x 50 m",
                        longest_ns / 1'000'000));
}

}  // namespace should_stop_cases

namespace thread_cases {

namespace {

// Runs `function` on a thread of its own, and throws what it throws.
void on_a_thread(const std::function<void()>& function) {
  std::exception_ptr thrown;
  std::thread thread([&] {
    try {
      function();
    } catch (...) {
      thrown = std::current_exception();
    }
  });
  thread.join();
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace

void moves_between_threads(Examination& it) {
  const Outputs expected = alone(it, it.seed());
  const auto instance = it.create();
  std::unique_ptr<Rehearsal> rehearsal;
  it.at("each call on another thread");
  on_a_thread([&] { rehearsal = std::make_unique<Rehearsal>(*instance, it.plugin(), StageSettings(), it.seed()); });
  bool goes_on = true;
  while (goes_on) on_a_thread([&] { goes_on = rehearsal->advance(); });
  expect_same(it, rehearsal->outputs(), expected);
}

void concurrent_instances(Examination& it) {
  const Outputs of_first = alone(it, it.seed());
  const Outputs of_second = alone(it, it.seed() + 1);
  const auto note = std::make_unique<CallNote>();
  CallGuard second_guard(*note);
  const auto first = it.create();
  const auto second = it.create(it.defaults(), second_guard);
  Outputs second_outputs;
  std::exception_ptr thrown;
  it.at("two instances at the same time");
  std::latch both_run(2);
  std::thread thread([&] {
    both_run.arrive_and_wait();
    try {
      second_outputs = rehearse(*second, it.plugin(), {}, it.seed() + 1);
    } catch (...) {
      thrown = std::current_exception();
    }
  });
  both_run.arrive_and_wait();
  Outputs first_outputs;
  try {
    first_outputs = rehearse(*first, it.plugin(), {}, it.seed());
  } catch (...) {
    thread.join();
    throw;
  }
  thread.join();
  if (thrown) std::rethrow_exception(thrown);
  expect_same(it, first_outputs, of_first);
  expect_same(it, second_outputs, of_second);
}

}  // namespace thread_cases

std::span<const CheckCase> call_check_cases() {
  static constexpr CheckCase cases[] = {
      {"should_stop/asks", for_controllers | for_people, should_stop_cases::asks,
       "host.h: ask should_stop() at least every millisecond", "ask in the innermost loop that can take long"},
      {"should_stop/first_ask", for_all, should_stop_cases::first_ask,
       "host.h: the call should return soon after should_stop() returned 1; status.h: DMRP_TIMEOUT is plan()'s alone",
       "return with what there is, and with a status that status.h allows"},
      {"should_stop/later_ask", for_all, should_stop_cases::later_ask,
       "host.h: the call should return soon after should_stop() returned 1; status.h: DMRP_TIMEOUT is plan()'s alone",
       "return with what there is, and with a status that status.h allows"},
      {"should_stop/often", for_all, should_stop_cases::often, "host.h: ask should_stop() at least every millisecond",
       "ask in the innermost loop that may take long"},
      {"threads/moves_between_threads", for_all, thread_cases::moves_between_threads,
       "abi.h: an instance may move between threads from call to call", "keep nothing in thread_local variables"},
      {"threads/concurrent_instances", for_all, thread_cases::concurrent_instances,
       "abi.h: instances may run concurrently", "share nothing between instances that one of them changes"},
  };
  return cases;
}

}  // namespace dmrp::host
