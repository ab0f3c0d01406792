// SPDX-License-Identifier: MIT
// How the contract grows: spans with the stride of their owner, and the macros that ask for a field.
#include <algorithm>
#include <catch2/catch.hpp>
#include <dmrp/plugin.hpp>
#include <vector>

#include "tests/conformance/calls.hpp"

using namespace dmrp::test;

TEST_CASE("a span walks elements by their owner's stride") {
  std::vector<Longer<dmrp_vec2>> points;
  for (int i = 0; i < 5; ++i) points.push_back({{1.0 * i, 10.0 * i}});
  const dmrp::Span<dmrp_vec2> span(&points.front().known, points.size(), sizeof(points.front()));

  REQUIRE(span.size() == 5);
  for (std::size_t i = 0; i < span.size(); ++i) CHECK(span[i].y == 10.0 * static_cast<double>(i));
  CHECK(span.front().x == 0.0);
  CHECK(span.back().x == 4.0);
  CHECK(span.end() - span.begin() == 5);
  CHECK((span.begin() + 3)->x == 3.0);
  CHECK(span.begin()[2].x == 2.0);
  CHECK(std::vector<dmrp_vec2>(span.begin(), span.end()).size() == 5);
  const auto found =
      std::lower_bound(span.begin(), span.end(), 2.5, [](const dmrp_vec2& point, double x) { return point.x < x; });
  CHECK(found - span.begin() == 3);
  auto last = span.end();
  CHECK((--last)->x == 4.0);
  CHECK(dmrp::Span<dmrp_vec2>().empty());
}

TEST_CASE("DMRP_HAS tells which fields a shorter or longer struct holds") {
  dmrp_command command{};
  command.struct_size = sizeof(command);
  CHECK(DMRP_HAS(&command, omega));
  command.struct_size = offsetof(dmrp_command, omega);
  CHECK(DMRP_HAS(&command, v_y));
  CHECK(!DMRP_HAS(&command, omega));
  command.struct_size = offsetof(dmrp_command, omega) + 4;  // half a field does not count
  CHECK(!DMRP_HAS(&command, omega));
  CHECK(DMRP_STRIDE_HAS(dmrp_waypoint, sizeof(dmrp_waypoint), reserved));
  CHECK(!DMRP_STRIDE_HAS(dmrp_waypoint, offsetof(dmrp_waypoint, reserved), reserved));
  CHECK(DMRP_STRIDE_HAS(dmrp_waypoint, sizeof(Longer<dmrp_waypoint>), reserved));
}
