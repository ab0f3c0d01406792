// SPDX-License-Identifier: MIT
#include "core/scene/world_view.hpp"

#include <string>
#include <vector>

#include "core/scene/robot_task.hpp"

namespace dmrp::core {
namespace {

struct StoredRobot {
  std::string name;
  std::vector<dmrp_goal> goals;
  dmrp_limits limits{};
  dmrp_pose start{};
  RobotSettings type;
  std::vector<dmrp_polygon> polygons{};  // views of the type's parts
  dmrp_footprint footprint{};
};

dmrp_robot sdk_robot_of(const StoredRobot& robot) {
  dmrp_robot view{};
  view.name = robot.name.c_str();
  view.type = robot.type.type.c_str();
  view.kinematics = static_cast<std::uint32_t>(robot.type.drive);
  view.goal_count = static_cast<std::uint32_t>(robot.goals.size());
  view.goals = robot.goals.data();
  view.goal_stride = sizeof(dmrp_goal);
  view.limits = &robot.limits;
  view.footprint = &robot.footprint;
  view.start = robot.start;
  return view;
}

}  // namespace

struct WorldView::Storage {
  std::vector<Shape> shapes;
  std::vector<StoredRobot> robots;
  std::vector<dmrp_segment> segments;
  PlanningGrid planning_grid;

  std::vector<dmrp_shape> sdk_shapes;
  std::vector<dmrp_robot> sdk_robots;
  dmrp_grid sdk_planning_grid{};
  dmrp_world world{};

  void set_pointers();
};

// From here on the storage must not move; it is on the heap.
void WorldView::Storage::set_pointers() {
  sdk_shapes = sdk_shapes_of(shapes);
  for (StoredRobot& robot : robots) {
    robot.polygons = polygons_of(robot.type);
    robot.footprint = footprint_of(robot.type, robot.polygons);
    sdk_robots.push_back(sdk_robot_of(robot));
  }
  sdk_planning_grid = planning_grid.view();

  world.struct_size = sizeof(world);
  world.robots = sdk_robots.data();
  world.robot_count = static_cast<std::uint32_t>(sdk_robots.size());
  world.robot_stride = sizeof(dmrp_robot);
  world.shapes = sdk_shapes.data();
  world.shape_count = static_cast<std::uint32_t>(sdk_shapes.size());
  world.shape_stride = sizeof(dmrp_shape);
  world.segments = segments.data();
  world.segment_count = static_cast<std::uint32_t>(segments.size());
  world.planning_grid = &sdk_planning_grid;
}

WorldView::WorldView(const Scenario& scenario, const RobotTypes& types, const SimulationSettings& simulation,
                     const StaticGeometry& geometry, const PlanningGrid& planning_grid, std::int64_t call_budget_ns)
    : storage_(std::make_unique<Storage>()) {
  storage_->shapes = geometry.shapes();
  for (const RobotTask& task : scenario.robots) {
    const RobotSettings& type = types.of(task);
    storage_->robots.push_back({task.name, goals_of(task, simulation.goal), limits_of(type), start_of(task), type});
  }
  storage_->segments.assign(geometry.segments().begin(), geometry.segments().end());
  storage_->planning_grid = planning_grid;

  dmrp_world& world = storage_->world;
  world.person_count = person_count(scenario);
  world.person_radius_m = world.person_count > 0 ? scenario.people.radius_m : 0.0;
  world.lower = geometry.lower();
  world.upper = geometry.upper();
  world.step_ns = simulation.step_ns;
  world.control_period_ns = simulation.control_period_ns;
  world.time_limit_ns = simulation.time_limit_ns;
  world.call_budget_ns = call_budget_ns;
  storage_->set_pointers();
}

WorldView::~WorldView() = default;
WorldView::WorldView(WorldView&&) noexcept = default;

const dmrp_world& WorldView::world() const {
  return storage_->world;
}

}  // namespace dmrp::core
