// SPDX-License-Identifier: MIT
#include "core/statistics/holm.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace dmrp::core {

std::vector<double> holm_adjusted(std::span<const double> p_values) {
  assert(std::none_of(p_values.begin(), p_values.end(), [](double p) { return p < 0.0 || p > 1.0; }));
  std::vector<std::size_t> ascending;
  for (std::size_t i = 0; i < p_values.size(); ++i)
    if (!std::isnan(p_values[i])) ascending.push_back(i);
  std::stable_sort(ascending.begin(), ascending.end(),
                   [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
  std::vector<double> adjusted(p_values.begin(), p_values.end());
  double largest = 0.0;
  for (std::size_t k = 0; k < ascending.size(); ++k) {
    const double scaled = static_cast<double>(ascending.size() - k) * p_values[ascending[k]];
    largest = std::max(largest, std::min(1.0, scaled));
    adjusted[ascending[k]] = largest;
  }
  return adjusted;
}

}  // namespace dmrp::core
