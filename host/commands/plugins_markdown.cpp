// SPDX-License-Identifier: MIT
#include "host/commands/plugins_markdown.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/plugins/parameter_text.hpp"

namespace dmrp::host {

namespace {

std::string unit_of(const std::string& unit) {
  return unit == "1" ? "" : unit;
}

// "m; lower; system, robots": unit, better direction, subjects.
std::string about(const MetricValueSpec& value) {
  std::string out = unit_of(value.unit);
  if (!out.empty()) out += "; ";
  if (value.direction == DMRP_DIRECTION_LOWER) out += "lower; ";
  if (value.direction == DMRP_DIRECTION_HIGHER) out += "higher; ";
  out += "system";
  if (value.subjects & 1u << DMRP_SUBJECT_ROBOT) out += ", robots";
  if (value.subjects & 1u << DMRP_SUBJECT_PEDESTRIAN) out += ", people";
  if (value.curve) out += "; a curve";
  if (value.wall_clock) out += "; wall clock";
  return out;
}

void append_values(std::string& out, const PluginInfo& info) {
  for (const MetricValueSpec& value : info.values)
    out += fmt::format("- `{}` ({}): {}\n", value.name, about(value), value.description);
  if (!info.values.empty()) out += "\n";
}

void append_parameters(std::string& out, const PluginInfo& info) {
  if (info.parameters.empty()) return;
  out += "Parameters:\n\n";
  for (const ParameterSpec& spec : info.parameters) {
    std::string range = parameter_range(spec);
    const std::string unit = unit_of(spec.unit);
    if (!range.empty() && !unit.empty()) range += " ";
    range += unit;
    if (!range.empty()) range = " (" + range + ")";
    out += fmt::format("- `{} = {}`{}: {}\n", spec.fallback.key, toml_text(spec.fallback), range, spec.doc);
  }
  out += "\n";
}

}  // namespace

std::string parameter_range(const ParameterSpec& spec) {
  if (!spec.choices.empty()) return fmt::format("one of {}", fmt::join(spec.choices, ", "));
  const bool low = std::isfinite(spec.minimum);
  const bool high = std::isfinite(spec.maximum);
  if (low && high) return fmt::format("{} to {}", spec.minimum, spec.maximum);
  if (low) return fmt::format(">= {}", spec.minimum);
  if (high) return fmt::format("<= {}", spec.maximum);
  return "";
}

std::string plugins_markdown(const std::string& library, const std::vector<PluginInfo>& plugins) {
  std::string out = fmt::format("<!-- dmrp-host plugins --markdown {} -->\n\n", library);
  if (std::any_of(plugins.begin(), plugins.end(), [](const PluginInfo& info) { return !info.values.empty(); }))
    out += "Values: `name` (unit; better direction; given for): formula.\n";
  out += "Parameters: `name = default` (range, unit): meaning.\n\n";
  for (const PluginInfo& info : plugins) {
    out += fmt::format("## {}\n\n`{}`: {}.\n", info.name, info.id, info.summary);
    if (!info.source.empty()) out += fmt::format("Source: {}.\n", info.source);
    out += "\n";
    append_values(out, info);
    append_parameters(out, info);
  }
  while (out.size() > 1 && out[out.size() - 2] == '\n') out.pop_back();
  return out;
}

}  // namespace dmrp::host
