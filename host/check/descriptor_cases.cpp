// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "host/check/check_case.hpp"
#include "host/check/examination.hpp"
#include "host/check/rehearsal/rehearsal.hpp"
#include "host/plugins/offered_extensions.hpp"

namespace dmrp::host::descriptor_cases {

namespace {

bool is_like(const std::string& text, const char* pattern) {
  return std::regex_match(text, std::regex(pattern));
}

constexpr std::uint32_t flags_of_all = DMRP_FLAG_PROCESSES | DMRP_FLAG_RESIDENT_MEMORY;
constexpr std::uint32_t flags_of_planners = DMRP_FLAG_UNCOORDINATED | DMRP_FLAG_WINDOWED;
constexpr std::uint32_t flags_of_controllers = DMRP_FLAG_CENTRAL | DMRP_FLAG_BACKWARDS;
constexpr std::uint32_t known_flags = flags_of_all | flags_of_planners | flags_of_controllers;

std::uint32_t flags_for(std::uint32_t kind) {
  if (kind == DMRP_KIND_GLOBAL_PLANNER) return flags_of_all | flags_of_planners;
  return kind == DMRP_KIND_LOCAL_CONTROLLER ? flags_of_all | flags_of_controllers : flags_of_all;
}

bool has_brackets(const std::string& unit) {
  return unit.find_first_of("[](){} ") != std::string::npos;
}

}  // namespace

// Letters and digits in ids are checked when the library is loaded.
void id(Examination& it) {
  if (!is_like(it.plugin().id, "[A-Za-z0-9_-]+(\\.[A-Za-z0-9_-]+)+"))
    it.warn(fmt::format("the id '{}' is not in reverse DNS notation, as org.example.mine", it.plugin().id));
}

void version(Examination& it) {
  if (!is_like(it.plugin().version, "(0|[1-9]\\d*)\\.(0|[1-9]\\d*)\\.(0|[1-9]\\d*)([-+][0-9A-Za-z.+-]+)?"))
    it.warn(fmt::format("the version '{}' is not semantic, as 1.4.0", it.plugin().version));
}

void license(Examination& it) {
  static const std::set<std::string> no_ids = {"GPL",         "LGPL",    "AGPL",    "BSD", "Apache",
                                               "GPLv2",       "GPLv3",   "Apache2", "CC",  "proprietary",
                                               "Proprietary", "unknown", "LGPLv3",  "MPL", "Creative"};
  const std::string& text = it.plugin().license;
  const bool expression = is_like(text, "\\(*[A-Za-z0-9.-]+\\+?\\)*( (AND|OR|WITH) \\(*[A-Za-z0-9.-]+\\+?\\)*)*");
  if (text.empty())
    it.warn("names no licence");
  else if (!expression || no_ids.count(text) > 0)
    it.warn(fmt::format("the licence '{}' is no SPDX expression, as MIT or Apache-2.0", text));
}

void texts(Examination& it) {
  const PluginInfo& info = it.plugin();
  if (info.name.empty()) it.warn("has no name");
  if (info.summary.empty()) it.warn("has no summary");
  for (const std::string* text : {&info.name, &info.summary, &info.vendor, &info.version})
    if (text->find("\\n") != std::string::npos) it.warn(fmt::format("'{}' is more than one line", *text));
}

void parameters(Examination& it) {
  for (const ParameterSpec& spec : it.plugin().parameters) {
    const std::string& key = spec.fallback.key;
    if (spec.doc.empty()) it.warn(fmt::format("the parameter '{}' has no doc", key));
    if (has_brackets(spec.unit))
      it.warn(fmt::format("the parameter '{}' has the unit '{}': write it bare", key, spec.unit));
    if (key.find('-') != std::string::npos)
      it.warn(fmt::format("the key '{}' has characters other than letters, digits and '_'", key));
  }
}

void values(Examination& it) {
  for (const MetricValueSpec& spec : it.plugin().values) {
    if (spec.unit.empty()) it.warn(fmt::format("the value '{}' has no unit (\"1\" for a ratio)", spec.name));
    if (has_brackets(spec.unit))
      it.warn(fmt::format("the value '{}' has the unit '{}': write it bare", spec.name, spec.unit));
    if (spec.description.empty()) it.warn(fmt::format("the value '{}' has no description", spec.name));
    if (spec.direction > DMRP_DIRECTION_HIGHER)
      it.warn(fmt::format("the value '{}' has the unknown direction {}", spec.name, spec.direction));
  }
  if (it.plugin().values.empty()) it.fail("declares no value");
}

void flags(Examination& it) {
  const PluginInfo& info = it.plugin();
  if ((info.flags & ~known_flags) != 0) it.warn(fmt::format("has unknown flags: {:#x}", info.flags & ~known_flags));
  if ((info.flags & known_flags & ~flags_for(info.kind)) != 0)
    it.warn(fmt::format("has flags that mean nothing for a {}: {:#x}", kind_name(info.kind),
                        info.flags & known_flags & ~flags_for(info.kind)));
  if (info.kind != DMRP_KIND_METRIC && !info.values.empty())
    it.warn(fmt::format("declares values, as only a metric does, but is a {}", kind_name(info.kind)));
  if (info.kind != DMRP_KIND_GLOBAL_PLANNER && info.connectivity != DMRP_CONNECTIVITY_NONE)
    it.warn(fmt::format("declares a connectivity, as only a planner does, but is a {}", kind_name(info.kind)));
}

void extensions(Examination& it) {
  if (const std::string missing = missing_extension(it.plugin()); !missing.empty()) it.fail(missing);
  for (const std::string& doubt : doubtful_extensions(it.plugin())) it.warn(doubt);
  for (const std::string& id : it.plugin().needs)
    if (std::count(it.plugin().uses.begin(), it.plugin().uses.end(), id) > 0)
      it.warn(fmt::format("lists {} both as required and as used", id));
}

void is_static(Examination& it) {
  const auto read = [&] {
    const Library& library = it.library();
    for (std::uint32_t i = 0; i < library.plugin_count(); ++i)
      if (const dmrp_descriptor* c = library.descriptor(i); c && c->id && c->id == it.plugin().id)
        return nlohmann::json(copy_descriptor(*c));
    return nlohmann::json();
  };
  const nlohmann::json before = read();
  const auto instance = it.create();
  const Rehearsal started(*instance, it.plugin(), {}, it.seed());
  if (read() != before) it.fail("its descriptor is another after init(), create() and start()");
}

}  // namespace dmrp::host::descriptor_cases

namespace dmrp::host {

std::span<const CheckCase> descriptor_check_cases() {
  static constexpr CheckCase cases[] = {
      {"descriptor/id", for_all, descriptor_cases::id, "descriptor.h: id is reverse DNS",
       "choose an id that begins with a domain of yours, as org.example.mine"},
      {"descriptor/version", for_all, descriptor_cases::version, "descriptor.h: version is semantic",
       "write three numbers, as 1.4.0"},
      {"descriptor/license", for_all, descriptor_cases::license, "descriptor.h: license is an SPDX expression",
       "name the licence as spdx.org/licenses does"},
      {"descriptor/texts", for_all, descriptor_cases::texts, "descriptor.h: name is for display, summary is one line",
       "say in one line what the plugin does"},
      {"descriptor/parameters", for_all, descriptor_cases::parameters,
       "parameter.h: keys are letters, digits and '_'; doc is one line; unit is bare",
       "describe each parameter: users see it in `dmrp-host plugins`"},
      {"descriptor/values", for_metrics, descriptor_cases::values,
       "descriptor.h: a value has a unit, a description and a direction", "describe each value: reports show it"},
      {"descriptor/flags", for_all, descriptor_cases::flags,
       "descriptor.h: flags, values and connectivity belong to kinds of plugin", "leave 0 what is not of this kind"},
      {"descriptor/extensions", for_all, descriptor_cases::extensions,
       "descriptor.h: needed and uses list extensions by id",
       "spell ids as the headers in dmrp/ext do, and require only what this host offers to this kind"},
      {"descriptor/static", for_all, descriptor_cases::is_static, "descriptor.h: static data, readable before init()",
       "do not change it at run time"},
  };
  return cases;
}

}  // namespace dmrp::host
