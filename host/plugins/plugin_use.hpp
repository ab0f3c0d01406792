// SPDX-License-Identifier: MIT
// plugin_use.hpp: the libraries and plugins that an experiment uses, with the values of their parameters.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/plugins/plugin_info.hpp"
#include "host/toml/swept_value.hpp"

namespace dmrp::host {

// Files and folders.
using VisiblePaths = std::vector<std::filesystem::path>;

// A library that the experiment names.
struct LibraryUse {
  std::string written;         // as in the file
  std::filesystem::path file;  // absolute
  std::vector<PluginInfo> plugins;
  std::vector<std::string> objects{};  // shared objects that are loaded with it
  VisiblePaths visible{};              // what its plugins see besides its files (host/process/view.hpp); absolute
  std::vector<std::string> runtime{};  // of a Python file: versions of Python and its packages

  // Whether one of its plugins has it.
  bool has_flag(std::uint32_t flag) const {
    return std::any_of(plugins.begin(), plugins.end(), [&](const PluginInfo& info) { return info.has_flag(flag); });
  }
};

// A controller that an experiment names as a bound of what is possible (host/ranking/bounds.hpp).
enum class Bound { none, lower, upper };

// Where the plans of a planner's use are read, in place of a plugin that makes them.
struct PlanFiles {
  static constexpr const char* placeholder = "{repetition}";

  std::filesystem::path name;                                      // absolute; its last part may have the placeholder
  std::map<std::uint32_t, std::filesystem::path> by_repetition{};  // of a name with it: those that exist

  bool is_given() const { return !name.empty(); }
  bool is_one_each() const { return name.filename().string().find(placeholder) != std::string::npos; }

  // Empty if there is none.
  std::filesystem::path of(std::uint32_t repetition) const {
    if (!is_one_each()) return name;
    const auto found = by_repetition.find(repetition);
    return found == by_repetition.end() ? std::filesystem::path() : found->second;
  }
  VisiblePaths all() const {
    if (!is_one_each()) return {name};
    VisiblePaths files;
    for (const auto& [repetition, file] : by_repetition) files.push_back(file);
    return files;
  }
};

// A plugin as the experiment uses it.
struct PluginUse {
  std::uint32_t library = 0;  // index into Experiment::libraries
  PluginInfo info;            // of plans from files: the name as written in place of an id, and the connectivity
  std::string label;          // shown in results; unique among the uses of its kind
  std::vector<ParameterValue> parameters;            // complete, in the declared order; paths absolute
  std::filesystem::path parameter_file{};            // the source of some of them; absolute, empty if there is none
  std::optional<std::int64_t> control_latency_ns{};  // of a controller: in place of [simulation]'s
  Bound bound = Bound::none;                         // of a controller
  std::vector<SweptValue> swept{};                   // parameters that `sweep` lists
  PlanFiles plans{};                                 // of a planner: then there is no plugin, nor a library
};

}  // namespace dmrp::host
