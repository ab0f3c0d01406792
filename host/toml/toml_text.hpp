// SPDX-License-Identifier: MIT
// toml_text.hpp: values as TOML writes them, so that they read back as the same.
#pragma once

#include <string>
#include <vector>

namespace dmrp::host {

std::string toml_text(const std::string& text);  // quoted and escaped
std::string toml_text(double value);             // the shortest that reads back as the same float
std::string toml_text(const std::vector<std::string>& texts);
std::string toml_text(const std::vector<double>& values);

}  // namespace dmrp::host
