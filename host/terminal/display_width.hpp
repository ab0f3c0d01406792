// SPDX-License-Identifier: MIT
// display_width.hpp: the number of terminal columns of a text.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace dmrp::host {

// The width of UTF-8 text without control characters, by the C library's wcwidth: combining marks take no column, East
// Asian wide characters and emoji take two. Does not depend on the process's locale and does not change it.
std::size_t display_width(std::string_view text);

// The text padded with spaces on the right or left to at least `width` columns.
std::string pad_right(std::string_view text, std::size_t width);
std::string pad_left(std::string_view text, std::size_t width);

}  // namespace dmrp::host
