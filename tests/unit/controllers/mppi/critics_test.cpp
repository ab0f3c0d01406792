// SPDX-License-Identifier: MIT
// The critics of MPPI on trajectories whose costs are computed by hand.
#include "controllers/mppi/critics.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>

#include "tests/unit/controllers/fake_costmap.hpp"
#include "tests/unit/controllers/robot_body.hpp"

namespace critics_test {

using namespace dmrp::controllers::mppi;
using dmrp::test::disc_footprint;
using dmrp::test::FakeCostmap;

constexpr int steps = 10;

Model model() {
  Model m;
  m.steps = steps;
  m.step_s = 0.1f;
  m.limits = {-0.2f, 0.5f, 0.0f, 1.0f, 1.0f, 1.0f};
  return m;
}

// One block of samples that stand at the origin.
Batch standing() {
  Batch batch;
  batch.resize(lanes, model());
  return batch;
}

// Sample 0 drives along x: at pose i it is `step_m` (i + 1) from the origin, `aside_m` beside the x axis.
Batch driving(float step_m, float aside_m = 0.0f) {
  Batch batch = standing();
  for (int i = 0; i < steps; ++i) {
    batch.x.at(0, i) = step_m * static_cast<float>(i + 1);
    batch.y.at(0, i) = aside_m;
  }
  return batch;
}

// A path of `count` points along the x axis, all free; the goal is far ahead.
Scene along_x(int count) {
  Scene scene;
  for (int i = 0; i < count; ++i) {
    scene.path_x.push_back(path_spacing_m * static_cast<float>(i));
    scene.path_y.push_back(0.0f);
    scene.path_theta.push_back(0.0f);
    scene.path_free.push_back(1);
  }
  scene.goal_x = 10.0f;
  scene.goal_distance_m = 10.0f;
  return scene;
}

float cost_of_first(const Costs& costs) {
  return costs[0];
}

TEST_CASE("MPPI's constraint critic integrates the speed beyond the limits") {
  Batch batch = standing();
  // velocities are those now, then the controls but the last
  for (int i = 0; i < steps; ++i) batch.v_x.at(0, i) = i < 4 ? 0.7f : 0.3f;
  for (int i = 0; i < steps; ++i) batch.v_x.at(1, i) = -0.3f;
  Costs costs(lanes, 1.0f);
  add_constraint(batch, model(), {4.0f, 1}, costs);
  CHECK(costs[0] == Approx(1.0 + 4.0 * 4 * 0.2 * 0.1));
  CHECK(costs[1] == Approx(1.0 + 4.0 * 9 * 0.1 * 0.1));
  CHECK(costs[2] == 1.0f);
  SECTION("of a holonomic robot in any direction") {
    Model holonomic = model();
    holonomic.holonomic = true;
    holonomic.limits.v_y_max = 0.5f;
    batch = Batch();
    batch.resize(lanes, holonomic);
    for (int i = 0; i < steps; ++i) batch.v_x.at(0, i) = batch.v_y.at(0, i) = 0.6f;
    costs.assign(lanes, 0.0f);
    add_constraint(batch, holonomic, {1.0f, 1}, costs);
    CHECK(costs[0] == Approx(9 * 0.1 * (0.6 - 0.5) * std::sqrt(2.0)).epsilon(1e-4));
  }
}

TEST_CASE("MPPI's prefer-forward critic costs the way driven backward") {
  Batch batch = standing();
  for (int i = 0; i < steps; ++i) batch.v_x.at(0, i) = -0.2f;
  Scene scene = along_x(20);
  Costs costs(lanes, 0.0f);
  add_prefer_forward(batch, model(), {5.0f, 1}, 0.5f, scene, costs);
  CHECK(costs[0] == Approx(5.0 * 9 * 0.1 * 0.2));
  CHECK(costs[1] == 0.0f);
  SECTION("raised to the power") {
    costs.assign(lanes, 0.0f);
    add_prefer_forward(batch, model(), {5.0f, 2}, 0.5f, scene, costs);
    CHECK(costs[0] == Approx(0.9 * 0.9));
  }
  SECTION("not near the goal") {
    scene.goal_distance_m = 0.4f;
    costs.assign(lanes, 0.0f);
    add_prefer_forward(batch, model(), {5.0f, 1}, 0.5f, scene, costs);
    CHECK(costs[0] == 0.0f);
  }
}

TEST_CASE("MPPI's twirling critic costs the mean turning rate") {
  Batch batch = standing();
  batch.now.omega = -0.5f;
  for (int i = 0; i < steps; ++i) batch.omega.at(0, i) = i % 2 == 0 ? 0.5f : -0.5f;
  Costs costs(lanes, 0.0f);
  add_twirling(batch, {10.0f, 1}, along_x(20), costs);
  CHECK(costs[0] == Approx(10.0 * 0.5));
  CHECK(costs[1] == Approx(10.0 * 0.05));  // the rate now, in one of ten steps
}

TEST_CASE("MPPI's goal critics cost mean distance and mean deviation of the heading") {
  Batch batch = driving(0.1f);  // to 1 m
  for (int i = 0; i < steps; ++i) batch.theta.at(0, i) = 3.0f;
  Scene scene = along_x(20);
  scene.goal_x = 1.0f;
  scene.goal_y = 0.0f;
  scene.goal_theta = -3.0f;
  scene.goal_distance_m = 1.0f;
  Costs costs(lanes, 0.0f);
  add_goal(batch, {5.0f, 1}, 1.4f, scene, costs);
  CHECK(costs[0] == Approx(5.0 * 0.45).epsilon(1e-4));
  CHECK(costs[1] == Approx(5.0 * 1.0));
  costs.assign(lanes, 0.0f);
  add_goal_angle(batch, {3.0f, 1}, 1.4f, scene, costs);
  CHECK(costs[0] == Approx(3.0 * (2.0 * dmrp::toolkit::pi - 6.0)).epsilon(1e-4));  // the short way round
  CHECK(costs[1] == Approx(3.0 * 3.0));
  SECTION("only near the goal, and only a goal that has a heading") {
    costs.assign(lanes, 0.0f);
    add_goal(batch, {5.0f, 1}, 0.9f, scene, costs);
    scene.goal_theta = NAN;
    add_goal_angle(batch, {3.0f, 1}, 1.4f, scene, costs);
    CHECK(cost_of_first(costs) == 0.0f);
  }
}

// Not approximated, which would differ between processors.
TEST_CASE("MPPI's distances are the roots that the standard library takes") {
  Batch batch = standing();
  Scene scene = along_x(2);
  for (int i = 0; i < 1000; ++i) {
    batch.x.at(i % lanes, steps - 1) = 0.37f * static_cast<float>(i);
    batch.y.at(i % lanes, steps - 1) = 1.0f / static_cast<float>(i + 1);
    Costs costs(lanes, 0.0f);
    add_path_follow(batch, {1.0f, 1}, 0, 1.4f, scene, costs);
    const float dx = batch.x.at(i % lanes, steps - 1), dy = batch.y.at(i % lanes, steps - 1);
    REQUIRE(costs[static_cast<std::size_t>(i % lanes)] == std::sqrt(dx * dx + dy * dy));
  }
}

TEST_CASE("MPPI's path-follow critic pulls to a point beyond the furthest reached") {
  const Batch batch = driving(0.1f);
  Scene scene = along_x(40);  // to 1.95 m
  scene.furthest = furthest_reached(batch, scene);
  CHECK(scene.furthest == 20);
  Costs costs(lanes, 0.0f);
  add_path_follow(batch, {5.0f, 1}, 6, 1.4f, scene, costs);
  CHECK(costs[0] == Approx(5.0 * 0.3).epsilon(1e-4));
  CHECK(costs[1] == Approx(5.0 * 1.3).epsilon(1e-4));
  SECTION("past an obstacle to the first free point") {
    for (std::size_t i = 22; i < 30; ++i) scene.path_free[i] = 0;
    costs.assign(lanes, 0.0f);
    add_path_follow(batch, {5.0f, 1}, 6, 1.4f, scene, costs);
    CHECK(costs[0] == Approx(5.0 * 0.5).epsilon(1e-4));
  }
}

TEST_CASE("MPPI's path-align critic costs the mean distance after the same way driven") {
  Batch batch = driving(0.1f, 0.2f);
  Scene scene = along_x(40);
  scene.furthest = 20;
  PathAlignSettings settings;
  settings.weight = {10.0f, 1};
  settings.point_step = 3;
  settings.offset_from_furthest = 10;
  // compared: poses 3, 6, 9, after 0.3, 0.6 and 0.9 m from pose 0: that is 0.1 m ahead of the path and 0.2 m aside
  Costs costs(lanes, 0.0f);
  add_path_align(batch, settings, scene, costs);
  CHECK(costs[0] == Approx(10.0 * std::hypot(0.1, 0.2)).epsilon(1e-3));
  CHECK(costs[1] == 0.0f);
  SECTION("headings count if they are to") {
    settings.use_path_orientations = true;
    for (int i = 0; i < steps; ++i) batch.theta.at(0, i) = -0.5f;
    costs.assign(lanes, 0.0f);
    add_path_align(batch, settings, scene, costs);
    CHECK(costs[0] == Approx(10.0 * std::hypot(0.1, 0.2, 0.5)).epsilon(1e-3));
  }
  SECTION("not before trajectories reach far enough, nor where the path is blocked") {
    costs.assign(lanes, 0.0f);
    settings.offset_from_furthest = 21;
    add_path_align(batch, settings, scene, costs);
    settings.offset_from_furthest = 10;
    for (std::size_t i = 4; i < 8; ++i) scene.path_free[i] = 0;
    add_path_align(batch, settings, scene, costs);
    CHECK(cost_of_first(costs) == 0.0f);
  }
}

TEST_CASE("MPPI's path-angle critic turns the robot to the path") {
  Batch batch = standing();
  for (int i = 0; i < steps; ++i) batch.theta.at(0, i) = 1.5f;
  for (int i = 0; i < steps; ++i) batch.theta.at(1, i) = 3.0f;
  Scene scene = along_x(20);
  scene.theta = 1.5f;
  PathAngleSettings settings;
  Costs costs(lanes, 0.0f);
  add_path_angle(batch, settings, scene, costs);
  CHECK(costs[0] == Approx(2.0 * 1.5));
  CHECK(costs[1] == Approx(2.0 * 3.0));
  SECTION("not if it heads there already") {
    scene.theta = 0.9f;
    costs.assign(lanes, 0.0f);
    add_path_angle(batch, settings, scene, costs);
    CHECK(cost_of_first(costs) == 0.0f);
  }
  SECTION("forward or backward") {
    settings.mode = PathAngleMode::no_directional_preference;
    costs.assign(lanes, 0.0f);
    add_path_angle(batch, settings, scene, costs);
    CHECK(costs[0] == Approx(2.0 * 1.5));
    CHECK(costs[1] == Approx(2.0 * (dmrp::toolkit::pi - 3.0)).epsilon(1e-4));
  }
}

TEST_CASE("MPPI's cost critic takes the mean cost of the cells, and a fixed cost for collisions") {
  // an obstacle 1 m ahead of the robot, which stands at (1, 2)
  FakeCostmap fake(80);
  fake.mark(2.01, 2.01);
  const dmrp_costmap map = fake.c();
  const dmrp_footprint footprint = disc_footprint(0.25);
  CostField field;
  field.look(map, footprint, 0.0, {1.0, 2.0, 0.0}, {});
  CostSettings settings;
  settings.weight = {254.0f, 1};
  settings.point_step = 3;  // poses 0, 3, 6, 9
  const auto cell = [&map](double x, double y) {
    return static_cast<double>(dmrp::controllers::CostmapView(map).cost({x, y}));
  };
  Batch batch = driving(0.06f);                                                          // to 0.6 m
  for (int i = 0; i < steps; ++i) batch.x.at(1, i) = 0.09f * static_cast<float>(i + 1);  // to 0.9 m
  Costs costs(lanes, 0.0f);
  Scene scene = along_x(40);
  CHECK(add_cost(batch, model(), settings, field, scene, costs));
  CHECK(cell(1.6, 2.0) > 0.0);
  CHECK(costs[0] == Approx((cell(1.06, 2.0) + cell(1.24, 2.0) + cell(1.42, 2.0) + cell(1.6, 2.0)) / 4.0));
  CHECK(costs[1] == Approx(1e6 / 4.0));
  SECTION("near the goal only collisions count") {
    scene.goal_distance_m = 0.9f;
    costs.assign(lanes, 0.0f);
    CHECK(add_cost(batch, model(), settings, field, scene, costs));
    CHECK(costs[0] == 0.0f);
    CHECK(costs[1] == Approx(1e6 / 4.0));
  }
  SECTION("it says that every trajectory collides") {
    for (int s = 0; s < lanes; ++s)
      for (int i = 0; i < steps; ++i) batch.x.at(s, i) = 1.0f;
    CHECK_FALSE(add_cost(batch, model(), settings, field, scene, costs));
  }
}

TEST_CASE("MPPI's obstacles critic costs distances to obstacles") {
  FakeCostmap fake(80);
  fake.mark(2.01, 2.01);
  const dmrp_costmap map = fake.c();
  const dmrp_footprint footprint = disc_footprint(0.25);
  CostField field;
  field.look(map, footprint, 0.0, {1.0, 2.0, 0.0}, {});
  ObstaclesSettings settings;
  settings.collision_margin_distance_m = 0.2f;
  Batch batch = standing();
  for (int i = 0; i < steps; ++i) batch.x.at(0, i) = 0.61f;  // in the cell 0.4 m from the obstacle's: a gap of 0.15 m
  Costs costs(lanes, 0.0f);
  CHECK(add_obstacles(batch, model(), settings, field, along_x(40), costs));
  // distances are known as precisely as a cost of 8 bits says
  const double gap_m = 0.15;
  CHECK(costs[0] == Approx(20.0 * 10 * (0.2 - gap_m) + 1.5 * (0.55 - gap_m)).margin(0.5));
  CHECK(costs[1] == 0.0f);
}

TEST_CASE("MPPI's moving agents cost where they will be") {
  FakeCostmap fake(80);
  const dmrp_costmap map = fake.c();
  const dmrp_footprint footprint = disc_footprint(0.25);
  const dmrp_vec2 at = {2.0, 2.5};
  dmrp::controllers::Obstacle walker;
  walker.vertices = &at;
  walker.vertex_count = 1;
  walker.radius_m = 0.3;
  walker.center = at;
  walker.velocity = {0.0, -0.5};  // at (2, 2), 1 m ahead of the robot, after 1 s
  walker.is_agent = true;
  CostField field;
  field.look(map, footprint, 0.0, {1.0, 2.0, 0.0}, {walker});
  Batch batch = driving(0.05f);                              // 0.5 m from there at that time
  for (int i = 0; i < steps; ++i) batch.y.at(1, i) = -1.0f;  // far away
  Costs costs(lanes, 0.0f);
  CostSettings settings;
  settings.point_step = 1;
  CHECK(add_cost(batch, model(), settings, field, along_x(40), costs));
  CHECK(costs[0] == Approx(3.81 / 254.0 / steps * 1e6));
  CHECK(costs[1] == 0.0f);
}

}  // namespace critics_test
