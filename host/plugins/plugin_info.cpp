// SPDX-License-Identifier: MIT
#include "host/plugins/plugin_info.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "host/errors/escaped_text.hpp"
#include "host/plugins/v1_sizes.hpp"

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

std::vector<std::string> escaped_texts(const char* const* texts, std::uint32_t count) {
  std::vector<std::string> out;
  for (std::uint32_t i = 0; i < count; ++i) out.push_back(escaped(texts[i]));
  return out;
}

// A later minor version may give it a meaning that this host does not know.
void refuse_reserved(std::uint32_t reserved, const std::string& owner) {
  if (reserved != 0)
    throw std::runtime_error(owner + " has " + std::to_string(reserved) + " in a reserved field, which must be 0");
}

ParameterSpec copy_parameter(const dmrp_param_spec& c) {
  refuse_reserved(c.reserved, "parameter '" + escaped(c.key) + "'");
  ParameterSpec out;
  out.fallback = {text_of(c.key), c.type, c.integer, c.number, text_of(c.text), {}, {}};
  if (c.type == DMRP_PARAM_DOUBLE_ARRAY) out.fallback.numbers.assign(c.numbers, c.numbers + c.count);
  if (c.type == DMRP_PARAM_STRING_ARRAY) out.fallback.texts = texts_of(c.texts, c.count);
  out.unit = escaped(c.unit);
  out.doc = escaped(c.doc);
  out.minimum = c.minimum;
  out.maximum = c.maximum;
  out.choices = texts_of(c.choices, c.choice_count);
  return out;
}

MetricValueSpec copy_value(const dmrp_metric_value_spec& c) {
  MetricValueSpec out = {text_of(c.name),   escaped(c.unit), escaped(c.description), c.direction, c.subjects,
                         c.wall_clock != 0, c.curve != 0};
  if (c.minimum != 0.0 || c.maximum != 0.0) out.minimum = c.minimum, out.maximum = c.maximum;
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

template <class Element, class Copy>
auto copy_all(const Element* base, std::uint32_t count, std::uint32_t stride, const char* what, Copy&& copy) {
  if (count > 0 && !has_stride_v1_0<Element>(stride))
    throw std::runtime_error(std::string("has a descriptor with ") + what +
                             " that are shorter than v1.0's, or whose stride is no multiple of 8");
  std::vector<decltype(copy(*base))> out;
  for (std::uint32_t i = 0; i < count; ++i) out.push_back(copy(copy_element(base, stride, i)));
  return out;
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

void to_json(nlohmann::json& json, const MetricValueSpec& spec) {
  json = {{"name", spec.name},
          {"unit", spec.unit},
          {"description", spec.description},
          {"direction", spec.direction},
          {"subjects", spec.subjects},
          {"wall_clock", spec.wall_clock},
          {"curve", spec.curve},
          {"minimum", bound(spec.minimum)},
          {"maximum", bound(spec.maximum)}};
}

void from_json(const nlohmann::json& json, MetricValueSpec& spec) {
  spec = {json.at("name"),
          json.at("unit"),
          json.at("description"),
          json.at("direction"),
          json.at("subjects"),
          json.at("wall_clock"),
          json.at("curve"),
          bound(json.at("minimum"), -std::numeric_limits<double>::infinity()),
          bound(json.at("maximum"), std::numeric_limits<double>::infinity())};
}

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
  visit("url", &PluginInfo::url);
  visit("manual_url", &PluginInfo::manual_url);
  visit("summary", &PluginInfo::summary);
  visit("source", &PluginInfo::source);
  visit("features", &PluginInfo::features);
  visit("requires", &PluginInfo::needs);
  visit("uses", &PluginInfo::uses);
  visit("parameters", &PluginInfo::parameters);
  visit("values", &PluginInfo::values);
  visit("connectivity", &PluginInfo::connectivity);
  visit("channels", &PluginInfo::channels);
  visit("flags", &PluginInfo::flags);
  visit("kinematics", &PluginInfo::kinematics);
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

namespace {

// The traits of the descriptor's kind; zero where it has none.
template <class Traits>
Traits traits_of(const dmrp_descriptor& descriptor) {
  if (!descriptor.traits) return {};
  const Traits& theirs = *static_cast<const Traits*>(descriptor.traits);
  if (!has_v1_0<Traits>(theirs.struct_size)) throw std::runtime_error("has traits that are shorter than v1.0's");
  return copy_struct(theirs);
}

void copy_traits(const dmrp_descriptor& c, PluginInfo& out) {
  if (c.kind == DMRP_KIND_GLOBAL_PLANNER) out.connectivity = traits_of<dmrp_planner_traits>(c).connectivity;
  if (c.kind == DMRP_KIND_LOCAL_CONTROLLER) {
    const std::uint32_t drives = traits_of<dmrp_controller_traits>(c).kinematics;
    out.kinematics = drives == 0 ? 1u << DMRP_KINEMATICS_DIFFERENTIAL : drives;
  }
  if (c.kind == DMRP_KIND_METRIC) {
    const auto traits = traits_of<dmrp_metric_traits>(c);
    out.channels = traits.channels;
    out.values = copy_all(traits.values, traits.value_count, traits.value_stride, "values", copy_value);
  }
}

}  // namespace

PluginInfo copy_descriptor(const dmrp_descriptor& theirs) {
  if (!has_v1_0<dmrp_descriptor>(theirs.struct_size))
    throw std::runtime_error("has a descriptor that is shorter than v1.0's");
  const dmrp_descriptor c = copy_struct(theirs);
  refuse_reserved(c.reserved, "the descriptor of '" + escaped(c.id) + "'");
  PluginInfo out;
  out.id = text_of(c.id);
  out.kind = c.kind;
  out.name = escaped(c.name);
  out.version = escaped(c.version);
  out.vendor = escaped(c.vendor);
  out.license = escaped(c.license);
  out.url = escaped(c.url);
  out.manual_url = escaped(c.manual_url);
  out.summary = escaped(c.summary);
  out.source = escaped(c.source);
  for (const char* const* word = c.features; word && *word; ++word) out.features.push_back(escaped(*word));
  out.needs = escaped_texts(c.needed, c.needed_count);
  out.uses = escaped_texts(c.uses, c.uses_count);
  out.parameters = copy_all(c.params, c.param_count, c.param_stride, "parameters", copy_parameter);
  out.flags = c.flags;
  copy_traits(c, out);
  return out;
}

}  // namespace dmrp::host
