// SPDX-License-Identifier: MIT
// check_case.hpp: a case of `dmrp-host check`: one demand of the contract, and the function that tries a plugin on it.
#pragma once

#include <dmrp/descriptor.h>

#include <cstdint>
#include <span>

namespace dmrp::host {

class Examination;

// Kinds of plugin that a case is for, as bits.
inline constexpr std::uint32_t for_library = 0;  // once, not for each plugin
inline constexpr std::uint32_t for_planners = 1u << DMRP_KIND_GLOBAL_PLANNER;
inline constexpr std::uint32_t for_controllers = 1u << DMRP_KIND_LOCAL_CONTROLLER;
inline constexpr std::uint32_t for_people = 1u << DMRP_KIND_PEDESTRIAN_MODEL;
inline constexpr std::uint32_t for_metrics = 1u << DMRP_KIND_METRIC;
inline constexpr std::uint32_t for_all = for_planners | for_controllers | for_people | for_metrics;

struct CheckCase {
  const char* name;  // "lifecycle/start_after_start"
  std::uint32_t kinds;
  void (*run)(Examination&);  // in a guest; nullptr: the whole trial, which the host runs
  const char* rule;           // of the contract, with its header
  const char* mend;           // how a plugin that fails is mended
};

// All cases, in the order in which they run. docs/plugin_check.md lists them.
std::span<const CheckCase> check_cases();

// Those of one source each: load_cases.cpp, ...
std::span<const CheckCase> load_check_cases();
std::span<const CheckCase> descriptor_check_cases();
std::span<const CheckCase> parameter_check_cases();
std::span<const CheckCase> trial_check_cases();
std::span<const CheckCase> plan_check_cases();
std::span<const CheckCase> meaning_check_cases();
std::span<const CheckCase> step_check_cases();
std::span<const CheckCase> call_check_cases();
std::span<const CheckCase> other_check_cases();

}  // namespace dmrp::host
