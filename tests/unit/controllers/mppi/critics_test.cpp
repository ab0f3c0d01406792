// SPDX-License-Identifier: MIT
// The critics of MPPI on trajectories whose costs are computed by hand.
#include "controllers/mppi/critics.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <map>
#include <string>

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

struct Scored {
  Costs costs;
  bool all_collide;
};

// What a critic adds to costs of 0, with its default parameters but for these.
Scored score(const std::string& name, const std::map<std::string, double>& parameters, const Batch& batch,
             const Scene& scene, CostField* field = nullptr, const Model& model = critics_test::model()) {
  ParameterTable table;
  const std::vector<Critic> critics = all_critics(table);
  for (const auto& [key, value] : parameters) {
    const std::string full = name + '_' + key;
    const auto at = std::find_if(table.begin(), table.end(), [&](const auto& known) { return known->key == full; });
    REQUIRE(at != table.end());
    dmrp_param_value given{};
    given.integer = std::lround(value);
    given.number = value;
    (*at)->assign((*at)->target, given);
  }
  const auto critic = std::find_if(critics.begin(), critics.end(), [&](const Critic& c) { return c.name == name; });
  REQUIRE(critic != critics.end());
  CostField none;
  Costs costs(lanes, 0.0f);
  CriticData data = {model, batch, scene, field ? *field : none, costs};
  critic->add(data);
  return {costs, data.all_collide};
}

Costs costs_of(const std::string& name, const std::map<std::string, double>& parameters, const Batch& batch,
               const Scene& scene) {
  return score(name, parameters, batch, scene).costs;
}

TEST_CASE("MPPI's constraint critic integrates the speed beyond the limits") {
  Batch batch = standing();
  // velocities are those now, then the controls but the last
  for (int i = 0; i < steps; ++i) batch.v_x.at(0, i) = i < 4 ? 0.7f : 0.3f;
  for (int i = 0; i < steps; ++i) batch.v_x.at(1, i) = -0.3f;
  const Costs costs = costs_of("ConstraintCritic", {}, batch, {});
  CHECK(costs[0] == Approx(4.0 * 4 * 0.2 * 0.1));
  CHECK(costs[1] == Approx(4.0 * 9 * 0.1 * 0.1));
  CHECK(costs[2] == 0.0f);
  SECTION("of a holonomic robot in any direction") {
    Model holonomic = model();
    holonomic.holonomic = true;
    holonomic.limits.v_y_max = 0.5f;
    batch = Batch();
    batch.resize(lanes, holonomic);
    for (int i = 0; i < steps; ++i) batch.v_x.at(0, i) = batch.v_y.at(0, i) = 0.6f;
    const Scored scored = score("ConstraintCritic", {{"cost_weight", 1.0}}, batch, {}, nullptr, holonomic);
    CHECK(scored.costs[0] == Approx(9 * 0.1 * (0.6 - 0.5) * std::sqrt(2.0)).epsilon(1e-4));
  }
}

TEST_CASE("MPPI's prefer-forward critic costs the way driven backward") {
  Batch batch = standing();
  for (int i = 0; i < steps; ++i) batch.v_x.at(0, i) = -0.2f;
  Scene scene = along_x(20);
  const Costs costs = costs_of("PreferForwardCritic", {}, batch, scene);
  CHECK(costs[0] == Approx(5.0 * 9 * 0.1 * 0.2));
  CHECK(costs[1] == 0.0f);
  CHECK(costs_of("PreferForwardCritic", {{"cost_power", 2}}, batch, scene)[0] == Approx(0.9 * 0.9));
  scene.goal_distance_m = 0.4f;
  CHECK(costs_of("PreferForwardCritic", {}, batch, scene)[0] == 0.0f);
}

TEST_CASE("MPPI's twirling critic costs the mean turning rate") {
  Batch batch = standing();
  batch.now.omega = -0.5f;
  for (int i = 0; i < steps; ++i) batch.omega.at(0, i) = i % 2 == 0 ? 0.5f : -0.5f;
  const Costs costs = costs_of("TwirlingCritic", {}, batch, along_x(20));
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
  const Costs of_distance = costs_of("GoalCritic", {}, batch, scene);
  CHECK(of_distance[0] == Approx(5.0 * 0.45).epsilon(1e-4));
  CHECK(of_distance[1] == Approx(5.0 * 1.0));
  const std::map<std::string, double> from_afar = {{"threshold_to_consider", 1.4}};
  const Costs of_heading = costs_of("GoalAngleCritic", from_afar, batch, scene);
  CHECK(of_heading[0] == Approx(3.0 * (2.0 * dmrp::toolkit::pi - 6.0)).epsilon(1e-4));  // the short way round
  CHECK(of_heading[1] == Approx(3.0 * 3.0));
  SECTION("only near the goal, and only a goal that has a heading") {
    CHECK(costs_of("GoalCritic", {{"threshold_to_consider", 0.9}}, batch, scene)[0] == 0.0f);
    scene.goal_theta = NAN;
    CHECK(costs_of("GoalAngleCritic", from_afar, batch, scene)[0] == 0.0f);
  }
}

// Not approximated, which would differ between processors.
TEST_CASE("MPPI's distances are the roots that the standard library takes") {
  Batch batch = standing();
  Scene scene = along_x(2);
  for (int i = 0; i < 1000; ++i) {
    batch.x.at(i % lanes, steps - 1) = 0.37f * static_cast<float>(i);
    batch.y.at(i % lanes, steps - 1) = 1.0f / static_cast<float>(i + 1);
    const Costs costs = costs_of("PathFollowCritic", {{"cost_weight", 1.0}, {"offset_from_furthest", 0}}, batch, scene);
    const float dx = batch.x.at(i % lanes, steps - 1), dy = batch.y.at(i % lanes, steps - 1);
    REQUIRE(costs[static_cast<std::size_t>(i % lanes)] == std::sqrt(dx * dx + dy * dy));
  }
}

TEST_CASE("MPPI's path-follow critic pulls to a point beyond the furthest reached") {
  const Batch batch = driving(0.1f);
  Scene scene = along_x(40);  // to 1.95 m
  scene.furthest = furthest_reached(batch, scene);
  CHECK(scene.furthest == 20);
  const Costs costs = costs_of("PathFollowCritic", {{"offset_from_furthest", 6}}, batch, scene);
  CHECK(costs[0] == Approx(5.0 * 0.3).epsilon(1e-4));
  CHECK(costs[1] == Approx(5.0 * 1.3).epsilon(1e-4));
  SECTION("past an obstacle to the first free point") {
    for (std::size_t i = 22; i < 30; ++i) scene.path_free[i] = 0;
    CHECK(costs_of("PathFollowCritic", {}, batch, scene)[0] == Approx(5.0 * 0.5).epsilon(1e-4));
  }
}

TEST_CASE("MPPI's path-align critic costs the mean distance after the same way driven") {
  Batch batch = driving(0.1f, 0.2f);
  Scene scene = along_x(40);
  scene.furthest = 20;
  std::map<std::string, double> parameters = {
      {"cost_weight", 10.0}, {"trajectory_point_step", 3}, {"offset_from_furthest", 10}};
  // compared: poses 3, 6, 9, after 0.3, 0.6 and 0.9 m from pose 0: that is 0.1 m ahead of the path and 0.2 m aside
  const Costs costs = costs_of("PathAlignCritic", parameters, batch, scene);
  CHECK(costs[0] == Approx(10.0 * std::hypot(0.1, 0.2)).epsilon(1e-3));
  CHECK(costs[1] == 0.0f);
  SECTION("headings count if they are to") {
    parameters["use_path_orientations"] = 1;
    for (int i = 0; i < steps; ++i) batch.theta.at(0, i) = -0.5f;
    CHECK(costs_of("PathAlignCritic", parameters, batch, scene)[0] ==
          Approx(10.0 * std::hypot(0.1, 0.2, 0.5)).epsilon(1e-3));
  }
  SECTION("not before trajectories reach far enough") {
    parameters["offset_from_furthest"] = 21;
    CHECK(costs_of("PathAlignCritic", parameters, batch, scene)[0] == 0.0f);
  }
  SECTION("nor where the path is blocked") {
    for (std::size_t i = 4; i < 8; ++i) scene.path_free[i] = 0;
    CHECK(costs_of("PathAlignCritic", parameters, batch, scene)[0] == 0.0f);
  }
}

TEST_CASE("MPPI's path-angle critic turns the robot to the path") {
  Batch batch = standing();
  for (int i = 0; i < steps; ++i) batch.theta.at(0, i) = 1.5f;
  for (int i = 0; i < steps; ++i) batch.theta.at(1, i) = 3.0f;
  Scene scene = along_x(20);
  scene.theta = 1.5f;
  const Costs forward = costs_of("PathAngleCritic", {}, batch, scene);
  CHECK(forward[0] == Approx(2.0 * 1.5));
  CHECK(forward[1] == Approx(2.0 * 3.0));
  SECTION("not if it heads there already") {
    scene.theta = 0.9f;
    CHECK(costs_of("PathAngleCritic", {}, batch, scene)[0] == 0.0f);
  }
  SECTION("forward or backward, if the robot may drive backward") {
    const Costs either = costs_of("PathAngleCritic", {{"mode", 1}}, batch, scene);
    CHECK(either[0] == Approx(2.0 * 1.5));
    CHECK(either[1] == Approx(2.0 * (dmrp::toolkit::pi - 3.0)).epsilon(1e-4));
    Model forward_only = model();
    forward_only.limits.v_min = 0.0f;
    CHECK(score("PathAngleCritic", {{"mode", 1}}, batch, scene, nullptr, forward_only).costs == forward);
  }
}

// An obstacle 1 m ahead of the robot, which stands at (1, 2).
struct Post {
  Post() {
    fake.mark(2.01, 2.01);
    map = fake.c();
    field.look(map, footprint, 0.0, {1.0, 2.0, 0.0}, {});
  }

  FakeCostmap fake = FakeCostmap(80);
  dmrp_costmap map{};
  dmrp_footprint c_footprint = disc_footprint(0.25);
  dmrp::Footprint footprint = dmrp::Footprint(c_footprint);
  CostField field;
};

TEST_CASE("MPPI's cost critic takes the mean cost of the cells, and a fixed cost for collisions") {
  Post post;
  const std::map<std::string, double> parameters = {{"cost_weight", 254.0}, {"trajectory_point_step", 3}};
  const auto cell = [&post](double x, double y) {  // at poses 0, 3, 6, 9
    return static_cast<double>(dmrp::controllers::CostmapView(post.map).cost({x, y}));
  };
  Batch batch = driving(0.06f);                                                          // to 0.6 m
  for (int i = 0; i < steps; ++i) batch.x.at(1, i) = 0.09f * static_cast<float>(i + 1);  // to 0.9 m
  Scene scene = along_x(40);
  const Scored scored = score("CostCritic", parameters, batch, scene, &post.field);
  CHECK_FALSE(scored.all_collide);
  CHECK(cell(1.6, 2.0) > 0.0);
  CHECK(scored.costs[0] == Approx((cell(1.06, 2.0) + cell(1.24, 2.0) + cell(1.42, 2.0) + cell(1.6, 2.0)) / 4.0));
  CHECK(scored.costs[1] == Approx(1e6 / 4.0));
  SECTION("near the goal only collisions count") {
    scene.goal_distance_m = 0.9f;
    const Scored near_goal = score("CostCritic", parameters, batch, scene, &post.field);
    CHECK_FALSE(near_goal.all_collide);
    CHECK(near_goal.costs[0] == 0.0f);
    CHECK(near_goal.costs[1] == Approx(1e6 / 4.0));
  }
  SECTION("it says that every trajectory collides") {
    for (int s = 0; s < lanes; ++s)
      for (int i = 0; i < steps; ++i) batch.x.at(s, i) = 1.0f;
    CHECK(score("CostCritic", parameters, batch, scene, &post.field).all_collide);
  }
}

TEST_CASE("MPPI's obstacles critic costs distances to obstacles") {
  Post post;
  Batch batch = standing();
  for (int i = 0; i < steps; ++i) batch.x.at(0, i) = 0.61f;  // in the cell 0.4 m from the obstacle's: a gap of 0.15 m
  const Scored scored = score("ObstaclesCritic", {{"collision_margin_distance", 0.2}}, batch, along_x(40), &post.field);
  CHECK_FALSE(scored.all_collide);
  // distances are known as precisely as a cost of 8 bits says
  const double gap_m = 0.15;
  CHECK(scored.costs[0] == Approx(20.0 * 10 * (0.2 - gap_m) + 1.5 * (0.55 - gap_m)).margin(0.5));
  CHECK(scored.costs[1] == 0.0f);
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
  const Scored scored = score("CostCritic", {{"trajectory_point_step", 1}}, batch, along_x(40), &field);
  CHECK_FALSE(scored.all_collide);
  CHECK(scored.costs[0] == Approx(3.81 / 254.0 / steps * 1e6));
  CHECK(scored.costs[1] == 0.0f);
}

}  // namespace critics_test
