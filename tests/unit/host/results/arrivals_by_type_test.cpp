// SPDX-License-Identifier: MIT
#include "host/results/arrivals_by_type.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/host/results/results_example.hpp"

namespace arrivals_by_type_test {

using namespace dmrp::host;
using dmrp::test::example_layout;
using dmrp::test::example_trial;
using dmrp::test::two_planners;

std::vector<ScenarioFacts> mall_of(const std::vector<std::string>& types) {
  ScenarioFacts mall;
  mall.name = "mall";
  mall.robots = 2;
  mall.robot_types = types;
  return {mall};
}

TEST_CASE("arrivals are counted by type of robot where there are several", "[results]") {
  const std::string arrived = example_layout().arrived;
  std::vector<TrialRecord> trials = two_planners();
  trials[3] = example_trial(3, "A*", 1, std::nullopt, 0.61);  // the second robot failed
  CHECK(arrivals_line(arrived, mall_of({"default", "tug"}), trials) == "default 4 of 4 · tug 3 of 4");
  CHECK(arrivals_line(arrived, mall_of({"tug", "default"}), trials) == "tug 4 of 4 · default 3 of 4");
  CHECK(arrivals_line(arrived, mall_of({"default", "default"}), trials).empty());
  CHECK(arrivals_line(arrived, mall_of({}), trials).empty());
  CHECK(arrivals_line(arrived, {}, trials).empty());
  std::vector<ScenarioFacts> twins = mall_of({"default", "tug"});
  twins.push_back(mall_of({"tug", "tug"}).front());
  CHECK(arrivals_line(arrived, twins, trials).empty());
  for (TrialRecord& trial : trials) trial.values.clear();
  CHECK(arrivals_line(arrived, mall_of({"default", "tug"}), trials).empty());
}

}  // namespace arrivals_by_type_test
