// SPDX-License-Identifier: MIT
// betting.hpp: what can be said of the mean of bounded values, whatever else their distribution: by bets against a mean
// that would pay if it were wrong (Waudby-Smith and Ramdas: Estimating means of bounded random variables by betting,
// JRSS B 86, 2024).
#pragma once

#include <span>

#include "core/statistics/descriptive.hpp"

namespace dmrp::core {

// Values are independent and lie in [0, 1]; they need not be equally distributed: then their mean is that of their
// expectations. The level holds for any number of values. It does not depend on their order. Undefined without values.

// 95 % of the mean; always within [0, 1], closed.
Interval betting_interval(std::span<const double> values);

}  // namespace dmrp::core
