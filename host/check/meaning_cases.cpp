// SPDX-License-Identifier: MIT
// Cases about what fields and constants mean: groups, reactions, channels, and values that are rare.
#include "host/check/check_case.hpp"
#include "host/check/examination.hpp"
#include "host/check/rehearsal/rehearsal.hpp"
#include "host/check/symbol_hooks.hpp"
#include "host/process/sanitized.hpp"

namespace dmrp::host::meaning_cases {

namespace {

// Two trials that the contract makes the same.
void expect_same_trials(Examination& it, const StageSettings& one, const StageSettings& other, const char* what) {
  const Outputs expected = rehearse_on(it, one);
  it.at(what);
  expect_same(it, rehearse_on(it, other), expected);
}

}  // namespace

void groups(Examination& it) {
  expect_same_trials(it, {.groups = Groups::one_each}, {.groups = Groups::none},
                     "people of group 0, and then each in a group of its own");
}

void reactions(Examination& it) {
  expect_same_trials(it, {}, {.reaction = 1000}, "people with a reaction that this version does not know");
}

void channels(Examination& it) {
  expect_same_trials(it, {}, {.shows_all = true}, "with channels that its descriptor does not declare");
}

void beyond_limits(Examination& it) {
  rehearse_on(it, {.is_fast = true});
}

void at_one_place(Examination& it) {
  rehearse_on(it, {.at_one_place = true});
}

void pressed(Examination& it) {
  rehearse_on(it, {.people = 24, .is_pressed = true});
}

void later_goals(Examination& it) {
  rehearse_on(it, {.first_goal = 5});
}

void bounds(Examination& it) {
  if (sanitizer_is_loaded()) throw Skipped{"a sanitizer has its own allocator"};
  fence_allocations(it.guard());
  rehearse_on(it, {});
  it.at("with kinds and flags that this version does not know");
  rehearse_on(it, {.unknown_kinds = true});
}

}  // namespace dmrp::host::meaning_cases

namespace dmrp::host {

std::span<const CheckCase> meaning_check_cases() {
  static constexpr CheckCase cases[] = {
      {"people/groups", for_people, meaning_cases::groups, "person.h: group 0 is no group: such people are alone",
       "leave out people of group 0 where groups are gathered"},
      {"people/reactions", for_people, meaning_cases::reactions,
       "person.h: a model treats a reaction that it does not know as UNSPECIFIED",
       "test for the reactions that the model knows, and take its own for all others"},
      {"metrics/channels", for_metrics, meaning_cases::channels,
       "descriptor.h: what a metric does not declare it does not get",
       "declare the channels that the metric reads, and read no others"},
      {"numbers/beyond_limits", for_controllers | for_people | for_metrics, meaning_cases::beyond_limits,
       "observation.h, person.h, sample.h: velocities are actual ones: above the limits, too",
       "take no root of a difference of speeds, and clamp what goes into acos"},
      {"numbers/at_one_place", for_controllers | for_people | for_metrics, meaning_cases::at_one_place,
       "observation.h, person.h: agents may be as near as they can", "divide by no distance between agents"},
      {"numbers/pressed", for_people, meaning_cases::pressed,
       "pedestrian_model.h: a velocity above 5 m/s is a fault, however dense the crowd", "limit the speed of people"},
      {"numbers/later_goals", for_controllers | for_metrics, meaning_cases::later_goals,
       "observation.h, sample.h: goal_index counts goals that were added later, which world.goals does not have",
       "read the goal from the observation, and index no goals of the world"},
      {"memory/bounds", for_all, meaning_cases::bounds,
       "abi.h: constants are open lists, and bits may be added to a value",
       "index no array by a kind, class or flag without a test (docs/debugging.md finds the place)"},
  };
  return cases;
}

}  // namespace dmrp::host
