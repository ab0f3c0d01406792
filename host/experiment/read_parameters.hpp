// SPDX-License-Identifier: MIT
// read_parameters.hpp: a plugin's parameters from the experiment file, checked against the table that it declares.
#pragma once

#include <string>
#include <vector>

#include "host/experiment/experiment.hpp"
#include "host/toml/toml_document.hpp"

namespace dmrp::host {

// One complete table of values and how it differs from the others of its sweep: "" or "suboptimality 1.2".
struct ParameterVariant {
  std::vector<ParameterValue> values;
  std::string label;
};

// The parameter file of that name, absolute: relative to `base`, else a shipped one, "controllers/tuned/dwa.toml". Empty
// if there is none.
std::filesystem::path parameter_set(const std::string& name, const std::filesystem::path& base);
std::vector<std::string> shipped_parameter_sets();

// The same for the key `params_file` of a plugin's table; empty without that key. Throws InputError.
std::filesystem::path find_parameter_file(const TomlTable& use, const std::filesystem::path& base);

// Reads the values of `file` (lines of key = value; empty: none), over them `params`, over these `sweep` of a plugin's
// table: one variant without a sweep, else the product of the swept values. Paths are resolved against `base`, those of
// `file` against its folder. Throws InputError.
std::vector<ParameterVariant> read_parameters(const TomlTable& use, const PluginInfo& info,
                                              const std::filesystem::path& base, const std::filesystem::path& file);

}  // namespace dmrp::host
