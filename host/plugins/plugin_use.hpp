// SPDX-License-Identifier: MIT
// plugin_use.hpp: the libraries and plugins that an experiment uses, with the values of their parameters.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
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

// A plugin as the experiment uses it.
struct PluginUse {
  std::uint32_t library = 0;  // index into Experiment::libraries
  PluginInfo info;
  std::string label;                                 // shown in results; unique among the uses of its kind
  std::vector<ParameterValue> parameters;            // complete, in the declared order; paths absolute
  std::filesystem::path parameter_file{};            // the source of some of them; absolute, empty if there is none
  std::optional<std::int64_t> control_latency_ns{};  // of a controller: in place of [simulation]'s
  Bound bound = Bound::none;                         // of a controller
  std::vector<SweptValue> swept{};                   // parameters that `sweep` lists
};

}  // namespace dmrp::host
