// SPDX-License-Identifier: MIT
// escaped_text.hpp: text of plugins for terminals and files: valid UTF-8 without control characters.
#pragma once

#include <string>
#include <string_view>

namespace dmrp::host {

// `text`, at most 4,000 bytes of it, with control characters as \n, \t or \x1b and bytes that are no UTF-8 as \xff.
// NULL is empty.
std::string escaped(const char* text);

// Whether nothing of it needs to be escaped.
bool is_plain(std::string_view text);

}  // namespace dmrp::host
