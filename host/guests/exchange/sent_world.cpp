// SPDX-License-Identifier: MIT
#include "host/guests/exchange/sent_world.hpp"

#include <cstdint>

namespace dmrp::host {

namespace {

std::size_t cells(std::uint32_t width, std::uint32_t height) {
  return std::size_t{width} * height;
}

const dmrp_footprint* sent_footprint(Arena& arena, const dmrp_footprint& footprint) {
  dmrp_footprint* const out = arena.copy(footprint);
  if (footprint.part_count == 0) return out;
  auto* const parts = arena.make<dmrp_polygon>(footprint.part_count);
  for (std::uint32_t i = 0; i < footprint.part_count; ++i) {
    parts[i] = *DMRP_AT(dmrp_polygon, footprint.parts, footprint.part_stride, i);
    parts[i].vertices = arena.copy(parts[i].vertices, parts[i].vertex_count);
  }
  out->parts = parts;
  out->part_stride = sizeof(dmrp_polygon);
  return out;
}

const dmrp_robot* sent_robots(Arena& arena, const dmrp_world& world) {
  auto* const robots = arena.make<dmrp_robot>(world.robot_count);
  for (std::uint32_t i = 0; i < world.robot_count; ++i) {
    dmrp_robot& robot = robots[i];
    robot = *DMRP_AT(dmrp_robot, world.robots, world.robot_stride, i);
    robot.name = arena.copy_text(robot.name);
    robot.type = arena.copy_text(robot.type);
    auto* const goals = arena.make<dmrp_goal>(robot.goal_count);
    for (std::uint32_t g = 0; g < robot.goal_count; ++g)
      goals[g] = *DMRP_AT(dmrp_goal, robot.goals, robot.goal_stride, g);
    robot.goals = goals;
    robot.goal_stride = sizeof(dmrp_goal);
    robot.limits = arena.copy(*robot.limits);
    robot.footprint = sent_footprint(arena, *robot.footprint);
  }
  return robots;
}

const dmrp_shape* sent_shapes(Arena& arena, const dmrp_world& world) {
  auto* const shapes = arena.make<dmrp_shape>(world.shape_count);
  for (std::uint32_t i = 0; i < world.shape_count; ++i) {
    dmrp_shape& shape = shapes[i];
    shape = *DMRP_AT(dmrp_shape, world.shapes, world.shape_stride, i);
    shape.name = arena.copy_text(shape.name);
    if (shape.vertices) shape.vertices = arena.copy(shape.vertices, shape.vertex_count);
  }
  return shapes;
}

const dmrp_grid* sent_grid(Arena& arena, const dmrp_grid& grid, SentGrids& sent) {
  const dmrp_grid*& known = sent[grid.free];
  if (known) return known;
  dmrp_grid* const out = arena.copy(grid);
  const std::size_t count = cells(grid.width, grid.height);
  out->free = arena.copy(grid.free, count);
  out->edges = arena.copy(grid.edges, count);
  out->clearance = arena.copy(grid.clearance, count);
  return known = out;
}

}  // namespace

SentWorld::SentWorld(Arena& arena, const dmrp_world& world) : world_(arena.copy(world)) {
  copy_all(arena, world);
}

SentWorld::SentWorld(Arena& arena, const dmrp_world& world, const SentWorld& shared)
    : world_(arena.copy(world)), grids_(shared.grids_) {
  copy_all(arena, world);
}

void SentWorld::copy_all(Arena& arena, const dmrp_world& world) {
  world_->robots = sent_robots(arena, world);
  world_->robot_stride = sizeof(dmrp_robot);
  world_->shapes = sent_shapes(arena, world);
  world_->shape_stride = sizeof(dmrp_shape);
  world_->segments = arena.copy(world.segments, world.segment_count);
  if (world.planning_grid) world_->planning_grid = add_grid(arena, *world.planning_grid);
}

const dmrp_grid* SentWorld::add_grid(Arena& arena, const dmrp_grid& grid) {
  return sent_grid(arena, grid, grids_);
}

const dmrp_grid* SentWorld::find_grid(const dmrp_grid& grid) const {
  const auto known = grids_.find(grid.free);
  return known == grids_.end() ? nullptr : known->second;
}

const dmrp_planning_problem* SentWorld::copy(Arena& arena, const dmrp_planning_problem& problem) const {
  SentGrids grids = grids_;
  dmrp_planning_problem* const out = arena.copy(problem);
  auto* const robots = arena.make<dmrp_planning_robot>(problem.robot_count);
  for (std::uint32_t i = 0; i < problem.robot_count; ++i) {
    dmrp_planning_robot& robot = robots[i];
    robot = *DMRP_AT(dmrp_planning_robot, problem.robots, problem.robot_stride, i);
    robot.goals = arena.copy(robot.goals, robot.goal_count);
    robot.robot = &world_->robots[i];
    robot.grid = sent_grid(arena, *robot.grid, grids);
  }
  out->robots = robots;
  out->robot_stride = sizeof(dmrp_planning_robot);
  out->grid = sent_grid(arena, *problem.grid, grids);
  if (problem.in_force_count > 0)
    out->in_force = sent_paths(arena, problem.in_force, problem.in_force_count, problem.in_force_stride);
  out->in_force_stride = sizeof(dmrp_path);
  return out;
}

dmrp_observation SentWorld::copy(Arena& arena, const dmrp_observation& observation) const {
  dmrp_observation out = observation;
  out.goal = arena.copy(*observation.goal);
  out.limits = world_->robots[observation.robot].limits;
  out.footprint = world_->robots[observation.robot].footprint;
  out.agents = observation.agent_count > 0 ? arena.copy(observation.agents, observation.agent_count) : nullptr;
  return out;
}

const dmrp_path* sent_paths(Arena& arena, const dmrp_path* paths, std::uint32_t count, std::uint32_t stride) {
  auto* const out = arena.make<dmrp_path>(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    out[i] = *DMRP_AT(dmrp_path, paths, stride, i);
    out[i].waypoints = arena.copy(out[i].waypoints, out[i].count);
  }
  return out;
}

const dmrp_trial_end* sent(Arena& arena, const dmrp_trial_end& end) {
  dmrp_trial_end* const out = arena.copy(end);
  out->robots = arena.copy(end.robots, end.robot_count);
  return out;
}

const dmrp_scan* sent(Arena& arena, const dmrp_scan& scan) {
  dmrp_scan* const out = arena.copy(scan);
  out->ranges = arena.copy(scan.ranges, scan.count);
  return out;
}

const dmrp_costmap* sent(Arena& arena, const dmrp_costmap& costmap) {
  dmrp_costmap* const out = arena.copy(costmap);
  out->costs = arena.copy(costmap.costs, cells(costmap.width, costmap.height));
  return out;
}

const dmrp_field* sent(Arena& arena, const dmrp_field& field) {
  dmrp_field* const out = arena.copy(field);
  out->distances_m = arena.copy(field.distances_m, cells(field.width, field.height));
  return out;
}

const dmrp_obstacle_cluster_list* sent(Arena& arena, const dmrp_obstacle_cluster_list& list) {
  dmrp_obstacle_cluster_list* const out = arena.copy(list);
  auto* const clusters = arena.make<dmrp_obstacle_cluster>(list.count);
  for (std::uint32_t i = 0; i < list.count; ++i) {
    clusters[i] = *DMRP_AT(dmrp_obstacle_cluster, list.clusters, list.stride, i);
    clusters[i].vertices = arena.copy(clusters[i].vertices, clusters[i].vertex_count);
  }
  out->clusters = clusters;
  out->stride = sizeof(dmrp_obstacle_cluster);
  return out;
}

}  // namespace dmrp::host
