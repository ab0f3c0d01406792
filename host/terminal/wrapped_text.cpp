// SPDX-License-Identifier: MIT
#include "host/terminal/wrapped_text.hpp"

#include <sstream>

#include "host/terminal/display_width.hpp"

namespace dmrp::host {

std::string wrapped_text(const std::string& text, std::size_t width, const std::string& indent) {
  std::string lines;
  std::string line = indent;
  bool begun = false;
  std::istringstream words(text);
  for (std::string word; words >> word; begun = true) {
    if (begun && width > 0 && display_width(line) + 1 + display_width(word) > width) {
      lines += line + "\n";
      line = indent + "  ";
      begun = false;
    }
    line += (begun ? " " : "") + word;
  }
  return lines + line + "\n";
}

}  // namespace dmrp::host
