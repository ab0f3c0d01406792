// SPDX-License-Identifier: MIT
// examples.hpp: statistics of fixed values, for comparison with another implementation (check_scipy.py has the same).
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace dmrp::bench {

std::vector<std::pair<std::string, double>> examples();

}  // namespace dmrp::bench
