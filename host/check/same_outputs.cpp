// SPDX-License-Identifier: MIT
#include "host/check/same_outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace dmrp::host {

namespace {

// The first difference of the outputs, to the bit; "" if there is none.
std::string difference(const Outputs& outputs, const Outputs& expected) {
  for (std::size_t i = 0; i < std::min(outputs.size(), expected.size()); ++i)
    if (std::memcmp(&outputs[i], &expected[i], sizeof(double)) != 0)
      return fmt::format("number {} of {} that it gives is {} instead of {}", i + 1, expected.size(), outputs[i],
                         expected[i]);
  if (outputs.size() != expected.size())
    return fmt::format("gives {} numbers instead of {}", outputs.size(), expected.size());
  return "";
}

}  // namespace

void expect_same(Examination& it, const Outputs& outputs, const Outputs& expected) {
  if (const auto timing = it.guard().timing(); !timing.empty())
    throw Skipped{"it says that its results depend on timing: " + timing.front().text};
  if (const std::string text = difference(outputs, expected); !text.empty()) it.fail(text);
}

Outputs alone(Examination& it, std::uint64_t seed) {
  const auto instance = it.create();
  return rehearse(*instance, it.plugin(), {}, seed);
}

}  // namespace dmrp::host
