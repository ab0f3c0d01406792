// SPDX-License-Identifier: MIT
// toml_text.hpp: values as TOML text; reading the text gives the same value. Written by hand: a few lines
// keep toml.hpp, which is slow to compile, out of the files that write TOML.
#pragma once

#include <string>
#include <vector>

namespace dmrp::host {

std::string toml_key(const std::string& name);   // bare if TOML allows it
std::string toml_text(const std::string& text);  // quoted and escaped
std::string toml_text(double value);             // the shortest text of the same double
std::string toml_text(const std::vector<std::string>& texts);
std::string toml_text(const std::vector<double>& values);

}  // namespace dmrp::host
