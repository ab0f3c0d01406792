// SPDX-License-Identifier: MIT
#include "core/scene/world_view.hpp"

#include <cstddef>
#include <cstring>
#include <utility>

#include "core/scene/robot_task.hpp"

namespace dmrp::core {
namespace {

struct StoredRobot {
  std::string name;
  std::vector<dmrp_goal> goals;
  dmrp_limits limits{};
  dmrp_footprint footprint{};
  std::vector<dmrp_vec2> footprint_vertices;
  dmrp_pose start{};
  std::uint32_t kinematics = DMRP_KINEMATICS_DIFFERENTIAL;
};

Shape shape_of(const dmrp_shape& shape) {
  Shape copy;
  copy.name = shape.name;
  copy.kind = shape.kind == DMRP_SHAPE_CIRCLE ? Shape::Kind::circle : Shape::Kind::polygon;
  copy.center = shape.center;
  copy.radius_m = shape.radius_m;
  copy.vertices.assign(shape.vertices, shape.vertices + shape.vertex_count);
  copy.height_m = shape.height_m;
  return copy;
}

// Copies a struct of an older or newer minor version: the fields that both versions have; the rest is zero.
template <class Struct>
Struct common_part(const Struct& theirs) {
  Struct mine{};
  std::memcpy(&mine, &theirs, std::min<std::size_t>(theirs.struct_size, sizeof(mine)));
  mine.struct_size = sizeof(mine);
  return mine;
}

StoredRobot robot_of(const dmrp_robot& robot) {
  StoredRobot copy;
  copy.name = robot.name;
  for (std::uint32_t i = 0; i < robot.goal_count; ++i)
    copy.goals.push_back(*DMRP_AT(dmrp_goal, robot.goals, robot.goal_stride, i));
  copy.limits = common_part(*robot.limits);
  copy.footprint = common_part(*robot.footprint);
  copy.footprint_vertices.assign(robot.footprint->vertices, robot.footprint->vertices + robot.footprint->vertex_count);
  copy.start = robot.start;
  copy.kinematics = robot.kinematics;
  return copy;
}

PlanningGrid grid_of(const dmrp_grid& grid) {
  const std::size_t size = std::size_t{grid.width} * grid.height;
  return {grid.width,
          grid.height,
          grid.resolution_m,
          grid.origin,
          {grid.free, grid.free + size},
          {grid.edges, grid.edges + size},
          {grid.clearance, grid.clearance + size}};
}

}  // namespace

struct WorldView::Storage {
  std::vector<Shape> shapes;
  std::vector<StoredRobot> robots;
  std::vector<dmrp_segment> segments;
  PlanningGrid planning_grid;
  PlanningGrid walking_grid;

  std::vector<dmrp_shape> sdk_shapes;
  std::vector<dmrp_robot> sdk_robots;
  dmrp_grid sdk_planning_grid{};
  dmrp_grid sdk_walking_grid{};
  dmrp_world world{};

  void set_pointers();
};

// From here on the storage must not move; it is on the heap.
void WorldView::Storage::set_pointers() {
  sdk_shapes = sdk_shapes_of(shapes);
  for (StoredRobot& robot : robots) {
    robot.footprint.vertices = robot.footprint_vertices.empty() ? nullptr : robot.footprint_vertices.data();
    dmrp_robot view{};
    view.name = robot.name.c_str();
    view.kinematics = robot.kinematics;
    view.goal_count = static_cast<std::uint32_t>(robot.goals.size());
    view.goals = robot.goals.data();
    view.goal_stride = sizeof(dmrp_goal);
    view.limits = &robot.limits;
    view.footprint = &robot.footprint;
    view.start = robot.start;
    sdk_robots.push_back(view);
  }
  sdk_planning_grid = planning_grid.view();
  sdk_walking_grid = walking_grid.view();

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
  world.walking_grid = &sdk_walking_grid;
}

WorldView::WorldView(const Scenario& scenario, const RobotSettings& robot, const SimulationSettings& simulation,
                     const StaticGeometry& geometry, const PlanningGrid& planning_grid,
                     const PlanningGrid& walking_grid, std::int64_t call_budget_ns)
    : storage_(std::make_unique<Storage>()) {
  storage_->shapes = geometry.shapes();
  for (const RobotTask& task : scenario.robots) {
    storage_->robots.push_back(
        {task.name, goals_of(task, simulation.goal), limits_of(robot), footprint_of(robot), {}, start_of(task)});
  }
  storage_->segments.assign(geometry.segments().begin(), geometry.segments().end());
  storage_->planning_grid = planning_grid;
  storage_->walking_grid = walking_grid;

  dmrp_world& world = storage_->world;
  world.person_count = person_count(scenario);
  world.lower = geometry.lower();
  world.upper = geometry.upper();
  world.step_ns = simulation.step_ns;
  world.control_period_ns = simulation.control_period_ns;
  world.time_limit_ns = simulation.time_limit_ns;
  world.call_budget_ns = call_budget_ns;
  world.self = -1;
  storage_->set_pointers();
}

WorldView::WorldView(const dmrp_world& world) : storage_(std::make_unique<Storage>()) {
  for (std::uint32_t i = 0; i < world.shape_count; ++i)
    storage_->shapes.push_back(shape_of(*DMRP_AT(dmrp_shape, world.shapes, world.shape_stride, i)));
  for (std::uint32_t i = 0; i < world.robot_count; ++i)
    storage_->robots.push_back(robot_of(*DMRP_AT(dmrp_robot, world.robots, world.robot_stride, i)));
  storage_->segments.assign(world.segments, world.segments + world.segment_count);
  storage_->planning_grid = grid_of(*world.planning_grid);
  storage_->walking_grid = grid_of(*world.walking_grid);
  storage_->world = common_part(world);
  storage_->set_pointers();
}

WorldView::~WorldView() = default;
WorldView::WorldView(WorldView&&) noexcept = default;
WorldView& WorldView::operator=(WorldView&&) noexcept = default;

const dmrp_world& WorldView::world() const {
  return storage_->world;
}

dmrp_world WorldView::seen_by(std::int32_t robot) const {
  dmrp_world world = storage_->world;
  world.self = robot;
  return world;
}

}  // namespace dmrp::core
