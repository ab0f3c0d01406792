// SPDX-License-Identifier: MIT
// nearest_name.hpp: the known name that somebody probably meant.
#pragma once

#include <string>
#include <vector>

namespace dmrp::host {

// The one with the least edit distance, if it is near enough to be meant; "" otherwise.
std::string nearest_name(const std::string& written, const std::vector<std::string>& known);

// " (did you mean 'x'?)" or "".
std::string did_you_mean(const std::string& written, const std::vector<std::string>& known);

// "a, b, c"; "none" if there are none.
std::string join_names(const std::vector<std::string>& names);

}  // namespace dmrp::host
