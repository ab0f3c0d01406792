// SPDX-License-Identifier: MIT
#include <vector>

#include "host/check/check_case.hpp"

namespace dmrp::host {

std::span<const CheckCase> check_cases() {
  static const std::vector<CheckCase> cases = [] {
    std::vector<CheckCase> all;
    for (const auto group : {load_check_cases(), descriptor_check_cases(), parameter_check_cases(), trial_check_cases(),
                             step_check_cases(), call_check_cases(), other_check_cases()})
      all.insert(all.end(), group.begin(), group.end());
    return all;
  }();
  return cases;
}

}  // namespace dmrp::host
