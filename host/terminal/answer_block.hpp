// SPDX-License-Identifier: MIT
// answer_block.hpp: which combination is better, below the table at the end of a run.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "host/ranking/answer.hpp"
#include "host/ranking/failure_causes.hpp"

namespace dmrp::host {

// The answer's heading and sentences (answer_text.hpp), indented and wrapped at `width` columns (0: not wrapped).
std::string answer_block(const Answer& answer, std::span<const CombinationFailures> failures, std::size_t width);

}  // namespace dmrp::host
