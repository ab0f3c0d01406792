// SPDX-License-Identifier: MIT
// nearest_name.hpp: suggestions for mistyped names. Written by hand: no library of the project offers an
// edit distance.
#pragma once

#include <string>
#include <vector>

namespace dmrp::host {

// The only known name that ends with what was written behind a point, in whatever case; else the one with the least edit
// distance, if that is small enough; "" otherwise.
std::string nearest_name(const std::string& written, const std::vector<std::string>& known);

// " (did you mean 'x'?)" or "".
std::string did_you_mean(const std::string& written, const std::vector<std::string>& known);

// " (did you mean 'b'? there: a, b, c)", or without the question.
std::string among(const std::string& written, const std::vector<std::string>& known);

// "a, b, c"; "none" if there are none.
std::string join_names(const std::vector<std::string>& names);

}  // namespace dmrp::host
