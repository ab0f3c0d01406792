// SPDX-License-Identifier: MIT
// The call guard: statuses that pass, faults, and the call note for the watchdog.
#include <catch2/catch.hpp>
#include <cfenv>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "host/plans/planning.hpp"
#include "host/plugins/calls/call_guard.hpp"
#include "host/program/monotonic_time.hpp"

namespace calls_test {

using namespace dmrp::host;

constexpr std::int64_t second_ns = 1'000'000'000;

struct Guarded {
  CallNote note{};
  CallGuard guard{note};
  const dmrp_host host{};  // whose call it is: only its address counts

  template <class Function>
  CallGuard::Result call(const CallSite& site, std::int64_t budget_ns, Answers answers, Function&& function) {
    return guard.call(&host, site, budget_ns, answers, function);
  }

  // The fault that a call of `function` becomes.
  template <class Function>
  PluginFault fault(Function&& function) {
    try {
      call({"test.plugin", "step", 7, 3}, second_ns, Answers::no_other, function);
    } catch (const PluginFault& fault) {
      return fault;
    }
    throw std::runtime_error("no fault");
  }
};

TEST_CASE("statuses that leave the plugin usable come back with the time that the call took") {
  Guarded guarded;
  for (const std::int32_t status : {DMRP_OK, DMRP_WARNING, DMRP_NO_SOLUTION, DMRP_TIMEOUT}) {
    const auto result = guarded.call({"test.plugin", "plan", 0, -1}, second_ns, Answers::plan, [&] { return status; });
    CHECK(result.status == status);
    CHECK(result.duration_ns >= 0);
  }
}

TEST_CASE("statuses of later minor versions are read as NO_SOLUTION and ERROR") {
  Guarded guarded;
  for (const std::int32_t status : {16, 31})
    for (const Answers answers : {Answers::no_solution, Answers::plan})
      CHECK(guarded.call({"test.plugin", "plan", 0, -1}, second_ns, answers, [&] { return status; }).status ==
            DMRP_NO_SOLUTION);
  for (const std::int32_t status : {32, 63})
    CHECK(guarded.fault([&] { return status; }).kind() == std::string(fault_kind::error_status));
  for (const std::int32_t status : {8, 15, 16, 31, 64, -1})
    CHECK(guarded.fault([&] { return status; }).kind() == std::string(fault_kind::abi_breach));
}

TEST_CASE("a plugin that asks how much time it has left gets it, and its results depend on timing") {
  Guarded guarded;
  const CallSite site = {"test.plugin", "plan", 0, -1};
  CHECK(guarded.guard.budget_left_ns(&guarded.host) == 0);  // outside a call
  std::int64_t left_ns = -1;
  const auto ask = [&] { return left_ns = guarded.guard.budget_left_ns(&guarded.host), DMRP_OK; };
  guarded.call(site, 0, Answers::plan, ask);
  CHECK(left_ns == 0);
  guarded.guard.reset_timing();
  guarded.call(site, 3600 * second_ns, Answers::plan, ask);
  CHECK(left_ns > 0);
  CHECK(left_ns <= 3600 * second_ns);
  CHECK(guarded.guard.timing() == std::vector<TimingReason>{{"test.plugin", "plan() asked how much time it has left"}});
}

TEST_CASE("statuses that end a trial are faults with the plugin's own words") {
  Guarded guarded;
  const auto says = [&](std::int32_t status) {
    return guarded.fault(
        [&guarded, status] { return guarded.guard.set_error(&guarded.host, "the tank is empty"), status; });
  };
  const PluginFault error = says(DMRP_ERROR);
  CHECK(error.kind() == std::string(fault_kind::error_status));
  CHECK(error.what() == std::string("the tank is empty"));
  CHECK(error.plugin() == "test.plugin");
  CHECK(error.function() == std::string("step"));
  CHECK(error.step() == 7);
  CHECK(error.robot() == 3);
  CHECK_FALSE(error.fatal());

  CHECK(says(DMRP_OUT_OF_MEMORY).kind() == std::string(fault_kind::out_of_memory));
  CHECK(says(DMRP_FATAL).kind() == std::string(fault_kind::error_status));
  CHECK(says(DMRP_FATAL).fatal());
  CHECK(says(7).kind() == std::string(fault_kind::abi_breach));
  CHECK(says(-1).kind() == std::string(fault_kind::abi_breach));

  // the text of an earlier call does not count
  CHECK(guarded.fault([] { return DMRP_ERROR; }).what() == std::string("returned DMRP_ERROR without a text"));
}

TEST_CASE("an exception ends at the guard") {
  Guarded guarded;
  const auto fault = guarded.fault([]() -> std::int32_t { throw 42; });
  CHECK(fault.kind() == std::string(fault_kind::abi_breach));
  CHECK(guarded.note.call_number.load() % 2 == 0);
}

TEST_CASE("changed floating-point control bits are a fault, and are put back") {
  Guarded guarded;
  const auto fault = guarded.fault([] { return std::fesetround(FE_UPWARD), DMRP_OK; });
  CHECK(fault.kind() == std::string(fault_kind::abi_breach));
  CHECK(std::fegetround() == FE_TONEAREST);

  // exception flags, which arithmetic raises, are no fault
  CHECK_NOTHROW(guarded.call({"test.plugin", "step", 0, 0}, second_ns, Answers::no_other,
                             [] { return std::feraiseexcept(FE_DIVBYZERO | FE_INEXACT), DMRP_OK; }));
}

TEST_CASE("should_stop says yes when the budget is used up, which makes results depend on timing") {
  Guarded guarded;
  const CallSite site = {"test.plugin", "plan", 0, -1};
  bool says = true;
  guarded.call(site, 3600 * second_ns, Answers::no_other,
               [&] { return says = guarded.guard.should_stop(&guarded.host), DMRP_OK; });
  CHECK_FALSE(says);
  CHECK(guarded.guard.timing().empty());

  guarded.call(site, 0, Answers::no_other, [&] { return says = guarded.guard.should_stop(&guarded.host), DMRP_OK; });
  CHECK(says);
  guarded.call(site, 3600 * second_ns, Answers::no_other,
               [&] { return says = guarded.guard.should_stop(&guarded.host), DMRP_OK; });
  CHECK_FALSE(says);
  CHECK(guarded.guard.timing() == std::vector<TimingReason>{{"test.plugin", "plan() was stopped by its time budget"}});
  guarded.guard.reset_timing();
  CHECK(guarded.guard.timing().empty());
}

TEST_CASE("a plugin says why its results depend on timing, once and in its own calls") {
  Guarded guarded;
  const auto says = [&](const char* plugin, const char* text) {
    guarded.call({plugin, "start", 0, -1}, second_ns, Answers::no_other,
                 [&] { return guarded.guard.depends_on_timing(&guarded.host, plugin, text), DMRP_OK; });
  };
  says("test.one", "draws in\na thread");
  says("test.one", "reads a clock");
  says("test.two", "reads a clock");
  guarded.guard.depends_on_timing(&guarded.host, "test.three", "outside of a call");
  const dmrp_host other{};
  guarded.call({"test.one", "start", 0, -1}, second_ns, Answers::no_other,
               [&] { return guarded.guard.depends_on_timing(&other, "test.four", "in the call of another"), DMRP_OK; });
  CHECK(guarded.guard.timing() ==
        std::vector<TimingReason>{{"test.one", "draws in\\na thread"}, {"test.two", "reads a clock"}});
}

TEST_CASE("the note says who is being called") {
  Guarded guarded;
  const std::string long_id(300, 'x');
  guarded.call({long_id, "step", 12, 5}, second_ns, Answers::no_other, [&] {
    const CallNote& note = guarded.note;
    CHECK(note.call_number.load() % 2 == 1);
    CHECK(std::string(note.plugin.data()) == std::string(note.plugin.size() - 1, 'x'));
    CHECK(std::string(note.function.data()) == "step");
    CHECK(note.step.load() == 12);
    CHECK(note.robot.load() == 5);
    CHECK(note.start_ns.load() <= monotonic_ns());
    CHECK(note.limit_ns.load() > second_ns);  // should_stop() returns true before that
    return DMRP_OK;
  });
  CHECK(guarded.note.call_number.load() == 2);
}

TEST_CASE("the path to drive ends where the goal is, not at its cell") {
  const double any = std::numeric_limits<double>::quiet_NaN();
  const std::vector<dmrp_waypoint> planned = {{0.5, 0.5, any, 0, 0, 0}, {1.5, 0.5, any, 1800, 0, 0}};
  std::vector<dmrp_goal> goals(1);

  SECTION("a goal on the cell's centre only gives the last waypoint its heading") {
    goals[0].pose = {1.5, 0.5, 1.0};
    const auto path = path_to_drive(planned, false, goals, 1800);
    REQUIRE(path.size() == 2);
    CHECK(path[1].theta == 1.0);
    CHECK(std::isnan(path[0].theta));
    CHECK(path[1].t_ns == 1800);
  }
  SECTION("a goal beside it is one leg more") {
    goals[0].pose = {1.7, 0.4, any};
    const auto path = path_to_drive(planned, false, goals, 1800);
    REQUIRE(path.size() == 3);
    CHECK(std::memcmp(path.data(), planned.data(), 2 * sizeof(dmrp_waypoint)) == 0);
    CHECK(path[2].x == 1.7);
    CHECK(path[2].y == 0.4);
    CHECK(path[2].t_ns == 3600);
    CHECK(path[2].goal_index == 0);
  }
  SECTION("a partial path does not lead there yet") {
    goals[0].pose = {1.7, 0.4, 1.0};
    const auto path = path_to_drive(planned, true, goals, 1800);
    REQUIRE(path.size() == 2);
    CHECK(std::memcmp(path.data(), planned.data(), 2 * sizeof(dmrp_waypoint)) == 0);
  }
  SECTION("on a tour it is two: there, and back to where the plan goes on") {
    goals.resize(2);
    goals[0].pose = {1.7, 0.4, 1.0};
    goals[1].pose = {2.5, 0.5, 2.0};
    const std::vector<dmrp_waypoint> tour = {
        {0.5, 0.5, any, 0, 0, 0}, {1.5, 0.5, any, 1800, 0, 0}, {2.5, 0.5, any, 3600, 1, 0}};
    const auto path = path_to_drive(tour, false, goals, 1800);
    REQUIRE(path.size() == 5);
    CHECK(path[2].x == 1.7);
    CHECK(path[2].y == 0.4);
    CHECK(path[2].theta == 1.0);
    CHECK(path[2].t_ns == 3600);
    CHECK(path[2].goal_index == 0);  // the path to the first goal ends there
    CHECK(path[3].x == 1.5);
    CHECK(path[3].y == 0.5);
    CHECK(path[3].t_ns == 5400);
    CHECK(path[3].goal_index == 1);
    CHECK(path[4].x == 2.5);
    CHECK(path[4].theta == 2.0);
    CHECK(path[4].t_ns == 7200);
    CHECK(path[4].goal_index == 1);
  }
}

}  // namespace calls_test
