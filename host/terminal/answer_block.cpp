// SPDX-License-Identifier: MIT
#include "host/terminal/answer_block.hpp"

#include <sstream>

#include "host/ranking/answer_text.hpp"
#include "host/terminal/display_width.hpp"

namespace dmrp::host {
namespace {

std::string wrapped(const std::string& text, std::size_t width, const std::string& indent) {
  std::string lines;
  std::string line = indent;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (width > 0 && line != indent && display_width(line) + 1 + display_width(word) > width) {
      lines += line + "\n";
      line = indent + "  ";
    } else if (line.find_first_not_of(' ') != std::string::npos) {
      line += " ";
    }
    line += word;
  }
  return lines + line + "\n";
}

}  // namespace

std::string answer_block(const Answer& answer, std::span<const CombinationFailures> failures, std::size_t width) {
  std::string block = wrapped(answer_heading(answer) + ":", width, "  ");
  for (const std::string& line : answer_lines(answer, failures)) block += wrapped(line, width, "    ");
  return block;
}

}  // namespace dmrp::host
