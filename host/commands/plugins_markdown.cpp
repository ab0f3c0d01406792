// SPDX-License-Identifier: MIT
#include "host/commands/plugins_markdown.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "host/plugins/parameter_text.hpp"

namespace dmrp::host {

namespace {

std::string unit_of(const std::string& unit) {
  return unit == "1" ? "" : unit;
}

// " (m; lower; robots)": unit, better direction, subjects beside the system.
std::string about(const MetricValueSpec& value) {
  std::vector<std::string> parts;
  if (!unit_of(value.unit).empty()) parts.push_back(value.unit);
  if (value.direction == DMRP_DIRECTION_LOWER) parts.emplace_back("lower");
  if (value.direction == DMRP_DIRECTION_HIGHER) parts.emplace_back("higher");
  if (value.subjects & 1u << DMRP_SUBJECT_ROBOT) parts.emplace_back("robots");
  if (value.subjects & 1u << DMRP_SUBJECT_PEDESTRIAN) parts.emplace_back("people");
  if (value.curve) parts.emplace_back("a curve");
  if (value.wall_clock) parts.emplace_back("wall clock");
  return parts.empty() ? "" : fmt::format(" ({})", fmt::join(parts, "; "));
}

void append_values(std::string& out, const PluginInfo& info) {
  for (const MetricValueSpec& value : info.values)
    out += fmt::format("- `{}`{}: {}\n", value.name, about(value), value.description);
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
    out += "Values: `name` (unit; better direction; whose, beside the system's): formula.\n";
  out += "Parameters: `name = default` (range, unit): meaning.\n\n";
  for (const PluginInfo& info : plugins) {
    out += fmt::format("## {}\n\n`{}`", info.name, info.id);
    if (info.values.empty()) out += ": " + info.summary;  // formulas say more
    out += info.source.empty() ? ".\n\n" : fmt::format(". Source: {}.\n\n", info.source);
    append_values(out, info);
    append_parameters(out, info);
  }
  while (out.size() > 1 && out[out.size() - 2] == '\n') out.pop_back();
  return out;
}

}  // namespace dmrp::host
