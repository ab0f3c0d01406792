// SPDX-License-Identifier: MIT
#include "core/world/solid_motion.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "tests/unit/core/sample_scenarios.hpp"

namespace solid_motion_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

SolidBody person_at(double x) {
  return {{x, 5.0}, 0.3, {}, SolidBody::ContactResponse::yield};
}

TEST_CASE("contact pushes people who stand at up to 1 m/s, whatever the step") {
  const std::int64_t step_ns = GENERATE(5'000'000, 10'000'000, 20'000'000, 50'000'000);
  CAPTURE(step_ns);
  const double step_s = 1e-9 * static_cast<double>(step_ns);
  SolidMotion motion(geometry_of(empty_scenario(20, 10)), step_ns);
  // the first runs at 5 m/s into two who stand in a row
  std::vector<SolidBody> row = {person_at(2.0), person_at(2.65), person_at(3.3)};
  double fastest = 0.0;
  for (std::int64_t t_ns = 0; t_ns < 2'000'000'000; t_ns += step_ns) {
    for (SolidBody& body : row) body.displacement = {};
    row[0].displacement = {5.0 * step_s, 0.0};
    motion.resolve(row);
    for (std::size_t i = 1; i < row.size(); ++i)
      fastest = std::max(fastest, toolkit::norm(row[i].displacement) / step_s);
    for (SolidBody& body : row) body.position += body.displacement;
  }
  CHECK(fastest == Approx(1.0));
  // they begin to move when the gap of 0.05 m is closed
  CHECK(row[1].position.x == Approx(2.65 + 2.0).margin(0.25));
  CHECK(row[2].position.x == Approx(3.3 + 2.0).margin(0.25));
}

}  // namespace solid_motion_test
