// SPDX-License-Identifier: MIT
// bench_pedestrians_crowd.hpp: crossing crowds for measurements of pedestrian models.
#pragma once

#include <dmrp/pedestrian_model.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/static_geometry.hpp"
#include "core/scene/world_view.hpp"
#include "core/world/solid_motion.hpp"
#include "tests/unit/given_walking_grid.hpp"
#include "tests/unit/plugin_under_test.hpp"

namespace dmrp::bench {

// A square for this number of people at 0.25 people/m2, with a bench of 2 x 0.5 m and a pillar in every 100 m2.
struct Square {
  explicit Square(std::uint32_t people);

  std::uint32_t people;
  core::Scenario scenario;
  std::shared_ptr<const core::StaticGeometry> geometry;
  core::PlanningGrid walking_grid;
  core::WorldView view;
};

// People at random positions on a square. Each side is the target of a quarter of them; people who reach it turn back.
// Contacts are resolved as in the host's world.
class CrossingCrowd {
 public:
  CrossingCrowd(const Square& square, const std::string& model, std::uint64_t seed);

  void step_model();  // the measured part
  void move();

 private:
  void place_people(const Square& square, std::uint64_t seed);
  void send_to(dmrp_person& person, std::uint32_t side) const;

  double side_m_;
  dmrp_grid grid_;
  test::GivenWalkingGrid walking_grid_;
  test::PluginUnderTest model_;
  std::shared_ptr<const core::StaticGeometry> geometry_;
  core::SolidMotion motion_;
  std::int64_t t_ns_ = 0;
  std::vector<dmrp_person> people_;
  std::vector<core::SolidBody> bodies_;
  std::vector<dmrp_motion> motions_;
};

}  // namespace dmrp::bench
