// SPDX-License-Identifier: MIT
// The figure of thresholds: a panel a test, a mark a combination, hard levels on the right.
#include "host/export/threshold_chart.hpp"

#include <catch2/catch.hpp>
#include <regex>

namespace threshold_chart_test {

using namespace dmrp::host;
using dmrp::core::Threshold;

GradedResult passing(const std::string& controller, Threshold threshold, Threshold low, Threshold high) {
  GradedResult result;
  result.global_planner = "P";
  result.local_controller = controller;
  result.means = {0.0, 0.4, 1.0};
  result.estimate = {threshold, low, high};
  return result;
}

GradedSeries door(std::vector<GradedResult> results) {
  return {"door", "Door <1>", "width", "m", false, {0.6, 0.7, 0.8}, {"a", "b", "c"}, std::move(results)};
}

// The x of all matches.
std::vector<double> places(const std::string& svg, const std::string& pattern) {
  std::vector<double> found;
  const std::regex expression(pattern);
  for (std::sregex_iterator match(svg.begin(), svg.end(), expression), end; match != end; ++match)
    found.push_back(std::stod((*match)[1]));
  return found;
}

TEST_CASE("thresholds lie between their levels, evenly spaced, hard ones on the right", "[export]") {
  const GradedSeries series = door({passing("one", {0.65}, {0.6}, {0.7}), passing("two", {0.7}, {0.7}, {0.7})});
  const std::string svg = threshold_chart(std::vector{series});
  const std::vector<double> ticks = places(svg, R"x(class="grid" d="M([0-9.]+))x");
  REQUIRE(ticks.size() == 3);
  CHECK(ticks[0] > ticks[1]);  // 0.6 m, the hardest, is on the right
  CHECK(ticks[0] - ticks[1] == Approx(ticks[1] - ticks[2]).margin(0.11));
  const std::vector<double> dots = places(svg, R"x(<circle cx="([0-9.]+))x");
  REQUIRE(dots.size() == 2);
  CHECK(dots[0] == Approx(0.5 * (ticks[0] + ticks[1])).margin(0.11));
  CHECK(dots[1] == Approx(ticks[1]).margin(0.11));
  CHECK(places(svg, R"x(class="interval" d="M([0-9.]+))x").front() == Approx(ticks[0]).margin(0.11));
  CHECK(svg.find("Door &lt;1&gt;") != std::string::npos);
  CHECK(svg.find("one: 0.65 [0.6, 0.7] m") != std::string::npos);
}

TEST_CASE("what lies beyond the levels has a mark of its own at the end", "[export]") {
  const Threshold hardest = {0.6, true, false};
  const Threshold easiest = {0.8, false, true};
  const std::string svg = threshold_chart(
      std::vector{door({passing("best", hardest, hardest, hardest), passing("worst", easiest, easiest, easiest)})});
  CHECK(places(svg, R"x(<circle cx="([0-9.]+))x").empty());
  const std::vector<double> ticks = places(svg, R"x(class="grid" d="M([0-9.]+))x");
  const std::vector<double> triangles = places(svg, R"x(<path stroke="none" d="M([0-9.]+))x");
  const std::vector<double> crosses = places(svg, R"x(<path d="M([0-9.]+))x");
  REQUIRE(triangles.size() == 1);
  REQUIRE(crosses.size() == 1);
  CHECK(triangles[0] > ticks[0]);
  CHECK(crosses[0] < ticks[2]);
}

}  // namespace threshold_chart_test
