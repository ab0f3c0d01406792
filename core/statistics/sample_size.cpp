// SPDX-License-Identifier: MIT
#include "core/statistics/sample_size.hpp"

#include <boost/math/distributions/normal.hpp>
#include <cassert>
#include <cmath>

namespace dmrp::core {

std::optional<std::uint64_t> pairs_needed(double sd, double difference, double level) {
  assert(difference > 0.0 && level > 0.0 && level < 1.0);
  if (!(sd > 0.0)) return std::nullopt;
  constexpr double power = 0.8;
  const boost::math::normal standard;
  const double z_level = boost::math::quantile(standard, 1.0 - level / 2.0);
  const double z_power = boost::math::quantile(standard, power);
  const double ratio = (z_level + z_power) * sd / difference;
  return static_cast<std::uint64_t>(std::ceil(ratio * ratio + z_level * z_level / 2.0));
}

}  // namespace dmrp::core
