// SPDX-License-Identifier: MIT
// read_parameters.hpp: reads a plugin's parameters from the experiment file and checks them against its declared table.
#pragma once

#include <string>
#include <vector>

#include "host/experiment/experiment.hpp"
#include "host/toml/swept_value.hpp"
#include "host/toml/toml_document.hpp"

namespace dmrp::host {

// One complete table of values.
struct ParameterVariant {
  std::vector<ParameterValue> values;
  std::vector<SweptValue> swept{};  // the difference from the other variants of a sweep
};

// The absolute path of a parameter file: relative to `base`, or a shipped one ("controllers/tuned/dwa.toml"). Empty if
// there is none.
std::filesystem::path parameter_set(const std::string& name, const std::filesystem::path& base);
std::vector<std::string> shipped_parameter_sets();

// The name of the shipped set that a parameter file belongs to: "tuned" of "controllers/tuned/dwa.toml". Empty for files
// that are not shipped.
std::string shipped_set_of(const std::filesystem::path& file);

// The parameter file of the key `params_file` of a plugin's table; empty without that key. Throws InputError.
std::filesystem::path find_parameter_file(const TomlTable& use, const std::filesystem::path& base);

// Reads the values of `file` (lines of key = value; empty: none), overridden by `params` and then by `sweep` of a
// plugin's table. Returns one variant without a sweep, otherwise the product of the swept values. Paths are relative to
// `base`, those in `file` to its folder. Throws InputError.
std::vector<ParameterVariant> read_parameters(const TomlTable& use, const PluginInfo& info,
                                              const std::filesystem::path& base, const std::filesystem::path& file);

}  // namespace dmrp::host
