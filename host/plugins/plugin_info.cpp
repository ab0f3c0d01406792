// SPDX-License-Identifier: MIT
#include "host/plugins/plugin_info.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace dmrp::host {

namespace {

std::string text_of(const char* text) {
  return text ? text : "";
}

std::vector<std::string> texts_of(const char* const* texts, std::uint32_t count) {
  std::vector<std::string> out;
  for (std::uint32_t i = 0; i < count; ++i) out.push_back(text_of(texts[i]));
  return out;
}

ParameterSpec copy_parameter(const dmrp_param_spec& c) {
  ParameterSpec out;
  const dmrp_param_value& value = c.fallback;
  out.fallback = {text_of(value.key), value.type, value.integer, value.number, text_of(value.text), {}, {}};
  if (value.type == DMRP_PARAM_DOUBLE_ARRAY) out.fallback.numbers.assign(value.numbers, value.numbers + value.count);
  if (value.type == DMRP_PARAM_STRING_ARRAY) out.fallback.texts = texts_of(value.texts, value.count);
  out.unit = text_of(c.unit);
  out.doc = text_of(c.doc);
  out.minimum = c.minimum;
  out.maximum = c.maximum;
  out.choices = texts_of(c.choices, c.choice_count);
  if (out.fallback.key.empty()) throw std::runtime_error("declares a parameter without a key");
  if (value.type < DMRP_PARAM_BOOL || value.type > DMRP_PARAM_STRING_ARRAY)
    throw std::runtime_error("declares parameter '" + out.fallback.key + "' with an unknown type");
  return out;
}

// JSON has no infinity: a missing bound is null.
nlohmann::json bound(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}
double bound(const nlohmann::json& json, double none) {
  return json.is_null() ? none : json.get<double>();
}

// A default may be infinite or NaN: then a string, as TOML writes it.
nlohmann::json any_number(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
}
double any_number(const nlohmann::json& json) {
  return json.is_string() ? std::strtod(json.get<std::string>().c_str(), nullptr) : json.get<double>();
}

// Array elements are at least as large as in v1.0.
void check_stride(std::uint32_t count, std::uint32_t stride, std::size_t least, const char* what) {
  if (count > 0 && stride < least)
    throw std::runtime_error(std::string("has a descriptor with ") + what + " that are shorter than v1.0's");
}

}  // namespace

void to_json(nlohmann::json& json, const ParameterValue& value) {
  nlohmann::json numbers = nlohmann::json::array();
  for (const double number : value.numbers) numbers.push_back(any_number(number));
  json = {{"key", value.key},   {"type", value.type}, {"integer", value.integer}, {"number", any_number(value.number)},
          {"text", value.text}, {"numbers", numbers}, {"texts", value.texts}};
}

void from_json(const nlohmann::json& json, ParameterValue& value) {
  json.at("key").get_to(value.key);
  json.at("type").get_to(value.type);
  json.at("integer").get_to(value.integer);
  value.number = any_number(json.at("number"));
  json.at("text").get_to(value.text);
  value.numbers.clear();
  for (const nlohmann::json& number : json.at("numbers")) value.numbers.push_back(any_number(number));
  json.at("texts").get_to(value.texts);
}

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MetricValueSpec, name, unit, description, direction, subjects, wall_clock, curve)

void to_json(nlohmann::json& json, const ParameterSpec& spec) {
  json = {
      {"default", spec.fallback},       {"unit", spec.unit},      {"doc", spec.doc}, {"minimum", bound(spec.minimum)},
      {"maximum", bound(spec.maximum)}, {"choices", spec.choices}};
}

void from_json(const nlohmann::json& json, ParameterSpec& spec) {
  spec.fallback = json.at("default").get<ParameterValue>();
  spec.unit = json.at("unit").get<std::string>();
  spec.doc = json.at("doc").get<std::string>();
  spec.minimum = bound(json.at("minimum"), -std::numeric_limits<double>::infinity());
  spec.maximum = bound(json.at("maximum"), std::numeric_limits<double>::infinity());
  spec.choices = json.at("choices").get<std::vector<std::string>>();
}

namespace {

// The fields, for both directions.
template <class Visit>
void visit_fields(Visit&& visit) {
  visit("id", &PluginInfo::id);
  visit("kind", &PluginInfo::kind);
  visit("name", &PluginInfo::name);
  visit("version", &PluginInfo::version);
  visit("vendor", &PluginInfo::vendor);
  visit("license", &PluginInfo::license);
  visit("summary", &PluginInfo::summary);
  visit("source", &PluginInfo::source);
  visit("requires", &PluginInfo::needs);
  visit("uses", &PluginInfo::uses);
  visit("parameters", &PluginInfo::parameters);
  visit("values", &PluginInfo::values);
  visit("connectivity", &PluginInfo::connectivity);
  visit("planner_flags", &PluginInfo::planner_flags);
  visit("channels", &PluginInfo::channels);
}

}  // namespace

void to_json(nlohmann::json& json, const PluginInfo& info) {
  json = nlohmann::json::object();
  visit_fields([&](const char* key, auto member) { json[key] = info.*member; });
}

void from_json(const nlohmann::json& json, PluginInfo& info) {
  visit_fields([&](const char* key, auto member) { json.at(key).get_to(info.*member); });
}

const char* kind_name(std::uint32_t kind) {
  switch (kind) {
    case DMRP_KIND_GLOBAL_PLANNER:
      return "global_planner";
    case DMRP_KIND_LOCAL_CONTROLLER:
      return "local_controller";
    case DMRP_KIND_PEDESTRIAN_MODEL:
      return "pedestrian_model";
    case DMRP_KIND_METRIC:
      return "metric";
    default:
      return "unknown";
  }
}

const char* parameter_type_name(std::uint32_t type) {
  static const char* const names[] = {"unknown", "bool", "int",          "double",      "string",
                                      "choice",  "path", "double array", "string array"};
  return type < std::size(names) ? names[type] : names[0];
}

PluginInfo copy_descriptor(const dmrp_descriptor& c) {
  PluginInfo out;
  if (!DMRP_HAS(&c, reserved)) throw std::runtime_error("has a descriptor that is shorter than v1.0's");
  out.id = text_of(c.id);
  out.kind = c.kind;
  if (out.id.empty()) throw std::runtime_error("has a plugin without an id");
  if (c.kind < DMRP_KIND_GLOBAL_PLANNER || c.kind > DMRP_KIND_METRIC)
    throw std::runtime_error("'" + out.id + "' is of a kind that this host does not know");
  out.name = text_of(c.name);
  out.version = text_of(c.version);
  out.vendor = text_of(c.vendor);
  out.license = text_of(c.license);
  out.summary = text_of(c.summary);
  out.source = text_of(c.source);
  out.needs = texts_of(c.requires_, c.requires_count);
  out.uses = texts_of(c.uses, c.uses_count);
  check_stride(c.param_count, c.param_stride, sizeof(dmrp_param_spec), "parameters");
  check_stride(c.value_count, c.value_stride, sizeof(dmrp_metric_value_spec), "values");
  for (std::uint32_t i = 0; i < c.param_count; ++i)
    out.parameters.push_back(copy_parameter(*DMRP_AT(dmrp_param_spec, c.params, c.param_stride, i)));
  for (std::uint32_t i = 0; i < c.value_count; ++i) {
    const auto& v = *DMRP_AT(dmrp_metric_value_spec, c.values, c.value_stride, i);
    if (!(v.subjects & (1u << DMRP_SUBJECT_SYSTEM)))
      throw std::runtime_error("'" + out.id + "' declares a value without the system among its subjects");
    out.values.push_back({text_of(v.name), text_of(v.unit), text_of(v.description), v.direction, v.subjects,
                          v.wall_clock != 0, v.curve != 0});
  }
  out.connectivity = c.connectivity;
  out.planner_flags = c.planner_flags;
  out.channels = c.channels;
  if (c.kind == DMRP_KIND_GLOBAL_PLANNER && c.connectivity != DMRP_CONNECTIVITY_4 &&
      c.connectivity != DMRP_CONNECTIVITY_8 && c.connectivity != DMRP_CONNECTIVITY_ANY)
    throw std::runtime_error("'" + out.id + "' is a planner that declares no connectivity (4, 8, any)");
  return out;
}

}  // namespace dmrp::host
