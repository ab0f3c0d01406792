// SPDX-License-Identifier: MIT
#include "host/terminal/arrivals_by_type.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/host/results/results_example.hpp"

using namespace dmrp::host;
using dmrp::test::example_layout;
using dmrp::test::example_trial;
using dmrp::test::two_planners;

TEST_CASE("arrivals are counted by type of robot where there are several", "[terminal]") {
  const SummaryLayout layout = example_layout();
  std::vector<TrialRecord> trials = two_planners();
  trials[3] = example_trial(3, "A*", 1, std::nullopt, 0.61);  // the second robot failed
  CHECK(arrivals_by_type(layout, {{{"mall", 2}, {"", "tug"}}}, trials) == "default 4 of 4 · tug 3 of 4");
  CHECK(arrivals_by_type(layout, {{{"mall", 2}, {"tug", ""}}}, trials) == "tug 4 of 4 · default 3 of 4");
  CHECK(arrivals_by_type(layout, {{{"mall", 2}, {"", ""}}}, trials).empty());
  CHECK(arrivals_by_type(layout, {}, trials).empty());
  for (TrialRecord& trial : trials) trial.values.clear();
  CHECK(arrivals_by_type(layout, {{{"mall", 2}, {"", "tug"}}}, trials).empty());
}
