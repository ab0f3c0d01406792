// SPDX-License-Identifier: MIT
// The plugin library of the RiMEA tests' metrics. It depends only on the SDK.
#include <stdexcept>

#include "tests/rimea/metrics/bottleneck.hpp"
#include "tests/rimea/metrics/counter_flow.hpp"
#include "tests/rimea/metrics/describe_rimea.hpp"
#include "tests/rimea/metrics/evacuation.hpp"
#include "tests/rimea/metrics/fundamental_diagram.hpp"
#include "tests/rimea/metrics/solidity.hpp"
#include "tests/rimea/metrics/travel_time.hpp"

namespace dmrp::rimea {

toolkit::Rectangle rectangle_of(const std::vector<double>& lower_m, const std::vector<double>& upper_m) {
  if (lower_m.size() != 2 || upper_m.size() != 2 || !(lower_m[0] < upper_m[0]) || !(lower_m[1] < upper_m[1]))
    throw std::invalid_argument("an area needs two corners [x, y], the lower left one first");
  return {{lower_m[0], lower_m[1]}, {upper_m[0], upper_m[1]}};
}

}  // namespace dmrp::rimea

DMRP_PLUGINS(dmrp::rimea::TravelTime, dmrp::rimea::Evacuation, dmrp::rimea::FundamentalDiagram, dmrp::rimea::Solidity,
             dmrp::rimea::Bottleneck, dmrp::rimea::CounterFlow)
