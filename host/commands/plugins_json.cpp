// SPDX-License-Identifier: MIT
#include "host/commands/plugins_json.hpp"

#include <dmrp/robot_event.h>
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace dmrp::host {

namespace {

using Json = nlohmann::ordered_json;
using BitNames = std::vector<std::pair<std::uint32_t, const char*>>;

// The names of the bits that are set; a bit without a name as a number.
Json bits(std::uint32_t set, const BitNames& names) {
  Json out = Json::array();
  for (const auto& [bit, name] : names) {
    if ((set & bit) != 0) out.push_back(name);
    set &= ~bit;
  }
  if (set != 0) out.push_back(set);
  return out;
}

// JSON has no infinity: no bound is null.
Json bound(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

// A default may be infinite or NaN: then as TOML writes it.
Json number(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf";
}

Json default_of(const ParameterValue& value) {
  switch (value.type) {
    case DMRP_PARAM_BOOL:
      return value.integer != 0;
    case DMRP_PARAM_INT:
      return value.integer;
    case DMRP_PARAM_DOUBLE:
      return number(value.number);
    case DMRP_PARAM_DOUBLE_ARRAY: {
      Json numbers = Json::array();
      for (const double one : value.numbers) numbers.push_back(number(one));
      return numbers;
    }
    case DMRP_PARAM_STRING_ARRAY:
      return value.texts;
    default:
      return value.text;
  }
}

Json parameter(const ParameterSpec& spec) {
  return {{"key", spec.fallback.key},
          {"type", parameter_type_name(spec.fallback.type)},
          {"default", default_of(spec.fallback)},
          {"unit", spec.unit},
          {"doc", spec.doc},
          {"minimum", bound(spec.minimum)},
          {"maximum", bound(spec.maximum)},
          {"choices", spec.choices}};
}

Json value(const MetricValueSpec& spec) {
  const char* direction = spec.direction == DMRP_DIRECTION_LOWER    ? "lower"
                          : spec.direction == DMRP_DIRECTION_HIGHER ? "higher"
                                                                    : "none";
  return {{"name", spec.name},
          {"unit", spec.unit},
          {"description", spec.description},
          {"direction", direction},
          {"subjects", bits(spec.subjects, {{1u << DMRP_SUBJECT_SYSTEM, "system"},
                                            {1u << DMRP_SUBJECT_ROBOT, "robot"},
                                            {1u << DMRP_SUBJECT_PEDESTRIAN, "pedestrian"}})},
          {"wall_clock", spec.wall_clock},
          {"curve", spec.curve}};
}

Json connectivity_name(std::uint32_t connectivity) {
  if (connectivity == DMRP_CONNECTIVITY_NONE) return nullptr;
  return connectivity == DMRP_CONNECTIVITY_ANY ? "any" : std::to_string(connectivity);
}

}  // namespace

Json plugin_as_json(const PluginInfo& info) {
  Json out = {{"id", info.id},           {"kind", kind_name(info.kind)},  {"name", info.name},
              {"version", info.version}, {"vendor", info.vendor},         {"license", info.license},
              {"url", info.url},         {"manual_url", info.manual_url}, {"summary", info.summary},
              {"source", info.source},   {"features", info.features},     {"requires", info.needs},
              {"uses", info.uses}};
  out["parameters"] = Json::array();
  for (const ParameterSpec& spec : info.parameters) out["parameters"].push_back(parameter(spec));
  out["values"] = Json::array();
  for (const MetricValueSpec& spec : info.values) out["values"].push_back(value(spec));
  out["connectivity"] = connectivity_name(info.connectivity);
  out["channels"] = bits(info.channels, {{DMRP_CHANNEL_PEOPLE, "people"},
                                         {DMRP_CHANNEL_CALLS, "calls"},
                                         {DMRP_CHANNEL_RECOVERIES, "recoveries"},
                                         {DMRP_CHANNEL_ROUTES, "routes"}});
  out["flags"] = bits(info.flags, {{DMRP_FLAG_UNCOORDINATED, "uncoordinated"},
                                   {DMRP_FLAG_CENTRAL, "central"},
                                   {DMRP_FLAG_BACKWARDS, "backwards"},
                                   {DMRP_FLAG_PROCESSES, "processes"},
                                   {DMRP_FLAG_RESIDENT_MEMORY, "resident_memory"},
                                   {DMRP_FLAG_WINDOWED, "windowed"}});
  out["kinematics"] = bits(info.kinematics, {{1u << DMRP_KINEMATICS_DIFFERENTIAL, "differential"},
                                             {1u << DMRP_KINEMATICS_HOLONOMIC, "holonomic"},
                                             {1u << DMRP_KINEMATICS_ACKERMANN, "ackermann"}});
  return out;
}

}  // namespace dmrp::host
