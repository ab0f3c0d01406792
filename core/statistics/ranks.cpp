// SPDX-License-Identifier: MIT
#include "core/statistics/ranks.hpp"

#include <algorithm>
#include <numeric>

namespace dmrp::core {

std::vector<std::int64_t> doubled_midranks(std::span<const double> values, double tolerance) {
  std::vector<std::size_t> ascending(values.size());
  std::iota(ascending.begin(), ascending.end(), std::size_t{0});
  std::sort(ascending.begin(), ascending.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<std::int64_t> ranks(values.size());
  for (std::size_t begin = 0; begin < ascending.size();) {
    std::size_t end = begin + 1;
    while (end < ascending.size() && values[ascending[end]] - values[ascending[begin]] <= tolerance) ++end;
    for (std::size_t i = begin; i < end; ++i) ranks[ascending[i]] = static_cast<std::int64_t>(begin + 1 + end);
    begin = end;
  }
  return ranks;
}

}  // namespace dmrp::core
