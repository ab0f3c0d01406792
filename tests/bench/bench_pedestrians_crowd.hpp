// SPDX-License-Identifier: MIT
// bench_pedestrians_crowd.hpp: crowds that cross each other, to measure pedestrian models with.
#pragma once

#include <dmrp/pedestrian_model.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/static_geometry.hpp"
#include "core/scene/world_view.hpp"
#include "core/world/solid_motion.hpp"
#include "tests/unit/plugin_under_test.hpp"

namespace dmrp::bench {

// A square for so many people at 0.25 people/m2, with a bench of 2 x 0.5 m and a pillar in every 100 m2.
struct Square {
  explicit Square(std::uint32_t people);

  std::uint32_t people;
  core::Scenario scenario;
  std::shared_ptr<const core::StaticGeometry> geometry;
  core::WorldView view;
};

// People anywhere on a square, a quarter of them bound for each side; who has reached it turns back. The world keeps
// them solid, as the host's does.
class CrossingCrowd {
 public:
  CrossingCrowd(const Square& square, const std::string& model, std::uint64_t seed);

  void ask_model();  // what is measured
  void move();

 private:
  void place_people(const Square& square, std::uint64_t seed);
  void send_to(dmrp_person& person, std::uint32_t side) const;

  double side_m_;
  test::PluginUnderTest model_;
  std::shared_ptr<const core::StaticGeometry> geometry_;
  core::SolidMotion motion_;
  std::int64_t t_ns_ = 0;
  std::vector<dmrp_person> people_;
  std::vector<core::SolidBody> bodies_;
  std::vector<dmrp_vec2> velocities_;
};

}  // namespace dmrp::bench
