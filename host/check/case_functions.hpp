// SPDX-License-Identifier: MIT
// case_functions.hpp: the functions of the cases, by group; cases.cpp names and explains them.
#pragma once

#include "host/check/examination.hpp"

namespace dmrp::host {

namespace load_cases {
void open(Examination& it);
void exports(Examination& it);
void floating_point(Examination& it);
void process_state(Examination& it);
void threads(Examination& it);
void prints(Examination& it);
void time(Examination& it);
void init_twice(Examination& it);
}  // namespace load_cases

namespace descriptor_cases {
void id(Examination& it);
void version(Examination& it);
void license(Examination& it);
void texts(Examination& it);
void parameters(Examination& it);
void values(Examination& it);
void flags(Examination& it);
void extensions(Examination& it);
void is_static(Examination& it);
}  // namespace descriptor_cases

namespace parameter_cases {
void defaults(Examination& it);
void minimum(Examination& it);
void maximum(Examination& it);
void drawn(Examination& it);
}  // namespace parameter_cases

namespace lifecycle_cases {
void create_and_destroy(Examination& it);
void start_and_destroy(Examination& it);
void start_after_start(Examination& it);
void interleaved(Examination& it);
void process_state(Examination& it);
}  // namespace lifecycle_cases

namespace status_cases {
void ordinary_trial(Examination& it);
void no_way(Examination& it);
void no_plan(Examination& it);
void nobody(Examination& it);
}  // namespace status_cases

namespace determinism_cases {
void same_seed(Examination& it);
void after_another_trial(Examination& it);
void in_another_place(Examination& it);
void leaping_clocks(Examination& it);
}  // namespace determinism_cases

namespace number_cases {
void nobody_near(Examination& it);
void crowd(Examination& it);
void goal_at_start(Examination& it);
void one_waypoint(Examination& it);
void far_away(Examination& it);
void headings(Examination& it);
}  // namespace number_cases

namespace growth_cases {
void longer_structs(Examination& it);
void longer_host(Examination& it);
}  // namespace growth_cases

namespace step_cases {
void allocations(Examination& it);
void waiting(Examination& it);
}  // namespace step_cases

namespace should_stop_cases {
void first_ask(Examination& it);
void later_ask(Examination& it);
void often(Examination& it);
}  // namespace should_stop_cases

namespace thread_cases {
void moves_between_threads(Examination& it);
void concurrent_instances(Examination& it);
}  // namespace thread_cases

namespace memory_cases {
void leaks(Examination& it);
}

namespace extension_cases {
void undeclared(Examination& it);
void not_offered(Examination& it);
void own_getter(Examination& it);
}  // namespace extension_cases

}  // namespace dmrp::host
