// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/commands/command.hpp"
#include "host/commands/command_output.hpp"
#include "host/commands/plugins_json.hpp"
#include "host/commands/plugins_markdown.hpp"
#include "host/errors/input_error.hpp"
#include "host/guests/probe.hpp"
#include "host/plugins/library.hpp"
#include "host/plugins/parameter_text.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

struct PluginsOptions {
  std::vector<std::string> libraries;  // empty: all libraries of the plugin path
  bool json = false;
  bool markdown = false;
};

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

int plugins_command(const PluginsOptions& options) {
  std::vector<fs::path> files;
  for (const std::string& name : options.libraries) files.push_back(library_to_open(name));
  if (files.empty()) files = libraries_of_plugin_path();

  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const fs::path& file : files) {
    Probe probe;
    try {
      probe = probe_library(file);
    } catch (const std::runtime_error& error) {
      throw InputError(file.string() + ": " + error.what());
    }
    if (!probe.init_error.empty()) probe.warnings.push_back(probe.init_error);
    for (const std::string& warning : probe.warnings) warn(file.string() + ": " + warning);
    if (options.json) {
      nlohmann::ordered_json plugins = nlohmann::ordered_json::array();
      for (const PluginInfo& info : probe.plugins) plugins.push_back(plugin_as_json(info));
      all.push_back({{"library", file.string()}, {"plugins", std::move(plugins)}});
      continue;
    }
    if (options.markdown) {
      fmt::print("{}", plugins_markdown(file.filename().string(), probe.plugins));
      continue;
    }
    fmt::print("{}\n", file.string());
    for (const PluginInfo& info : probe.plugins) print_plugin(info);
  }
  if (options.json) fmt::print("{}\n", all.dump(2));
  return exit_status::done;
}

}  // namespace

void add_plugins(CLI::App& app) {
  const auto options = std::make_shared<PluginsOptions>();
  CLI::App* command = app.add_subcommand("plugins", "list the plugins of libraries, with their parameters");
  command->add_option("libraries", options->libraries, "libraries (default: all libraries of the plugin path)")
      ->type_name("LIB.so");
  CLI::Option* json = command->add_flag("--json", options->json, "print JSON");
  command->add_flag("--markdown", options->markdown, "print a reference page in Markdown")->excludes(json);
  finish_command(command, "dmrp-host plugins libdmrp_planners.so", [options] { return plugins_command(*options); });
}

}  // namespace dmrp::host
