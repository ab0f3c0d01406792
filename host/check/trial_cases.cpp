// SPDX-License-Identifier: MIT
// Cases that rehearse trials: lifecycle, status, determinism, numbers, growth.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "host/check/check_case.hpp"
#include "host/check/examination.hpp"
#include "host/check/process_state.hpp"
#include "host/check/rehearsal/rehearsal.hpp"
#include "host/check/symbol_hooks.hpp"

namespace dmrp::host {

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

// Each drives another robot, if it is a controller.
void interleaved(Examination& it) {
  constexpr std::uint32_t count = 3;
  std::vector<Outputs> expected;
  std::vector<std::unique_ptr<Instance>> instances;
  std::vector<std::unique_ptr<Rehearsal>> rehearsals;
  for (std::uint32_t i = 0; i < count; ++i)
    expected.push_back(rehearse(*it.create_for(i), it.plugin(), {.driven = i}, it.seed() + i));
  for (std::uint32_t i = 0; i < count; ++i) {
    instances.push_back(it.create_for(i));
    rehearsals.push_back(
        std::make_unique<Rehearsal>(*instances[i], it.plugin(), StageSettings{.driven = i}, it.seed() + i));
  }
  std::vector<bool> goes_on(count, true);
  while (std::find(goes_on.begin(), goes_on.end(), true) != goes_on.end())
    for (std::uint32_t i = 0; i < count; ++i)
      if (goes_on[i]) goes_on[i] = rehearsals[i]->advance();
  it.at("three instances in turns");
  for (std::uint32_t i = 0; i < count; ++i) expect_same(it, rehearsals[i]->outputs(), expected[i]);
}

// What counts trials, or fills up, shows late.
void many_trials(Examination& it) {
  const std::uint32_t trials = most_ticks(64);
  const Outputs expected = alone(it, it.seed());
  const auto instance = it.create();
  for (std::uint32_t i = 0; i < trials; ++i) {
    it.at(fmt::format("trial {}", i + 1));
    rehearse(*instance, it.plugin(), {.ticks = 2}, it.seed() + 1);
  }
  it.at(fmt::format("a trial after {} short ones", trials));
  expect_same(it, rehearse(*instance, it.plugin(), {}, it.seed()), expected);
}

// A first trial fills in what is made when it is needed.
void static_variables(Examination& it) {
  alone(it, it.seed());
  const StaticVariables before(it.library().file());
  const auto instance = it.create();
  Rehearsal rehearsal(*instance, it.plugin(), {}, it.seed() + 1);
  while (rehearsal.advance())
    if (const std::vector<std::uintptr_t> places = before.changed(); !places.empty())
      return it.warn(fmt::format("changes static variables in a trial: {} bytes, the first at {:#x} of the library",
                                 places.size(), places.front()));
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
  const auto instance = it.create();
  const Outputs outputs = rehearse(*instance, it.plugin(), {.walled_off = true}, it.seed());
  if (outputs.empty() || (outputs.front() != DMRP_NO_SOLUTION && outputs.front() != DMRP_TIMEOUT))
    it.fail(fmt::format("plan() returns status {} where a wall parts all robots from their goals", outputs.front()));
}

}  // namespace status_cases

namespace determinism_cases {

void same_seed(Examination& it) {
  expect_same(it, alone(it, it.seed()), alone(it, it.seed()));
}

// The earlier trials have other robots and people, another hall, or a wall behind which nobody walks.
void after_another_trial(Examination& it) {
  const StageSettings earlier[] = {{.robots = 2, .people = 3},
                                   {.robots = 5, .people = 12, .is_large = true},
                                   {.starts_at_goal = true, .walled_off = true}};
  const Outputs expected = alone(it, it.seed());
  for (const StageSettings& settings : earlier) {
    const auto instance = it.create();
    rehearse(*instance, it.plugin(), settings, it.seed() + 7);
    it.at("a trial after another");
    expect_same(it, rehearse(*instance, it.plugin(), {}, it.seed()), expected);
  }
}

// People meet robots at other times: what a model or a metric remembers of somebody shows only then.
void after_other_meetings(Examination& it) {
  constexpr std::uint32_t ticks = 400;
  const bool walks = it.plugin().kind == DMRP_KIND_PEDESTRIAN_MODEL;
  for (std::uint32_t reaction = walks ? DMRP_REACTION_REGULAR : DMRP_REACTION_THREATENING;
       reaction <= DMRP_REACTION_THREATENING; ++reaction) {
    const StageSettings last = {.people = 24, .ticks = ticks, .reaction = reaction};
    const Outputs expected = rehearse_on(it, last);
    const auto instance = it.create();
    rehearse(*instance, it.plugin(),
             {.robots = 5, .people = 24, .quarter_turns = 2, .ticks = ticks, .reaction = reaction}, it.seed());
    it.at("a trial after one with other meetings");
    expect_same(it, rehearse(*instance, it.plugin(), last, it.seed()), expected);
  }
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
  for (const std::uint8_t byte : {0x00, 0x3f, 0xff}) {
    it.at(fmt::format("in memory full of 0x{:02x}", byte));
    fill_new_memory(byte);
    expect_same(it, alone(it, it.seed()), expected);
  }
}

// What is drawn, counted or kept rarely shows late.
void long_trial(Examination& it) {
  constexpr std::uint32_t ticks = 400;
  const StageSettings settings = {.ticks = ticks};
  const Outputs expected = rehearse_on(it, settings);
  it.at(fmt::format("the same trial of {} calls again", ticks));
  expect_same(it, rehearse_on(it, settings), expected);
}

void other_hours(Examination& it) {
  constexpr std::int64_t hour_ns = 3'600'000'000'000;
  const Outputs expected = alone(it, it.seed());
  for (const std::int64_t hours : {6, 12, 18, 24 * 200}) {
    it.at(fmt::format("with clocks {} hours later", hours));
    let_clocks_be_off(hours * hour_ns);
    expect_same(it, alone(it, it.seed()), expected);
  }
}

void other_environment(Examination& it) {
  const Outputs expected = alone(it, it.seed());
  it.at("with other environment variables");
  for (const char* const name : {"HOME", "USER", "LANG", "TMPDIR", "PWD", "OMP_NUM_THREADS"})
    setenv(name, "/home/somebody", 1);
  setenv("TZ", "Asia/Tokyo", 1);
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

namespace numbers_cases {

// More than a plugin commands that leaves it to the host to clip.
void limits(Examination& it) {
  constexpr double odd = 3.0;
  constexpr double wrong = 10.0;
  const Stage stage(it.plugin(), {}, it.seed());
  const dmrp_limits& limits = *stage.variant.view.world().robots[0].limits;
  double most = 0.0;
  const Outputs outputs = alone(it, it.seed());
  for (std::size_t i = 0; i < outputs.size();) {
    const bool drives = outputs[i++] != DMRP_NO_SOLUTION;
    if (!drives) continue;
    most = std::max({most, std::abs(outputs[i]) / limits.v_max, std::abs(outputs[i + 2]) / limits.omega_max});
    i += 3;
  }
  const std::string text = fmt::format("commands {:.0f} times what the robot's limits allow", most);
  if (most > wrong)
    it.fail(text);
  else if (most > odd)
    it.warn(text);
}

void drives(Examination& it) {
  for (const std::uint32_t kinematics :
       {DMRP_KINEMATICS_DIFFERENTIAL, DMRP_KINEMATICS_HOLONOMIC, DMRP_KINEMATICS_ACKERMANN})
    if ((it.plugin().kinematics & (1u << kinematics)) != 0) rehearse_on(it, {.kinematics = kinematics});
}

}  // namespace numbers_cases

namespace growth_cases {

namespace {

constexpr std::uint32_t grown_bytes = 24;

// What lies beyond this host's fields has a meaning for a plugin of a later minor version.
void skip_if_newer(Examination& it) {
  const std::uint32_t minor = it.library().abi_minor();
  if (minor > DMRP_ABI_MINOR)
    throw Skipped{fmt::format("it is of version 1.{}, and this host of 1.{}", minor, DMRP_ABI_MINOR)};
}

}  // namespace

void longer_structs(Examination& it) {
  skip_if_newer(it);
  const Outputs expected = alone(it, it.seed());
  const auto instance = it.create();
  it.at(fmt::format("with structs and strides that are {} bytes longer", grown_bytes));
  expect_same(it, rehearse(*instance, it.plugin(), {.grown_bytes = grown_bytes}, it.seed()), expected);
}

void unknown_constants(Examination& it) {
  skip_if_newer(it);
  const Outputs expected = rehearse_on(it, {.one_fails = true});
  it.at("with states, kinds and flags that this version does not know");
  expect_same(it, rehearse_on(it, {.unknown_kinds = true, .one_fails = true}), expected);
}

void longer_host(Examination& it) {
  skip_if_newer(it);
  const Outputs expected = alone(it, it.seed());
  it.at(fmt::format("with a dmrp_host, parameters, sinks and extensions that are {} bytes longer", grown_bytes));
  const auto instance = it.create(it.defaults(), it.guard(), grown_bytes);
  expect_same(it, rehearse(*instance, it.plugin(), {.grown_extension_bytes = grown_bytes}, it.seed()), expected);
}

}  // namespace growth_cases

std::span<const CheckCase> trial_check_cases() {
  static constexpr CheckCase cases[] = {
      {"lifecycle/create_and_destroy", for_all, lifecycle_cases::create_and_destroy,
       "plugin.h: destroy() may follow create() at once; instances come and go",
       "free in destroy() what create() made, and no more"},
      {"lifecycle/start_and_destroy", for_all, lifecycle_cases::start_and_destroy,
       "plugin.h: destroy() is allowed after any status but DMRP_FATAL, also amid a trial",
       "do not touch the world or extensions in destroy()"},
      {"lifecycle/start_after_start", for_all, lifecycle_cases::start_after_start,
       "plugin.h: start() begins a trial; an earlier one must not influence it",
       "set every member in start() that a trial changes"},
      {"lifecycle/interleaved", for_all, lifecycle_cases::interleaved,
       "abi.h: results do not depend on other instances in the process",
       "keep in the instance what now is static or global"},
      {"lifecycle/many_trials", for_all, lifecycle_cases::many_trials,
       "plugin.h: start() begins a trial; an earlier one must not influence it",
       "keep in the instance what now is static, and set it in start()"},
      {"lifecycle/static_variables", for_all, lifecycle_cases::static_variables,
       "abi.h: results do not depend on earlier trials or other instances in the process",
       "keep in the instance what now is static (nm -C LIBRARY names the place)"},
      {"lifecycle/process_state", for_all, lifecycle_cases::process_state,
       "abi.h: a plugin does not change the locale, working directory, signal handlers, environment or "
       "descriptors that it did not open",
       "leave to the host what belongs to the whole process, or set it back before the function returns"},
      {"status/ordinary_trial", for_all, status_cases::ordinary_trial,
       "status.h: which statuses a function may return; outputs are valid after DMRP_OK",
       "return DMRP_OK where the task can be done, and no status that the table does not list"},
      {"status/no_way", for_planners, status_cases::no_way,
       "global_planner.h: DMRP_NO_SOLUTION where a goal cannot be reached",
       "return DMRP_NO_SOLUTION: it is an answer, not an error"},
      {"status/no_plan", for_metrics, [](Examination& it) { rehearse_on(it, {.fails_to_plan = true}); },
       "metric.h: every declared name gets a value, whatever happened in the trial; plan is NULL if there is none",
       "give NaN for what is undefined without a plan"},
      {"status/no_robots", for_people | for_metrics, [](Examination& it) { rehearse_on(it, {.robots = 0}); },
       "metric.h: a trial without robots has samples of people alone", "give NaN for what is undefined without robots"},
      {"determinism/same_seed", for_all, determinism_cases::same_seed,
       "plugin.h: the same seed gives the same results, to the bit",
       "draw from dmrp/toolkit/random.hpp with the seed of start(); read no clock"},
      {"determinism/after_another_trial", for_all, determinism_cases::after_another_trial,
       "plugin.h: a trial gives the same results whatever ran before",
       "set every member in start() that a trial changes"},
      {"determinism/after_other_meetings", for_people | for_metrics, determinism_cases::after_other_meetings,
       "plugin.h: a trial gives the same results whatever ran before",
       "forget in start() whom the model or metric has met: ids come again"},
      {"determinism/in_another_place", for_all, determinism_cases::in_another_place,
       "abi.h: results do not depend on addresses", "initialise all memory, and order nothing by address or hash"},
      {"determinism/leaping_clocks", for_all, determinism_cases::leaping_clocks,
       "abi.h: results do not depend on clocks",
       "bound the work by counts, not by time; ask should_stop() for the limit of time; a plugin that cannot says so "
       "with ext/timing.h"},
      {"determinism/long_trial", for_controllers | for_people, determinism_cases::long_trial,
       "plugin.h: the same seed gives the same results, to the bit",
       "draw from dmrp/toolkit/random.hpp with the seed of start(); keep nothing in thread_local or static variables"},
      {"determinism/other_hours", for_all, determinism_cases::other_hours, "abi.h: results do not depend on clocks",
       "read no clock"},
      {"determinism/other_environment", for_all, determinism_cases::other_environment,
       "abi.h: results depend on the arguments, the parameters and the seed of start() alone",
       "declare a parameter for what the environment now says"},
      {"numbers/limits", for_controllers, numbers_cases::limits,
       "local_controller.h: commands are in m/s and rad/s; the host clips them to the robot's limits",
       "compute angles in radians, and clamp the command to observation.limits"},
      {"numbers/nobody_near", for_all,
       [](Examination& it) {
         rehearse_on(it, {.robots = 1, .people = 0});
         it.at("with one agent");
         rehearse_on(it, {.robots = 1, .people = 1});
       },
       "observation.h: agents may be none", "divide by no count that may be zero"},
      {"numbers/crowd", for_controllers | for_people | for_metrics,
       [](Examination& it) { rehearse_on(it, {.people = 1000, .is_large = true, .ticks = 2}); },
       "observation.h, pedestrian_model.h, sample.h: any number of agents and people", "have no arrays of fixed size"},
      {"numbers/touching", for_controllers | for_people | for_metrics,
       [](Examination& it) { rehearse_on(it, {.touching = true}); },
       "observation.h, person.h: agents may be as near as they can", "divide by no distance between bodies"},
      {"numbers/goal_at_start", for_all, [](Examination& it) { rehearse_on(it, {.starts_at_goal = true}); },
       "path.h: a path may be one waypoint; a robot may stand at its goal",
       "take a path without a segment, and divide by no length that may be zero"},
      {"numbers/one_waypoint", for_controllers, [](Examination& it) { rehearse_on(it, {.by_waypoint = true}); },
       "local_controller.h: with dispatch = \"waypoint\" the path is a single waypoint",
       "approach a single waypoint like a goal"},
      {"numbers/far_away", for_all, [](Examination& it) { rehearse_on(it, {.corner_m = 1e6}); },
       "values.h: coordinates are metres in the world frame, wherever its corner lies",
       "compute with differences of positions, in doubles"},
      {"numbers/drives", for_controllers, numbers_cases::drives,
       "descriptor.h: a controller drives robots of every kinematics that it declares",
       "declare the kinematics that it drives, and no others"},
      {"numbers/headings", for_all, [](Examination& it) { rehearse_on(it, {.goals_have_headings = true}); },
       "path.h, robot.h: theta may be a heading, or NaN for any", "test std::isnan(theta) before it is used"},
      {"growth/longer_structs", for_all, growth_cases::longer_structs,
       "abi.h: structs and array elements may be longer than the plugin knows",
       "access array elements with DMRP_AT, and compare no struct_size with =="},
      {"growth/unknown_constants", for_planners | for_controllers | for_metrics, growth_cases::unknown_constants,
       "abi.h: constants are open lists: readers skip what they do not know",
       "test for the kinds and flags that you know, and leave out the others"},
      {"growth/longer_host", for_all, growth_cases::longer_host,
       "abi.h: dmrp_host, parameters, sinks and extensions may be longer than the plugin knows",
       "access params->values with DMRP_AT, copy none of these structs, and compare no struct_size with =="},
  };
  return cases;
}

}  // namespace dmrp::host
