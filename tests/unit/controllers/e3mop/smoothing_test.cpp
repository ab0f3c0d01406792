// SPDX-License-Identifier: MIT
// E3MoP's path optimisation on many paths.
#include <catch2/catch.hpp>

#include "controllers/e3mop/path_smoother.hpp"
#include "tests/unit/controllers/e3mop/e3mop_paths.hpp"
#include "tests/unit/controllers/e3mop/e3mop_window.hpp"

namespace smoothing_test {

using namespace dmrp::controllers::e3mop;
using dmrp::test::discs_window;
using dmrp::test::Points;
using dmrp::test::wavering;
using dmrp::test::Window;
using dmrp::toolkit::Stream;

TEST_CASE("Smoothing lowers the objective, keeps the ends, and never moves a point into collision") {
  Stream random(1, "e3mop.smoothing");
  PathSmoother smoother;
  for (int round = 0; round < 40; ++round) {
    std::vector<dmrp_vec2> discs;
    for (int k = 0; k < 6; ++k) discs.push_back({random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)});
    const Window window = discs_window(discs, 0.2);
    SmoothingSettings settings;
    settings.weight_smoothness = round % 2 ? 1.0 : 50.0;
    settings.needed_m = 0.3;
    const Points before = wavering(random, window.field);
    Points after = before;
    const SmoothingResult result = smoother.smooth(after, 2, window.field, settings);
    CHECK(result.iterations <= 100);
    CHECK(result.cost < result.first_cost);
    SmoothingProblem problem;
    problem.set(after, 2, window.field, settings);
    if (result.put_back == 0) CHECK(problem.cost() == Approx(result.cost));
    CHECK((after[0] == before[0] && after[1] == before[1] && after.back() == before.back()));
    for (const dmrp_vec2 point : after) REQUIRE(window.field.at(point).distance_m >= 0.3);
  }
}

}  // namespace smoothing_test
