// SPDX-License-Identifier: MIT
// answer_text.hpp: an answer in words, for the terminal and the report.
#pragma once

#include <string>
#include <vector>

#include "host/ranking/answer.hpp"
#include "host/ranking/failure_causes.hpp"

namespace dmrp::host {

// "One task, 20 crowds (the same starts and goals in every trial)": what the answer is about.
std::string answer_heading(const Answer& answer);

// The best, the worst, why the worst fail, and what the trials cannot tell: one sentence each. `failures`: of all
// combinations of the run.
std::vector<std::string> answer_lines(const Answer& answer, std::span<const CombinationFailures> failures);

// "safe success 0.25 lower", "0.31 s/m slower": against the first.
std::string difference_words(const Answer& answer, const RankedCombination& one, std::size_t criterion);

}  // namespace dmrp::host
