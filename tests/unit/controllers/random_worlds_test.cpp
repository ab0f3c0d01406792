// SPDX-License-Identifier: MIT
// Invariants of all controllers for any world, path, limits, footprint and control period.
#include "tests/unit/controllers/random_worlds.hpp"

#include <cstring>

#include "tests/support/draws.hpp"
#include "tests/unit/controllers/controllers.hpp"

namespace random_worlds_test {

using namespace dmrp::test;

constexpr const char* library = "libdmrp_controllers.so";

bool same_bits(const std::vector<dmrp_command>& a, const std::vector<dmrp_command>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(dmrp_command)) == 0;
}

TEST_CASE("In random worlds commands respect the limits, and a reused instance gives the same bits") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  PluginUnderTest used(library, controller.id);
  for (std::uint64_t seed = 0; seed < draws(10u); ++seed) {
    CAPTURE(controller, seed);
    PluginUnderTest fresh(library, controller.id);
    const RandomDrive drive = drive_at_random(fresh, seed, 40);
    CHECK(drive.breaches == std::vector<std::string>{});
    CHECK(same_bits(drive.commands, drive_at_random(used, seed, 40).commands));
  }
}

TEST_CASE("MPC does not start with empty parameter intervals") {
  const ParamOverrides contradictory = GENERATE(ParamOverrides{{"min_dt", 0.5}, {"max_dt", 0.2}},
                                                ParamOverrides{{"min_grid_size", 20}, {"max_grid_size", 10}});
  PluginUnderTest mpc(library, "dmrp.controller.mpc", contradictory);
  CHECK(drive_at_random(mpc, 0, 0).breaches == std::vector<std::string>{"start() failed at step -1"});
}

}  // namespace random_worlds_test
