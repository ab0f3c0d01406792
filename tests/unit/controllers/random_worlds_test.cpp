// SPDX-License-Identifier: MIT
// What no world, path, limits, footprint or control period may bring a controller to.
#include "tests/unit/controllers/random_worlds.hpp"

#include <cstring>

#include "tests/unit/controllers/controllers.hpp"

using namespace dmrp::test;

namespace {

constexpr const char* library = "libdmrp_controllers.so";

bool same_bits(const std::vector<dmrp_command>& a, const std::vector<dmrp_command>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(dmrp_command)) == 0;
}

}  // namespace

TEST_CASE("In random worlds commands keep to the limits, and an instance that was used before gives the same bits") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  PluginUnderTest used(library, controller.id);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    CAPTURE(controller, seed);
    PluginUnderTest fresh(library, controller.id);
    const RandomDrive drive = drive_at_random(fresh, seed, 40);
    CHECK(drive.breaches == std::vector<std::string>{});
    CHECK(same_bits(drive.commands, drive_at_random(used, seed, 40).commands));
  }
}

TEST_CASE("MPC does not start with bounds that leave nothing between them") {
  const ParamOverrides contradictory = GENERATE(ParamOverrides{{"min_dt", 0.5}, {"max_dt", 0.2}},
                                                ParamOverrides{{"min_grid_size", 20}, {"max_grid_size", 10}});
  PluginUnderTest mpc(library, "dmrp.controller.mpc", contradictory);
  CHECK(drive_at_random(mpc, 0, 0).breaches == std::vector<std::string>{"start() failed at step -1"});
}
