// SPDX-License-Identifier: MIT
// Cases that rehearse trials: lifecycle, status, determinism, numbers, growth, should_stop, threads.
#include <fmt/format.h>

#include <cstring>
#include <ctime>
#include <exception>
#include <latch>
#include <limits>
#include <memory>
#include <thread>
#include <vector>

#include "host/check/case_functions.hpp"
#include "host/check/process_state.hpp"
#include "host/check/rehearsal/rehearsal.hpp"
#include "host/check/symbol_hooks.hpp"
#include "host/process/sanitized.hpp"

namespace dmrp::host {

namespace {

// The first difference of the outputs, to the bit; "" if there is none.
std::string difference(const Outputs& outputs, const Outputs& expected) {
  for (std::size_t i = 0; i < std::min(outputs.size(), expected.size()); ++i)
    if (std::memcmp(&outputs[i], &expected[i], sizeof(double)) != 0)
      return fmt::format("number {} of {} that it gives is {} instead of {}", i + 1, expected.size(), outputs[i],
                         expected[i]);
  if (outputs.size() != expected.size())
    return fmt::format("gives {} numbers instead of {}", outputs.size(), expected.size());
  return "";
}

void expect_same(Examination& it, const Outputs& outputs, const Outputs& expected) {
  if (const auto timing = it.guard().timing(); !timing.empty())
    throw Skipped{"it says that its results depend on timing: " + timing.front().text};
  if (const std::string text = difference(outputs, expected); !text.empty()) it.fail(text);
}

// What a new instance gives.
Outputs alone(Examination& it, std::uint64_t seed) {
  const auto instance = it.create();
  return rehearse(*instance, it.plugin(), {}, seed);
}

void rehearse_on(Examination& it, const StageSettings& settings) {
  const auto instance = it.create();
  rehearse(*instance, it.plugin(), settings, it.seed());
}

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

namespace lifecycle_cases {

void create_and_destroy(Examination& it) {
  for (int i = 0; i < 100; ++i) {
    it.at(fmt::format("instance {}", i + 1));
    const auto instance = it.create();
  }
}

void start_and_destroy(Examination& it) {
  for (const bool after_calls : {false, true}) {
    it.at(after_calls ? "destroy() amid a trial" : "destroy() after start()");
    const auto instance = it.create();
    Rehearsal rehearsal(*instance, it.plugin(), {}, it.seed());
    if (after_calls) rehearsal.advance();
  }
}

void start_after_start(Examination& it) {
  const Outputs expected = alone(it, it.seed());
  const auto instance = it.create();
  Rehearsal first(*instance, it.plugin(), {}, it.seed() + 1);
  Rehearsal cut_short(*instance, it.plugin(), {}, it.seed() + 2);
  cut_short.advance();
  it.at("a third start() in a row");
  expect_same(it, rehearse(*instance, it.plugin(), {}, it.seed()), expected);
}

void interleaved(Examination& it) {
  const Outputs of_first = alone(it, it.seed());
  const Outputs of_second = alone(it, it.seed() + 1);
  const auto first_instance = it.create();
  const auto second_instance = it.create();
  Rehearsal first(*first_instance, it.plugin(), {}, it.seed());
  Rehearsal second(*second_instance, it.plugin(), {}, it.seed() + 1);
  bool first_goes_on = true;
  bool second_goes_on = true;
  while (first_goes_on || second_goes_on) {
    if (first_goes_on) first_goes_on = first.advance();
    if (second_goes_on) second_goes_on = second.advance();
  }
  it.at("two instances in turns");
  expect_same(it, first.outputs(), of_first);
  expect_same(it, second.outputs(), of_second);
}

void process_state(Examination& it) {
  it.init();
  const ProcessState before = ProcessState::now();
  alone(it, it.seed());
  if (const std::string change = ProcessState::now().change_since(before); !change.empty())
    it.fail("changes " + change);
}

}  // namespace lifecycle_cases

namespace status_cases {

void ordinary_trial(Examination& it) {
  const Outputs outputs = alone(it, it.seed());
  if (it.plugin().kind == DMRP_KIND_GLOBAL_PLANNER && (outputs.empty() || outputs.front() > DMRP_WARNING))
    it.fail(fmt::format("plan() returns status {} where three robots cross an open hall side by side",
                        outputs.empty() ? -1.0 : outputs.front()));
}

void no_way(Examination& it) {
  StageSettings settings;
  settings.walled_off = true;
  const auto instance = it.create();
  const Outputs outputs = rehearse(*instance, it.plugin(), settings, it.seed());
  if (outputs.empty() || (outputs.front() != DMRP_NO_SOLUTION && outputs.front() != DMRP_TIMEOUT))
    it.fail(fmt::format("plan() returns status {} where a wall parts all robots from their goals", outputs.front()));
}

void no_plan(Examination& it) {
  StageSettings settings;
  settings.fails_to_plan = true;
  rehearse_on(it, settings);
}

void nobody(Examination& it) {
  StageSettings settings;
  settings.robots = 0;
  rehearse_on(it, settings);
}

}  // namespace status_cases

namespace determinism_cases {

void same_seed(Examination& it) {
  expect_same(it, alone(it, it.seed()), alone(it, it.seed()));
}

void after_another_trial(Examination& it) {
  const Outputs expected = alone(it, it.seed());
  const auto instance = it.create();
  StageSettings other;
  other.robots = 2;
  other.people = 3;
  rehearse(*instance, it.plugin(), other, it.seed() + 7);
  it.at("a trial after another");
  expect_same(it, rehearse(*instance, it.plugin(), {}, it.seed()), expected);
}

// Memory that was in use before lies elsewhere, and is not zero.
void in_another_place(Examination& it) {
  const Outputs expected = alone(it, it.seed());
  std::vector<std::unique_ptr<char[]>> blocks;
  for (std::size_t bytes = 16; bytes < 100'000; bytes += bytes / 4) {
    blocks.emplace_back(new char[bytes]);
    std::memset(blocks.back().get(), 0x5a, bytes);
    if (blocks.size() % 2 == 0) blocks[blocks.size() - 2].reset();
  }
  const auto in_the_place_of_the_first = it.create();
  it.at("in memory that was used before");
  expect_same(it, alone(it, it.seed()), expected);
}

// A search that time ends does less then.
void leaping_clocks(Examination& it) {
  const Outputs expected = alone(it, it.seed());
  it.at(fmt::format("clocks that leap {} ms between two looks", clock_leap_ns / 1'000'000));
  let_clocks_leap();
  expect_same(it, alone(it, it.seed()), expected);
}

}  // namespace determinism_cases

namespace number_cases {

void nobody_near(Examination& it) {
  StageSettings settings;
  settings.people = 0;
  settings.robots = 1;
  rehearse_on(it, settings);
}

void crowd(Examination& it) {
  StageSettings settings;
  settings.people = 1000;
  settings.is_large = true;
  settings.ticks = 2;
  rehearse_on(it, settings);
}

void goal_at_start(Examination& it) {
  StageSettings settings;
  settings.starts_at_goal = true;
  rehearse_on(it, settings);
}

void one_waypoint(Examination& it) {
  StageSettings settings;
  settings.by_waypoint = true;
  rehearse_on(it, settings);
}

void far_away(Examination& it) {
  StageSettings settings;
  settings.corner_m = 1e6;
  rehearse_on(it, settings);
}

void headings(Examination& it) {
  StageSettings settings;
  settings.goals_have_headings = true;
  rehearse_on(it, settings);
}

}  // namespace number_cases

namespace growth_cases {

namespace {

constexpr std::uint32_t grown_bytes = 24;

}  // namespace

void longer_structs(Examination& it) {
  const Outputs expected = alone(it, it.seed());
  StageSettings settings;
  settings.grown_bytes = grown_bytes;
  const auto instance = it.create();
  it.at(fmt::format("with structs and strides that are {} bytes longer", grown_bytes));
  expect_same(it, rehearse(*instance, it.plugin(), settings, it.seed()), expected);
}

void longer_host(Examination& it) {
  const Outputs expected = alone(it, it.seed());
  StageSettings settings;
  settings.grown_extension_bytes = grown_bytes;
  it.at(fmt::format("with a dmrp_host, parameters, sinks and extensions that are {} bytes longer", grown_bytes));
  const auto instance = it.create(it.defaults(), it.guard(), grown_bytes);
  expect_same(it, rehearse(*instance, it.plugin(), settings, it.seed()), expected);
}

}  // namespace growth_cases

namespace should_stop_cases {

namespace {

constexpr std::int64_t most_asks_after = 10'000;  // in one call, once the host has said stop

StageSettings with_much_to_do() {
  StageSettings settings;
  settings.is_large = true;
  settings.robots = 16;
  settings.people = 60;
  settings.ticks = 4;
  return settings;
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

}  // namespace dmrp::host
