// SPDX-License-Identifier: MIT
// wrapped_text.hpp: sentences in lines of a terminal.
#pragma once

#include <cstddef>
#include <string>

namespace dmrp::host {

// Between parts of a line.
inline constexpr const char* separator = " · ";

// Lines of at most `width` columns where words allow it (0: one line), each with the indent and a line end; lines after
// the first are indented by two more columns.
std::string wrapped_text(const std::string& text, std::size_t width, const std::string& indent);

}  // namespace dmrp::host
