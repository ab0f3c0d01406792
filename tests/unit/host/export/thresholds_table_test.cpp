// SPDX-License-Identifier: MIT
#include "host/export/thresholds_table.hpp"

#include <catch2/catch.hpp>

namespace thresholds_table_test {

using namespace dmrp::host;
using Catch::Matchers::Contains;
using dmrp::core::Threshold;

GradedResult passing(const std::string& controller, Threshold threshold, Threshold low, Threshold high) {
  GradedResult result;
  result.global_planner = "P";
  result.local_controller = controller;
  result.estimate = {threshold, low, high};
  return result;
}

TEST_CASE("a threshold is a level, or infinite on the side of the levels that it lies on", "[export]") {
  const Threshold hardest = {0.6, true, false};
  const Threshold easiest = {0.8, false, true};
  const GradedSeries door = {
      "door",          "Door",
      "width",         "m",
      false,           {0.6, 0.7, 0.8},
      {"a", "b", "c"}, {passing("one", {0.65}, hardest, {0.7}), passing("two", easiest, {0.75}, easiest)}};
  const std::string narrow = thresholds_table_csv(std::vector{door});
  CHECK_THAT(narrow, Contains("door,Door,width,m,lower,0.6 0.7 0.8,P,one,,0.65,-inf,0.7,\"0.65 [≤ 0.6, 0.7] m\"\n"));
  CHECK_THAT(narrow, Contains(",two,,inf,0.75,inf,"));

  GradedSeries crowd = {"crowd", "Crowd", "people", "1", true, {3.0, 1.0}, {"a", "b"}, {}};
  crowd.results = {passing("one", {3.0, true, false}, {3.0, true, false}, {2.0})};
  CHECK_THAT(thresholds_table_csv(std::vector{crowd}), Contains("higher,3 1,P,one,,inf,2,inf,"));
}

}  // namespace thresholds_table_test
