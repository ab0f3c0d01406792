// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <dmrp/toolkit/random.hpp>
#include <functional>
#include <vector>

#include "host/check/check_case.hpp"
#include "host/check/examination.hpp"
#include "host/check/rehearsal/rehearsal.hpp"
#include "host/plugins/parameter_text.hpp"

namespace dmrp::host::parameter_cases {

namespace {

// A number of the type of `value`, in place of it.
ParameterValue with_number(ParameterValue value, double number) {
  if (value.type == DMRP_PARAM_INT)
    value.integer = static_cast<std::int64_t>(std::llround(std::clamp(number, -9e15, 9e15)));
  if (value.type == DMRP_PARAM_DOUBLE) value.number = number;
  std::fill(value.numbers.begin(), value.numbers.end(), number);
  return value;
}

bool has_range(const ParameterSpec& spec) {
  return spec.fallback.type == DMRP_PARAM_INT || spec.fallback.type == DMRP_PARAM_DOUBLE ||
         (spec.fallback.type == DMRP_PARAM_DOUBLE_ARRAY && !spec.fallback.numbers.empty());
}

// A bound may ask for more memory than a case has; and no range can say that two parameters are at odds: then the text
// names both.
bool is_excused(const PluginInfo& info, const std::string& key, const PluginFault& fault) {
  const std::string text = fault.what();
  if (fault.kind() == std::string_view(fault_kind::out_of_memory)) return true;
  if (fault.kind() != std::string_view(fault_kind::error_status) || text.find(key) == std::string::npos) return false;
  return std::any_of(info.parameters.begin(), info.parameters.end(), [&](const ParameterSpec& other) {
    return other.fallback.key != key && text.find(other.fallback.key) != std::string::npos;
  });
}

constexpr int few_calls = 3;                          // with one value
constexpr int more_calls = 20;                        // where a value switches to other code
constexpr std::int64_t asks_until_stop = 100;         // then should_stop() says stop
constexpr std::int64_t work_time_ns = 1'000'000'000;  // of the processor; then values are only started

std::int64_t cpu_ns() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

// Creates and starts an instance in which one parameter has another value, and lets it work for so many calls.
void try_value(Examination& it, std::size_t index, const ParameterValue& value, int calls) {
  it.at(fmt::format("{} = {}", value.key, toml_text(value)));
  std::vector<ParameterValue> parameters = it.defaults();
  parameters[index] = value;
  try {
    const auto instance = it.create(parameters);
    Rehearsal rehearsal(*instance, it.plugin(), {}, it.seed());
    for (int i = 0; i < calls && rehearsal.advance(); ++i) {
    }
  } catch (const PluginFault& fault) {
    if (fault.fatal() || !is_excused(it.plugin(), value.key, fault)) throw;
  }
}

// Each parameter with the values that `choose` makes of its declaration.
void try_all(Examination& it, int calls,
             const std::function<std::vector<ParameterValue>(const ParameterSpec&)>& choose) {
  const auto& specs = it.plugin().parameters;
  if (specs.empty()) throw Skipped{"it has no parameters"};
  std::size_t tried = 0;
  std::size_t started = 0;
  const std::int64_t begin_ns = cpu_ns();
  it.guard().stop_after_asks(asks_until_stop);
  for (std::size_t i = 0; i < specs.size(); ++i)
    for (const ParameterValue& value : choose(specs[i])) {
      const bool and_work = cpu_ns() - begin_ns < work_time_ns;
      try_value(it, i, value, and_work ? calls : 0);
      ++tried;
      started += !and_work;
    }
  if (tried == 0) throw Skipped{"no parameter has such a value"};
  it.at("");
  if (started > 0)
    it.note(fmt::format("{} of {} values were tried up to start() alone: the others took long", started, tried));
}

}  // namespace

void defaults(Examination& it) {
  const auto instance = it.create();
  Rehearsal rehearsal(*instance, it.plugin(), {}, it.seed());
  std::int64_t calls = 1;
  const std::int64_t begin_ns = cpu_ns();
  while (rehearsal.advance()) ++calls;
  it.calls_take((cpu_ns() - begin_ns) / calls);
}

void minimum(Examination& it) {
  try_all(it, few_calls, [](const ParameterSpec& spec) -> std::vector<ParameterValue> {
    if (!has_range(spec) || !std::isfinite(spec.minimum)) return {};
    return {with_number(spec.fallback, spec.minimum)};
  });
}

void maximum(Examination& it) {
  try_all(it, few_calls, [](const ParameterSpec& spec) -> std::vector<ParameterValue> {
    if (!has_range(spec) || !std::isfinite(spec.maximum)) return {};
    return {with_number(spec.fallback, spec.maximum)};
  });
}

// Numbers between half of the default and twice as much.
void drawn(Examination& it) {
  toolkit::Stream random(it.seed(), "check", 0);
  try_all(it, few_calls, [&](const ParameterSpec& spec) -> std::vector<ParameterValue> {
    if (!has_range(spec)) return {};
    const ParameterValue& value = spec.fallback;
    const double number = value.type == DMRP_PARAM_INT      ? static_cast<double>(value.integer)
                          : value.type == DMRP_PARAM_DOUBLE ? value.number
                                                            : value.numbers.front();
    double chosen = std::clamp(number * random.uniform(0.5, 2.0), spec.minimum, spec.maximum);
    if (value.type == DMRP_PARAM_INT)
      chosen = std::clamp(std::round(chosen), std::ceil(spec.minimum), std::floor(spec.maximum));
    return {with_number(spec.fallback, chosen)};
  });
}

// The other truth, and all other choices.
void choices(Examination& it) {
  try_all(it, more_calls, [](const ParameterSpec& spec) {
    std::vector<ParameterValue> values;
    ParameterValue value = spec.fallback;
    if (value.type == DMRP_PARAM_BOOL) {
      value.integer = 1 - value.integer;
      values.push_back(value);
    }
    for (const std::string& choice : spec.choices)
      if (value.type == DMRP_PARAM_CHOICE && choice != spec.fallback.text) {
        value.text = choice;
        values.push_back(value);
      }
    return values;
  });
}

}  // namespace dmrp::host::parameter_cases

namespace dmrp::host {

std::span<const CheckCase> parameter_check_cases() {
  static constexpr CheckCase cases[] = {
      {"parameters/defaults", for_all, parameter_cases::defaults,
       "parameter.h: create() gets the complete table, defaults filled in", "take the declared defaults"},
      {"parameters/minimum", for_all, parameter_cases::minimum,
       "parameter.h: the host lets through any value from minimum to maximum",
       "raise the minimum to what the plugin can take"},
      {"parameters/maximum", for_all, parameter_cases::maximum,
       "parameter.h: the host lets through any value from minimum to maximum",
       "lower the maximum to what the plugin can take"},
      {"parameters/drawn", for_all, parameter_cases::drawn,
       "parameter.h: the host lets through any value from minimum to maximum", "narrow the range, or take the value"},
      {"parameters/choices", for_all, parameter_cases::choices,
       "parameter.h: the host lets through both truths and every choice", "leave out the choice, or take it"},
  };
  return cases;
}

}  // namespace dmrp::host
