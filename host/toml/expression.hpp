// SPDX-License-Identifier: MIT
// expression.hpp: numbers that a file gives as a formula of its level: "5 - level / 2".
#pragma once

#include <string_view>

namespace dmrp::host {

// Numbers, `level`, pi, + - * /, parentheses, and sin, cos, sqrt, floor, round of an argument. Throws
// std::invalid_argument with what is wrong.
double evaluate_expression(std::string_view text, double level);

}  // namespace dmrp::host
