// SPDX-License-Identifier: MIT
#include "host/check/check_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <stdexcept>
#include <vector>

#include "host/check/rehearsal/stage.hpp"
#include "host/check/whole_trial.hpp"
#include "host/errors/input_error.hpp"
#include "host/errors/machine_error.hpp"
#include "host/guests/probe.hpp"
#include "host/plugins/library.hpp"
#include "host/plugins/python_file.hpp"
#include "host/process/box.hpp"

namespace dmrp::host {

namespace {

constexpr std::int64_t trial_time_ns = 300'000'000;  // of the processor, for a usual trial
constexpr std::size_t most_hangs = 2;  // of a plugin; then its other cases are skipped: each would take its whole time

std::regex pattern_of(const std::string& only) {
  try {
    return std::regex(only);
  } catch (const std::regex_error&) {
    throw InputError(fmt::format("--only {}: is not a regular expression", only));
  }
}

class Check {
 public:
  Check(const CheckChoice& choice, const std::function<void(const CheckedCase&)>& report)
      : choice_(choice), report_(report), only_(pattern_of(choice.only)), is_python_(is_python_file(choice.file)) {}

  CheckCounts run() {
    // the whole library in another process first: what cannot be loaded has no plugins to be checked
    std::vector<PluginInfo> plugins;
    std::string unusable;
    try {
      Probe probe = probe_library(choice_.file);
      plugins = std::move(probe.plugins);
      unusable = probe.init_error;
    } catch (const MachineError&) {
      throw;
    } catch (const std::runtime_error& error) {
      unusable = error.what();
    }
    if (!unusable.empty()) {  // the one finding about a library that cannot be used
      add({nullptr, &check_cases().front(), {CheckResult::fail, unusable}});
      return counts_;
    }
    if (!is_python_) run_cases(nullptr);
    for (const PluginInfo& plugin : plugins) run_cases(&plugin);
    if (chosen_ == 0)
      throw InputError(fmt::format("--only {}: no case of {} matches", choice_.only, choice_.file.string()));
    return counts_;
  }

 private:
  bool is_chosen(const CheckCase& check_case, const PluginInfo* plugin) const {
    if (is_python_ && check_case.run) return false;
    const bool applies = plugin ? (check_case.kinds & (1u << plugin->kind)) != 0 : check_case.kinds == for_library;
    return applies && std::regex_search((plugin ? plugin->id : "library") + " " + check_case.name, only_);
  }

  void run_cases(const PluginInfo* plugin) {
    std::size_t hangs = 0;
    std::uint32_t ticks = usual_ticks;
    for (const CheckCase& check_case : check_cases()) {
      if (!is_chosen(check_case, plugin)) continue;
      ++chosen_;
      CheckedCase checked = {plugin, &check_case, {}};
      if (plugin && plugin->has_flag(DMRP_FLAG_PROCESSES) && box::kind() == "calls")
        checked.outcome = {CheckResult::skip, "the plugin starts processes, which need namespaces: see --no-box"};
      else if (hangs >= most_hangs)
        checked.outcome = {CheckResult::skip, "other cases hung"};
      else if (!check_case.run)
        checked.outcome = run_whole_trial(choice_.file, *plugin, choice_.seed);
      else
        checked.outcome = run_case(check_case, choice_.file, plugin, choice_.seed, ticks);
      hangs += checked.outcome.hung;
      if (checked.outcome.call_ns > trial_time_ns / usual_ticks) {
        ticks = static_cast<std::uint32_t>(std::max<std::int64_t>(1, trial_time_ns / checked.outcome.call_ns));
        checked.outcome.detail = fmt::format("a call takes {} ms: trials have {} calls in place of {}",
                                             checked.outcome.call_ns / 1'000'000, ticks, usual_ticks);
      }
      add(checked);
    }
  }

  void add(const CheckedCase& checked) {
    ++counts_[static_cast<std::size_t>(checked.outcome.result)];
    report_(checked);
  }

  const CheckChoice& choice_;
  const std::function<void(const CheckedCase&)>& report_;
  std::regex only_;
  bool is_python_;  // its functions of the contract are dmrp's own: the whole trial alone is tried
  std::size_t chosen_ = 0;
  CheckCounts counts_{};
};

}  // namespace

std::span<const CheckCase> check_cases() {
  static const std::vector<CheckCase> cases = [] {
    std::vector<CheckCase> all;
    for (const auto group :
         {load_check_cases(), descriptor_check_cases(), parameter_check_cases(), trial_check_cases(),
          plan_check_cases(), meaning_check_cases(), step_check_cases(), call_check_cases(), other_check_cases()})
      all.insert(all.end(), group.begin(), group.end());
    all.push_back({"trial/whole", for_all, nullptr, "plugin.h: a trial: start(), the calls of its kind, trial_end()",
                   "run an experiment with it (dmrp-host new shows one), and read its log.txt"});
    return all;
  }();
  return cases;
}

std::vector<std::string> not_driven(const PluginInfo& plugin) {
  std::vector<std::string> parts;
  const auto add = [&](bool applies, const std::string& part) {
    if (applies) parts.push_back(part);
  };
  const bool plans = plugin.kind == DMRP_KIND_GLOBAL_PLANNER;
  const bool controls = plugin.kind == DMRP_KIND_LOCAL_CONTROLLER;
  const bool walks = plugin.kind == DMRP_KIND_PEDESTRIAN_MODEL;
  add(plans && !plugin.has_flag(DMRP_FLAG_WINDOWED), "windows");
  add(plans || controls, "robots of several types, and footprints that are no discs");
  add(controls, "odometry noise and latencies");
  add(walks, "recorded people, and ways through several regions");
  add(plugin.kind == DMRP_KIND_METRIC, "robots that get new plans");
  for (const ParameterSpec& spec : plugin.parameters)
    add(spec.fallback.type == DMRP_PARAM_STRING || spec.fallback.type == DMRP_PARAM_PATH ||
            spec.fallback.type == DMRP_PARAM_STRING_ARRAY,
        "texts of the parameter " + spec.fallback.key);
  return parts;
}

const char* result_name(CheckResult result) {
  static constexpr const char* names[] = {"pass", "skip", "warn", "fail", "crash"};
  return names[static_cast<std::size_t>(result)];
}

CheckCounts check_library(const CheckChoice& choice, const std::function<void(const CheckedCase&)>& report) {
  return Check(choice, report).run();
}

}  // namespace dmrp::host
