// SPDX-License-Identifier: MIT
#include "host/terminal/answer_block.hpp"

#include "host/ranking/answer_text.hpp"
#include "host/terminal/wrapped_text.hpp"

namespace dmrp::host {

std::string answer_block(const Answer& answer, std::span<const CombinationFailures> failures, std::size_t width) {
  std::string block = wrapped_text(answer_heading(answer) + ":", width, "  ");
  for (const std::string& line : answer_lines(answer, failures)) block += wrapped_text(line, width, "    ");
  return block;
}

}  // namespace dmrp::host
