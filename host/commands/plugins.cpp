// SPDX-License-Identifier: MIT
#include <dmrp/robot_event.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "host/commands/command.hpp"
#include "host/commands/command_output.hpp"
#include "host/errors/input_error.hpp"
#include "host/guests/probe.hpp"
#include "host/plugins/library.hpp"
#include "host/plugins/parameter_text.hpp"
#include "host/plugins/plugin_info.hpp"
#include "host/plugins/python_file.hpp"
#include "host/toml/nearest_name.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

using Json = nlohmann::ordered_json;
using BitNames = std::vector<std::pair<std::uint32_t, const char*>>;

struct PluginsOptions {
  std::vector<std::string> names;  // of libraries and plugins; empty: all plugins of the plugin path
  std::string kind;                // empty: all
  bool json = false;
};

constexpr std::array kinds{DMRP_KIND_GLOBAL_PLANNER, DMRP_KIND_LOCAL_CONTROLLER, DMRP_KIND_PEDESTRIAN_MODEL,
                           DMRP_KIND_METRIC};
constexpr std::array kind_words{"planner", "controller", "pedestrian_model", "metric"};

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
          {"curve", spec.curve},
          {"minimum", bound(spec.minimum)},
          {"maximum", bound(spec.maximum)}};
}

Json connectivity_name(std::uint32_t connectivity) {
  if (connectivity == DMRP_CONNECTIVITY_NONE) return nullptr;
  return connectivity == DMRP_CONNECTIVITY_ANY ? "any" : std::to_string(connectivity);
}

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

// "0 to 1", ">= 0", "one of a, b"; empty without limits.
std::string parameter_range(const ParameterSpec& spec) {
  if (!spec.choices.empty()) return fmt::format("one of {}", fmt::join(spec.choices, ", "));
  const bool low = std::isfinite(spec.minimum);
  const bool high = std::isfinite(spec.maximum);
  if (low && high) return fmt::format("{} to {}", spec.minimum, spec.maximum);
  if (low) return fmt::format(">= {}", spec.minimum);
  if (high) return fmt::format("<= {}", spec.maximum);
  return "";
}

void print_plugin(const PluginInfo& info) {
  fmt::print("  {}  {} {}  ({})\n", info.id, info.name, info.version, kind_name(info.kind));
  if (!info.summary.empty()) fmt::print("      {}\n", info.summary);
  if (!info.source.empty()) fmt::print("      source: {}\n", info.source);
  if (!info.url.empty()) fmt::print("      url: {}\n", info.url);
  if (!info.manual_url.empty()) fmt::print("      manual: {}\n", info.manual_url);
  if (!info.features.empty()) fmt::print("      features: {}\n", fmt::join(info.features, ", "));
  if (!info.needs.empty()) fmt::print("      needs: {}\n", fmt::join(info.needs, ", "));
  if (!info.uses.empty()) fmt::print("      uses: {}\n", fmt::join(info.uses, ", "));
  for (const MetricValueSpec& value : info.values)
    fmt::print("      gives {:<24} {:<5} {}\n", value.name, value.unit, value.description);
  std::size_t key_width = 0;
  for (const ParameterSpec& spec : info.parameters) key_width = std::max(key_width, spec.fallback.key.size());
  for (const ParameterSpec& spec : info.parameters) {
    const std::string range = parameter_range(spec);
    fmt::print("      {:<{}}  {} = {}{}{}  {}\n", spec.fallback.key, key_width, parameter_type_name(spec.fallback.type),
               toml_text(spec.fallback), spec.unit.empty() || spec.unit == "1" ? "" : " " + spec.unit,
               range.empty() ? "" : " [" + range + "]", spec.doc);
  }
}

struct ListedLibrary {
  fs::path file;
  std::vector<PluginInfo> plugins;
};

ListedLibrary probed(const fs::path& file) {
  Probe probe;
  try {
    probe = probe_library(file);
  } catch (const std::runtime_error& error) {
    throw InputError(file.string() + ": " + error.what());
  }
  if (!probe.init_error.empty()) probe.warnings.push_back(probe.init_error);
  for (const std::string& warning : probe.warnings) warn(file.string() + ": " + warning);
  return {file, std::move(probe.plugins)};
}

bool is_library(const std::string& name) {
  return name.find('/') != std::string::npos || fs::path(name).extension() == ".so" || is_python_file(name);
}

// "mine" of "org.example.mine".
std::string short_name(const PluginInfo& info) {
  return info.id.substr(info.id.rfind('.') + 1);
}

// The plugin of this id, or short name; of several with the same short name, all.
ListedLibrary named(const std::string& name, const std::vector<ListedLibrary>& libraries) {
  ListedLibrary found;
  std::vector<std::string> known;
  for (const ListedLibrary& library : libraries)
    for (const PluginInfo& info : library.plugins) {
      known.push_back(short_name(info));
      if (info.id != name && short_name(info) != name) continue;
      found.file = library.file;
      found.plugins.push_back(info);
    }
  if (found.plugins.empty()) throw InputError(fmt::format("no plugin '{}'{}", name, did_you_mean(name, known)));
  return found;
}

// Prints a line a plugin, by kind.
void print_short(const std::vector<ListedLibrary>& libraries) {
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    std::vector<const PluginInfo*> of_kind;
    for (const ListedLibrary& library : libraries)
      for (const PluginInfo& info : library.plugins)
        if (info.kind == kinds[i]) of_kind.push_back(&info);
    if (of_kind.empty()) continue;
    std::size_t width = 0;
    for (const PluginInfo* info : of_kind) width = std::max(width, info->id.size());
    fmt::print("{}s\n", kind_words[i]);
    for (const PluginInfo* info : of_kind) fmt::print("  {:<{}}  {}\n", info->id, width, info->summary);
  }
  fmt::print("\n`dmrp-host plugins NAME` prints one with its parameters and values, as in `dmrp-host plugins {}`.\n",
             short_name(libraries.front().plugins.front()));
}

void print_json(const std::vector<ListedLibrary>& libraries) {
  Json all = Json::array();
  for (const ListedLibrary& library : libraries) {
    Json plugins = Json::array();
    for (const PluginInfo& info : library.plugins) plugins.push_back(plugin_as_json(info));
    all.push_back({{"library", library.file.string()}, {"plugins", std::move(plugins)}});
  }
  fmt::print("{}\n", all.dump(2));
}

int plugins_command(const PluginsOptions& options) {
  std::vector<ListedLibrary> listed;
  std::vector<ListedLibrary> of_path;  // where names of plugins are looked up
  if (options.names.empty() || !std::all_of(options.names.begin(), options.names.end(), is_library))
    for (const fs::path& file : libraries_of_plugin_path()) of_path.push_back(probed(file));
  for (const std::string& name : options.names)
    listed.push_back(is_library(name) ? probed(library_to_open(name)) : named(name, of_path));
  if (options.names.empty()) listed = of_path;
  if (!options.kind.empty()) {
    const auto index = std::find(kind_words.begin(), kind_words.end(), options.kind) - kind_words.begin();
    for (ListedLibrary& library : listed)
      std::erase_if(library.plugins, [&](const PluginInfo& info) { return info.kind != kinds[index]; });
  }
  if (options.names.empty() || !options.kind.empty()) {
    std::erase_if(listed, [](const ListedLibrary& library) { return library.plugins.empty(); });
    if (listed.empty() && !options.names.empty())
      throw InputError(fmt::format("--kind: {} is no {}", fmt::join(options.names, ", "), options.kind));
  }
  if (options.json) {
    print_json(listed);
  } else if (options.names.empty()) {
    if (!listed.empty()) print_short(listed);
  } else {
    for (const ListedLibrary& library : listed) {
      fmt::print("{}\n", library.file.string());
      for (const PluginInfo& info : library.plugins) print_plugin(info);
    }
  }
  return exit_status::done;
}

}  // namespace

void add_plugins(CLI::App& app) {
  const auto options = std::make_shared<PluginsOptions>();
  CLI::App* command = app.add_subcommand("plugins", "list plugins, or print one with its parameters");
  command->add_option("names", options->names, "plugins, as in dwa, or libraries: with their parameters")
      ->type_name("NAME|LIB.so");
  command->add_option("--kind", options->kind, "only plugins of this kind")
      ->check(CLI::IsMember(std::vector<std::string>(kind_words.begin(), kind_words.end())))
      ->type_name("KIND");
  command->add_flag("--json", options->json, "print JSON");
  finish_command(command, "dmrp-host plugins dwa", [options] { return plugins_command(*options); });
}

}  // namespace dmrp::host
