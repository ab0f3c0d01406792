// SPDX-License-Identifier: MIT
#include <array>

#include "host/check/case_functions.hpp"
#include "host/check/check_case.hpp"

namespace dmrp::host {

namespace {

constexpr std::array cases = {
    CheckCase{"load/open", for_library, load_cases::open,
              "entry.h: a library exports dmrp_entry_v1 of this draft, whole; init() returns DMRP_OK or DMRP_WARNING",
              "build it with dmrp_add_plugin() against this host's SDK, and link all that it needs"},
    CheckCase{
        "load/exports", for_library, load_cases::exports,
        "entry.h: dmrp_entry_v1 is the only symbol that a library exports; others may be one object with those of "
        "another library",
        "build with -fvisibility=hidden, put classes into an unnamed namespace, or use dmrp_add_plugin()"},
    CheckCase{"load/floating_point", for_library, load_cases::floating_point,
              "abi.h: a plugin does not change the floating-point control bits", "build and link without -ffast-math"},
    CheckCase{"load/process_state", for_library, load_cases::process_state,
              "abi.h: a plugin does not change the locale, working directory, signal handlers, environment or "
              "descriptors that it did not open",
              "leave to the host what belongs to the whole process, or set it back before the function returns"},
    CheckCase{"load/threads", for_library, load_cases::threads, "abi.h: no thread starts in a static initialiser",
              "start threads in create() or start()"},
    CheckCase{"load/prints", for_library, load_cases::prints,
              "host.h: log() writes to the log; standard output belongs to the host's results",
              "write with host->log()"},
    CheckCase{"load/time", for_library, load_cases::time, "entry.h: init() is for what all instances share",
              "load large files when the first instance is created"},
    CheckCase{"load/init_twice", for_library, load_cases::init_twice,
              "entry.h: a host may call init() and deinit() alone first",
              "free in deinit() what init() made, and no more"},

    CheckCase{"descriptor/id", for_all, descriptor_cases::id, "descriptor.h: id is reverse DNS",
              "choose an id that begins with a domain of yours, as org.example.mine"},
    CheckCase{"descriptor/version", for_all, descriptor_cases::version, "descriptor.h: version is semantic",
              "write three numbers, as 1.4.0"},
    CheckCase{"descriptor/license", for_all, descriptor_cases::license, "descriptor.h: license is an SPDX expression",
              "name the licence as spdx.org/licenses does"},
    CheckCase{"descriptor/texts", for_all, descriptor_cases::texts,
              "descriptor.h: name is for display, summary is one line", "say in one line what the plugin does"},
    CheckCase{"descriptor/parameters", for_all, descriptor_cases::parameters,
              "parameter.h: keys are letters, digits and '_'; doc is one line; unit is bare",
              "describe each parameter: users see it in `dmrp-host plugins`"},
    CheckCase{"descriptor/values", for_metrics, descriptor_cases::values,
              "descriptor.h: a value has a unit, a description and a direction",
              "describe each value: reports show it"},
    CheckCase{"descriptor/flags", for_all, descriptor_cases::flags,
              "descriptor.h: flags, values and connectivity belong to kinds of plugin",
              "leave 0 what is not of this kind"},
    CheckCase{"descriptor/extensions", for_all, descriptor_cases::extensions,
              "descriptor.h: requires_ and uses list extensions by id",
              "spell ids as the headers in dmrp/ext do, and require only what this host offers to this kind"},
    CheckCase{"descriptor/static", for_all, descriptor_cases::is_static,
              "descriptor.h: static data, readable before init()", "do not change it at run time"},

    CheckCase{"parameters/defaults", for_all, parameter_cases::defaults,
              "parameter.h: create() gets the complete table, defaults filled in", "take the declared defaults"},
    CheckCase{"parameters/minimum", for_all, parameter_cases::minimum,
              "parameter.h: the host lets through any value from minimum to maximum",
              "raise the minimum to what the plugin can take"},
    CheckCase{"parameters/maximum", for_all, parameter_cases::maximum,
              "parameter.h: the host lets through any value from minimum to maximum",
              "lower the maximum to what the plugin can take"},
    CheckCase{"parameters/drawn", for_all, parameter_cases::drawn,
              "parameter.h: the host lets through any value from minimum to maximum",
              "narrow the range, or take the value"},

    CheckCase{"lifecycle/create_and_destroy", for_all, lifecycle_cases::create_and_destroy,
              "plugin.h: destroy() may follow create() at once; instances come and go",
              "free in destroy() what create() made, and no more"},
    CheckCase{"lifecycle/start_and_destroy", for_all, lifecycle_cases::start_and_destroy,
              "plugin.h: destroy() is allowed after any status but DMRP_FATAL, also amid a trial",
              "do not touch the world or extensions in destroy()"},
    CheckCase{"lifecycle/start_after_start", for_all, lifecycle_cases::start_after_start,
              "plugin.h: start() begins a trial; an earlier one must not influence it",
              "set every member in start() that a trial changes"},
    CheckCase{"lifecycle/interleaved", for_all, lifecycle_cases::interleaved,
              "abi.h: results do not depend on other instances in the process",
              "keep in the instance what now is static or global"},
    CheckCase{"lifecycle/process_state", for_all, lifecycle_cases::process_state,
              "abi.h: a plugin does not change the locale, working directory, signal handlers, environment or "
              "descriptors that it did not open",
              "leave to the host what belongs to the whole process, or set it back before the function returns"},

    CheckCase{"status/ordinary_trial", for_all, status_cases::ordinary_trial,
              "status.h: which statuses a function may return; outputs are valid after DMRP_OK",
              "return DMRP_OK where the task can be done, and no status that the table does not list"},
    CheckCase{"status/no_way", for_planners, status_cases::no_way,
              "global_planner.h: DMRP_NO_SOLUTION where a goal cannot be reached",
              "return DMRP_NO_SOLUTION: it is an answer, not an error"},
    CheckCase{
        "status/no_plan", for_metrics, status_cases::no_plan,
        "metric.h: every declared name gets a value, whatever happened in the trial; plan is NULL if there is none",
        "give NaN for what is undefined without a plan"},
    CheckCase{"status/no_robots", for_people | for_metrics, status_cases::nobody,
              "metric.h: a trial without robots has samples of people alone",
              "give NaN for what is undefined without robots"},

    CheckCase{"determinism/same_seed", for_all, determinism_cases::same_seed,
              "plugin.h: the same seed gives the same results, to the bit",
              "draw from dmrp/toolkit/random.hpp with the seed of start(); read no clock"},
    CheckCase{"determinism/after_another_trial", for_all, determinism_cases::after_another_trial,
              "plugin.h: a trial gives the same results whatever ran before",
              "set every member in start() that a trial changes"},
    CheckCase{"determinism/in_another_place", for_all, determinism_cases::in_another_place,
              "abi.h: results do not depend on addresses",
              "initialise all memory, and order nothing by address or hash"},
    CheckCase{
        "determinism/leaping_clocks", for_all, determinism_cases::leaping_clocks,
        "abi.h: results do not depend on clocks",
        "bound the work by counts, not by time; ask should_stop() for the limit of time; a plugin that cannot says so "
        "with draft/timing.h"},

    CheckCase{"numbers/nobody_near", for_all, number_cases::nobody_near, "observation.h: agents may be none",
              "divide by no count that may be zero"},
    CheckCase{"numbers/crowd", for_controllers | for_people | for_metrics, number_cases::crowd,
              "observation.h, pedestrian_model.h, sample.h: any number of agents and people",
              "have no arrays of fixed size"},
    CheckCase{"numbers/goal_at_start", for_all, number_cases::goal_at_start,
              "path.h: a path may be one waypoint; a robot may stand at its goal",
              "take a path without a segment, and divide by no length that may be zero"},
    CheckCase{"numbers/one_waypoint", for_controllers, number_cases::one_waypoint,
              "local_controller.h: with dispatch = \"waypoint\" the path is a single waypoint",
              "approach a single waypoint like a goal"},
    CheckCase{"numbers/far_away", for_all, number_cases::far_away,
              "values.h: coordinates are metres in the world frame, wherever its corner lies",
              "compute with differences of positions, in doubles"},
    CheckCase{"numbers/headings", for_all, number_cases::headings,
              "path.h, robot.h: theta may be a heading, or NaN for any", "test std::isnan(theta) before it is used"},

    CheckCase{"growth/longer_structs", for_all, growth_cases::longer_structs,
              "abi.h: structs and array elements may be longer than the plugin knows",
              "access array elements with DMRP_AT, and compare no struct_size with =="},
    CheckCase{"growth/longer_host", for_all, growth_cases::longer_host,
              "abi.h: dmrp_host, parameters, sinks and extensions may be longer than the plugin knows",
              "access params->values with DMRP_AT, copy none of these structs, and compare no struct_size with =="},

    CheckCase{"steps/allocations", for_all, step_cases::allocations,
              "local_controller.h: a step does not allocate without bound",
              "forget what is no longer needed: a trial may take hours"},
    CheckCase{"steps/waiting", for_controllers, step_cases::waiting, "local_controller.h: a step does not block",
              "read files in start(), and neither sleep nor wait in a step"},

    CheckCase{
        "should_stop/first_ask", for_all, should_stop_cases::first_ask,
        "host.h: the call should return soon after should_stop() returned 1; status.h: DMRP_TIMEOUT is plan()'s alone",
        "return with what there is, and with a status that status.h allows"},
    CheckCase{
        "should_stop/later_ask", for_all, should_stop_cases::later_ask,
        "host.h: the call should return soon after should_stop() returned 1; status.h: DMRP_TIMEOUT is plan()'s alone",
        "return with what there is, and with a status that status.h allows"},

    CheckCase{"should_stop/often", for_all, should_stop_cases::often,
              "host.h: ask should_stop() at least every millisecond", "ask in the innermost loop that may take long"},

    CheckCase{"threads/moves_between_threads", for_all, thread_cases::moves_between_threads,
              "abi.h: an instance may move between threads from call to call",
              "keep nothing in thread_local variables"},
    CheckCase{"threads/concurrent_instances", for_all, thread_cases::concurrent_instances,
              "abi.h: instances may run concurrently", "share nothing between instances that one of them changes"},

    CheckCase{"memory/leaks", for_all, memory_cases::leaks, "plugin.h: destroy() frees the instance",
              "free in destroy() what the instance allocated (docs/debugging.md finds the place)"},

    CheckCase{"extensions/undeclared", for_all, extension_cases::undeclared,
              "host.h: get_extension() gives NULL for what the descriptor does not declare",
              "list the extension in uses or requires_"},
    CheckCase{"extensions/not_offered", for_all, extension_cases::not_offered,
              "descriptor.h: uses lists extensions that it uses when available",
              "test the pointer for NULL, or list the extension in requires_"},
    CheckCase{"extensions/own_getter", for_all, extension_cases::own_getter,
              "plugin.h: get_extension() is an extension of the plugin by its id, or NULL",
              "return NULL for any other id"},
};

}  // namespace

std::span<const CheckCase> check_cases() {
  return cases;
}

}  // namespace dmrp::host
