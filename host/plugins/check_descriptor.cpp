// SPDX-License-Identifier: MIT
#include "host/plugins/check_descriptor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "host/errors/escaped_text.hpp"
#include "host/plugins/parameter_text.hpp"

namespace dmrp::host {

namespace {

bool is_letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

// Letters, digits and the characters of `others`.
bool consists_of(const std::string& text, const char* others) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [&](char c) {
    return is_letter_or_digit(c) || std::string(others).find(c) != std::string::npos;
  });
}

bool is_planned_connectivity(std::uint32_t connectivity) {
  return connectivity == DMRP_CONNECTIVITY_4 || connectivity == DMRP_CONNECTIVITY_8 ||
         connectivity == DMRP_CONNECTIVITY_ANY;
}

bool has_range(std::uint32_t type) {
  return type == DMRP_PARAM_INT || type == DMRP_PARAM_DOUBLE || type == DMRP_PARAM_DOUBLE_ARRAY;
}

bool is_within(const ParameterSpec& spec) {
  const auto within = [&](double value) { return value >= spec.minimum && value <= spec.maximum; };
  const ParameterValue& value = spec.fallback;
  if (value.type == DMRP_PARAM_INT) return within(static_cast<double>(value.integer));
  if (value.type == DMRP_PARAM_DOUBLE) return within(value.number);
  return std::all_of(value.numbers.begin(), value.numbers.end(), within);
}

// Why the parameter is invalid; "" if it is not.
std::string mistake_in(const ParameterSpec& spec) {
  const ParameterValue& value = spec.fallback;
  if (!consists_of(value.key, "_-")) return "has a key that is not made of letters, digits and '_'";
  if (!is_plain(value.text) || !std::all_of(value.texts.begin(), value.texts.end(), is_plain) ||
      !std::all_of(spec.choices.begin(), spec.choices.end(), is_plain))
    return "has a text with control characters or bytes that are not UTF-8";
  if (value.type == DMRP_PARAM_BOOL && value.integer != 0 && value.integer != 1)
    return fmt::format("is a bool with the default {}", value.integer);
  if (value.type == DMRP_PARAM_CHOICE &&
      std::find(spec.choices.begin(), spec.choices.end(), value.text) == spec.choices.end())
    return fmt::format("has the default {}, which is not one of its choices", toml_text(value));
  if (!has_range(value.type)) return "";
  if (spec.minimum == 0.0 && spec.maximum == 0.0)
    return "has minimum = maximum = 0 (no bound is -INFINITY and INFINITY)";
  if (!(spec.minimum <= spec.maximum)) return fmt::format("has the range {} to {}", spec.minimum, spec.maximum);
  if (!is_within(spec))
    return fmt::format("has the default {}, which is not in {} to {}", toml_text(value), spec.minimum, spec.maximum);
  return "";
}

void check_parameters(const PluginInfo& info, const std::string& subject) {
  std::set<std::string> keys;
  for (const ParameterSpec& spec : info.parameters) {
    const std::string key = escaped(spec.fallback.key.c_str());
    if (const std::string mistake = mistake_in(spec); !mistake.empty())
      throw std::runtime_error(fmt::format("{}: parameter '{}' {}", subject, key, mistake));
    if (!keys.insert(spec.fallback.key).second)
      throw std::runtime_error(fmt::format("{}: declares parameter '{}' twice", subject, key));
  }
}

void check_values(const PluginInfo& info, const std::string& subject) {
  std::set<std::string> names;
  for (const MetricValueSpec& spec : info.values) {
    if (!consists_of(spec.name, "_"))
      throw std::runtime_error(fmt::format("{}: has a value whose name '{}' is not made of letters, digits and '_'",
                                           subject, escaped(spec.name.c_str())));
    if (!(spec.subjects & (1u << DMRP_SUBJECT_SYSTEM)))
      throw std::runtime_error(
          fmt::format("{}: declares the value '{}' without the system among its subjects", subject, spec.name));
    if (!(spec.minimum <= spec.maximum))
      throw std::runtime_error(
          fmt::format("{}: the value '{}' has the range {} to {}", subject, spec.name, spec.minimum, spec.maximum));
    if (!names.insert(spec.name).second)
      throw std::runtime_error(fmt::format("{}: declares the value '{}' twice", subject, spec.name));
  }
}

}  // namespace

std::string unknown_part(const PluginInfo& info) {
  if (info.kind < DMRP_KIND_GLOBAL_PLANNER || info.kind > DMRP_KIND_METRIC)
    return fmt::format("is of kind {}", info.kind);
  if (info.kind == DMRP_KIND_GLOBAL_PLANNER && info.connectivity != DMRP_CONNECTIVITY_NONE &&
      !is_planned_connectivity(info.connectivity))
    return fmt::format("plans with connectivity {}", info.connectivity);
  if (const std::uint32_t needed = info.flags & DMRP_FLAGS_NEEDED)
    return fmt::format("has the flags {:#x} of DMRP_FLAGS_NEEDED", needed);
  for (const ParameterSpec& spec : info.parameters)
    if (spec.fallback.type > DMRP_PARAM_STRING_ARRAY)
      return fmt::format("has parameter '{}' of type {}", escaped(spec.fallback.key.c_str()), spec.fallback.type);
  return "";
}

void check_descriptor(const PluginInfo& info) {
  if (info.id.empty()) throw std::runtime_error("has a plugin without an id");
  const std::string subject = escaped(info.id.c_str());
  if (!consists_of(info.id, ".-_"))
    throw std::runtime_error(
        fmt::format("has a plugin with the id '{}': an id is made of letters, digits, '.', '_' and '-'", subject));
  if (info.kind == DMRP_KIND_GLOBAL_PLANNER && !is_planned_connectivity(info.connectivity))
    throw std::runtime_error(fmt::format("'{}' is a planner that declares no connectivity (4, 8, any)", subject));
  for (const ParameterSpec& spec : info.parameters)
    if (spec.fallback.type < DMRP_PARAM_BOOL)
      throw std::runtime_error(
          fmt::format("{}: declares parameter '{}' without a type", subject, escaped(spec.fallback.key.c_str())));
  check_parameters(info, subject);
  check_values(info, subject);
}

bool is_reserved_id(const std::string& id) {
  return id.rfind("dmrp.", 0) == 0;
}

}  // namespace dmrp::host
