// SPDX-License-Identifier: MIT
#include "host/workers/planned_trials.hpp"

#include <catch2/catch.hpp>

namespace planned_trials_test {

using dmrp::host::PlannedTrials;

std::vector<std::uint64_t> rest_of(PlannedTrials trials) {
  std::vector<std::uint64_t> rest;
  while (const auto trial = trials.next()) rest.push_back(*trial);
  CHECK(trials.left() == 0);
  return rest;
}

TEST_CASE("planned trials are those of the shard that are not finished") {
  using Trials = std::vector<std::uint64_t>;
  CHECK(rest_of({0, 1, 4, {}}) == Trials{0, 1, 2, 3});
  CHECK(rest_of({1, 3, 10, {}}) == Trials{1, 4, 7});
  CHECK(rest_of({0, 1, 5, {0, 1, 4}}) == Trials{2, 3});
  CHECK(rest_of({1, 3, 10, {0, 4, 99}}) == Trials{1, 7});  // those of others do not count
  CHECK(rest_of({0, 1, 3, {0, 1, 2}}).empty());
  CHECK(rest_of({2, 3, 1, {}}).empty());
  CHECK(rest_of(PlannedTrials({5, 2, 9})) == Trials{5, 2, 9});
  CHECK(rest_of(PlannedTrials(Trials{})).empty());
  CHECK(PlannedTrials(1, 3, 10, {4}).all() == 3);
  CHECK(PlannedTrials(1, 3, 10, {4}).left() == 2);
  CHECK(PlannedTrials(0, 1, 1ull << 40, {}).left() == 1ull << 40);  // no list of them
}

}  // namespace planned_trials_test
