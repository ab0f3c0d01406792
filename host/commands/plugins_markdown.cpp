// SPDX-License-Identifier: MIT
#include "host/commands/plugins_markdown.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/plugins/parameter_text.hpp"

namespace dmrp::host {

namespace {

// A bar would end the table's cell.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c;
  }
  return out;
}

std::string unit_of(const std::string& unit) {
  return unit == "1" || unit.empty() ? "" : unit;
}

const char* better(const MetricValueSpec& value) {
  return value.direction == DMRP_DIRECTION_LOWER ? "lower" : value.direction == DMRP_DIRECTION_HIGHER ? "higher" : "";
}

std::string given_for(const MetricValueSpec& value) {
  std::string out = "system";
  if (value.subjects & 1u << DMRP_SUBJECT_ROBOT) out += ", robots";
  if (value.subjects & 1u << DMRP_SUBJECT_PEDESTRIAN) out += ", people";
  if (value.curve) out += "; a curve";
  if (value.wall_clock) out += "; wall clock";
  return out;
}

// The anchor that GitHub gives a heading.
std::string anchor_of(const std::string& heading) {
  std::string out;
  for (const char c : heading) {
    if (c >= 'A' && c <= 'Z') out += static_cast<char>(c - 'A' + 'a');
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_') out += c;
    if (c == ' ') out += '-';
  }
  return out;
}

void append_index(std::string& out, const std::vector<PluginInfo>& plugins) {
  if (std::all_of(plugins.begin(), plugins.end(), [](const PluginInfo& info) { return info.values.empty(); })) return;
  out += "| value | unit | better | of |\n| --- | --- | --- | --- |\n";
  for (const PluginInfo& info : plugins)
    for (const MetricValueSpec& value : info.values)
      out += fmt::format("| `{}` | {} | {} | [{}](#{}) |\n", value.name, unit_of(value.unit), better(value), info.name,
                         anchor_of(info.name));
  out += "\n";
}

void append_values(std::string& out, const PluginInfo& info) {
  if (info.values.empty()) return;
  out += "| value | unit | better | given for | formula |\n| --- | --- | --- | --- | --- |\n";
  for (const MetricValueSpec& value : info.values)
    out += fmt::format("| `{}` | {} | {} | {} | {} |\n", value.name, unit_of(value.unit), better(value),
                       given_for(value), cell(value.description));
  out += "\n";
}

void append_parameters(std::string& out, const PluginInfo& info) {
  if (info.parameters.empty()) return;
  out += "| parameter | type | default | unit | range | |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const ParameterSpec& spec : info.parameters)
    out +=
        fmt::format("| `{}` | {} | `{}` | {} | {} | {} |\n", spec.fallback.key, parameter_type_name(spec.fallback.type),
                    cell(toml_text(spec.fallback)), unit_of(spec.unit), cell(parameter_range(spec)), cell(spec.doc));
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
  append_index(out, plugins);
  for (const PluginInfo& info : plugins) {
    out += fmt::format("## {}\n\n`{}` ({}): {}.\n", info.name, info.id, kind_name(info.kind), info.summary);
    if (!info.source.empty()) out += fmt::format("Source: {}.\n", info.source);
    out += "\n";
    append_values(out, info);
    append_parameters(out, info);
  }
  while (out.size() > 1 && out[out.size() - 2] == '\n') out.pop_back();
  return out;
}

}  // namespace dmrp::host
