// SPDX-License-Identifier: MIT
#include "host/files/text_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host/errors/input_error.hpp"

namespace dmrp::host {

TextLines::TextLines(std::string text, std::string shown_path)
    : shown_path_(std::move(shown_path)), text_(std::move(text)) {
  for (std::string_view rest = text_; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines_.push_back(line);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
}

void TextLines::fail(std::size_t line, std::size_t column, const std::string& text) const {
  throw InputError(fmt::format("{}:{}:{}: {}", shown_path_, line, column, text),
                   {shown_path_, line, column, std::string(this->line(line))});
}

}  // namespace dmrp::host
