// SPDX-License-Identifier: MIT
// plugin_info.hpp: the host's copy of a plugin's descriptor, which outlives the library and is sent between processes.
#pragma once

#include <dmrp/descriptor.h>

#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace dmrp::host {

// The value of a parameter, in the member of its type.
struct ParameterValue {
  std::string key;
  std::uint32_t type = 0;  // DMRP_PARAM_*
  std::int64_t integer = 0;
  double number = 0.0;
  std::string text;
  std::vector<double> numbers;
  std::vector<std::string> texts;
};

struct ParameterSpec {
  ParameterValue fallback;
  std::string unit;
  std::string doc;
  double minimum = 0.0;
  double maximum = 0.0;
  std::vector<std::string> choices;
};

struct MetricValueSpec {
  std::string name;
  std::string unit;
  std::string description;
  std::uint32_t direction = DMRP_DIRECTION_NONE;
  std::uint32_t subjects = 0;
  bool wall_clock = false;
  bool curve = false;
  double minimum = -std::numeric_limits<double>::infinity();  // what it can be
  double maximum = std::numeric_limits<double>::infinity();
};

struct PluginInfo {
  std::string id;
  std::uint32_t kind = 0;  // DMRP_KIND_*
  std::string name;
  std::string version;
  std::string vendor;
  std::string license;
  std::string url;
  std::string manual_url;
  std::string summary;
  std::string source;
  std::vector<std::string> features;
  std::vector<std::string> needs;  // extensions
  std::vector<std::string> uses;
  std::vector<ParameterSpec> parameters;
  std::vector<MetricValueSpec> values;
  std::uint32_t connectivity = DMRP_CONNECTIVITY_NONE;
  std::uint32_t channels = 0;
  std::uint32_t flags = 0;       // DMRP_FLAG_*
  std::uint32_t kinematics = 0;  // bits 1u << DMRP_KINEMATICS_*, of a controller never 0

  bool has_flag(std::uint32_t flag) const { return (flags & flag) != 0; }
};

// "global_planner", ...: the names of the tables in experiment files.
const char* kind_name(std::uint32_t kind);

// "bool", "int", "double", "string", "choice", "path", "double array", "string array".
const char* parameter_type_name(std::uint32_t type);

// Throws std::runtime_error, in one line, if the descriptor or an array of it is shorter than v1.0's.
PluginInfo copy_descriptor(const dmrp_descriptor& descriptor);

void to_json(nlohmann::json& json, const ParameterValue& value);
void from_json(const nlohmann::json& json, ParameterValue& value);
void to_json(nlohmann::json& json, const PluginInfo& info);
void from_json(const nlohmann::json& json, PluginInfo& info);

}  // namespace dmrp::host
