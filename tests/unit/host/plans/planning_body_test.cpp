// SPDX-License-Identifier: MIT
#include <algorithm>
#include <catch2/catch.hpp>
#include <dmrp/toolkit/grid_view.hpp>

#include "host/plans/planning.hpp"
#include "tests/unit/host/trial/stage.hpp"

namespace planning_body_test {

using namespace dmrp::host;
using namespace dmrp::test;
namespace core = dmrp::core;
namespace toolkit = dmrp::toolkit;

Experiment in_hall_with_pillar() {
  Experiment experiment;
  core::Scenario scenario = hall(2);
  core::Shape pillar;
  pillar.kind = core::Shape::Kind::circle;
  pillar.center = {5.0, 3.1};
  pillar.radius_m = 0.4;
  scenario.shapes = {pillar};
  experiment.scenarios = {{scenario, "hall", ""}};
  experiment.simulation.planning_body = core::PlanningBody::point;
  experiment.simulation.planning_margin_m = 0.6;
  experiment.simulation.grid_resolution_m = 0.25;
  return experiment;
}

TEST_CASE("points keep the margin from walls, and have no extent to other robots") {
  const Experiment experiment = in_hall_with_pillar();
  const VariantWorld variant(experiment, experiment.scenarios[0]);
  const dmrp_grid view = variant.planning_grid.view();
  const toolkit::GridView grid(view);
  for (std::uint32_t cell = 0; cell < grid.size(); ++cell)
    CHECK(static_cast<bool>(view.free[cell]) == variant.geometry->disc_is_free(grid.center(grid.cell(cell)), 0.6));

  StagedProblem problem;
  stage_first_problem(experiment, variant, problem);
  for (const dmrp_planning_robot& robot : problem.robots) CHECK(robot.robot->footprint->radius_m == 0.0);
  CHECK(problem.c.robots[0].robot == variant.world_for(DMRP_KIND_GLOBAL_PLANNER).robots);
  CHECK(variant.world_for(DMRP_KIND_LOCAL_CONTROLLER).robots[0].footprint->radius_m == 0.25);
  CHECK(variant.sweep_is_free({2.0, 0.7}, {8.0, 0.7}, 0.0));
  CHECK_FALSE(variant.sweep_is_free({2.0, 0.5}, {8.0, 0.5}, 0.0));
}

TEST_CASE("footprints are what planners plan for, unless the experiment says otherwise") {
  Experiment experiment = in_hall_with_pillar();
  experiment.simulation.planning_body = core::PlanningBody::footprint;
  const VariantWorld variant(experiment, experiment.scenarios[0]);
  CHECK(&variant.world_for(DMRP_KIND_GLOBAL_PLANNER) == &variant.view.world());
  const dmrp_grid view = variant.planning_grid.view();
  const toolkit::GridView grid(view);
  for (std::uint32_t cell = 0; cell < grid.size(); ++cell)
    CHECK(static_cast<bool>(view.free[cell]) == variant.geometry->disc_is_free(grid.center(grid.cell(cell)), 0.85));
}

}  // namespace planning_body_test
