// SPDX-License-Identifier: MIT
// Copies of what plugins are shown: equal, with nothing that lies outside of the arena.
#include "host/guests/exchange/sent_world.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <vector>

#include "tests/unit/host/trial/stage.hpp"

namespace sent_world_test {

using namespace dmrp;
using namespace dmrp::host;

struct Memory {
  std::vector<std::byte> bytes = std::vector<std::byte>(std::size_t{1} << 22);
  Arena arena{bytes.data(), bytes.size()};

  bool has(const void* address) const { return address >= bytes.data() && address < bytes.data() + bytes.size(); }
};

Experiment experiment_with(core::Scenario scenario) {
  Experiment experiment;
  experiment.scenarios = {{std::move(scenario), "hall", ""}};
  return experiment;
}

TEST_CASE("a world is sent with all that it points to") {
  const Experiment experiment = experiment_with(test::hall(2));
  const VariantWorld variant(experiment, experiment.scenarios[0]);
  const dmrp_world& world = variant.view.world();
  Memory memory;
  const SentWorld sent(memory.arena, world);
  const dmrp_world& copy = sent.world();

  REQUIRE(copy.robot_count == 2);
  for (std::uint32_t i = 0; i < 2; ++i) {
    const dmrp_robot& original = *DMRP_AT(dmrp_robot, world.robots, world.robot_stride, i);
    const dmrp_robot& robot = *DMRP_AT(dmrp_robot, copy.robots, copy.robot_stride, i);
    CHECK(std::strcmp(robot.name, original.name) == 0);
    CHECK(robot.goals[0].pose.x == original.goals[0].pose.x);
    CHECK(std::memcmp(robot.limits, original.limits, sizeof(dmrp_limits)) == 0);
    CHECK(robot.footprint->radius_m == original.footprint->radius_m);
    for (const void* const part : {static_cast<const void*>(robot.name), static_cast<const void*>(robot.type),
                                   static_cast<const void*>(robot.goals), static_cast<const void*>(robot.limits),
                                   static_cast<const void*>(robot.footprint)})
      CHECK(memory.has(part));
  }
  REQUIRE(copy.segment_count == world.segment_count);
  CHECK(std::memcmp(copy.segments, world.segments, copy.segment_count * sizeof(dmrp_segment)) == 0);
  REQUIRE(copy.planning_grid);
  const std::size_t cells = std::size_t{copy.planning_grid->width} * copy.planning_grid->height;
  CHECK(std::memcmp(copy.planning_grid->edges, world.planning_grid->edges, cells) == 0);
  for (const void* const part :
       {static_cast<const void*>(copy.segments), static_cast<const void*>(copy.planning_grid),
        static_cast<const void*>(copy.planning_grid->free), static_cast<const void*>(copy.planning_grid->clearance)})
    CHECK(memory.has(part));
}

TEST_CASE("grids that worlds have in common are sent once") {
  const Experiment experiment = experiment_with(test::hall(1));
  const VariantWorld variant(experiment, experiment.scenarios[0]);
  const dmrp_world& world = variant.view.world();
  Memory memory;
  const SentWorld shared(memory.arena, world);
  const SentWorld own(memory.arena, world, shared);
  CHECK(own.world().planning_grid == shared.world().planning_grid);
  CHECK(own.world().robots != shared.world().robots);
}

TEST_CASE("an arena has an end, and gives back what came after a mark") {
  Memory memory;
  const std::size_t mark = memory.arena.mark();
  const auto* const first = memory.arena.make<double>(10);
  memory.arena.rewind(mark);
  CHECK(memory.arena.make<double>() == first);
  CHECK_THROWS_AS(memory.arena.make<double>(std::size_t{1} << 40), std::bad_alloc);
  CHECK_THROWS_AS(memory.arena.make<double>(~std::size_t{0}), std::bad_alloc);
}

}  // namespace sent_world_test
