// SPDX-License-Identifier: MIT
// colors.hpp: colours of messages, where the terminal has them.
#pragma once

#include <string>
#include <string_view>

namespace dmrp::host {

enum class TextColor { plain, bold, red, green, yellow };

// Whether what is written there may have colours: it is a terminal that is not "dumb", and NO_COLOR is not set
// (https://no-color.org).
bool has_colors(int descriptor);

// The same for a terminal with these values of the variables TERM and NO_COLOR; nullptr: not set.
bool allows_colors(const char* term, const char* no_color);

// The text between its escape sequences; unchanged if `colors` is false.
std::string colored(std::string_view text, TextColor color, bool colors);

}  // namespace dmrp::host
