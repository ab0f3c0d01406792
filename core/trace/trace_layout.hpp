// SPDX-License-Identifier: MIT
// trace_layout.hpp: the fields of each record in their order, once for writing and for reading. Internal to traces.
//
// `io` is a TraceFieldWriter, which writes the fields, or a TraceFieldReader, which fills them in.
#pragma once

#include <dmrp/sample.h>
#include <dmrp/trial_end.h>
#include <dmrp/world.h>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/trace/trace_contents.hpp"

namespace dmrp::core {

template <class Type, class Struct>
concept Of = std::same_as<std::remove_const_t<Type>, Struct>;

void fields(auto& io, Of<dmrp_limits> auto& limits) {
  io.values(limits.v_min, limits.v_max, limits.v_y_max, limits.omega_max, limits.a_max, limits.alpha_max,
            limits.wheelbase_m, limits.steering_max, limits.steering_rate_max);
}

void fields(auto& io, Of<dmrp_polygon> auto& polygon) {
  io.array(polygon.vertices, polygon.vertex_count);
}

void fields(auto& io, Of<dmrp_footprint> auto& footprint) {
  io.values(footprint.radius_m, footprint.inscribed_radius_m);
  io.structs(footprint.parts, footprint.part_count, footprint.part_stride);
}

void fields(auto& io, Of<dmrp_robot> auto& robot) {
  io.text(robot.name);
  io.text(robot.type);
  io.values(robot.kinematics, robot.start);
  io.pointer(robot.limits);
  io.pointer(robot.footprint);
  io.elements(robot.goals, robot.goal_count, robot.goal_stride);
}

void fields(auto& io, Of<dmrp_shape> auto& shape) {
  io.text(shape.name);
  io.values(shape.kind, shape.center, shape.radius_m, shape.height_m);
  io.array(shape.vertices, shape.vertex_count);
}

void fields(auto& io, Of<dmrp_grid> auto& grid) {
  io.values(grid.width, grid.height, grid.resolution_m, grid.origin);
  const std::size_t cells = std::size_t{grid.width} * grid.height;
  io.optional_array(grid.free, cells);
  io.optional_array(grid.edges, cells);
  io.optional_array(grid.clearance, cells);
}

void fields(auto& io, Of<TraceWorld> auto& content) {
  auto& world = content.world;
  io.values(content.format_version, world.person_count, world.lower, world.upper, world.step_ns,
            world.control_period_ns, world.time_limit_ns, world.call_budget_ns, world.person_radius_m);
  io.structs(world.robots, world.robot_count, world.robot_stride);
  io.structs(world.shapes, world.shape_count, world.shape_stride);
  io.array(world.segments, world.segment_count);
  io.optional_pointer(world.planning_grid);
}

void fields(auto& io, Of<dmrp_path> auto& path) {
  io.values(path.flags);
  io.elements(path.waypoints, path.count, path.stride);
}

void fields(auto& io, Of<TraceRoute> auto& route) {
  io.values(route.robot, route.update_flags, route.path_flags, route.kept);
  io.elements(route.waypoints, route.count, route.stride);
}

void fields(auto& io, Of<dmrp_statistic> auto& statistic) {
  io.text(statistic.name);
  io.values(statistic.value);
}

void fields(auto& io, Of<TracePlan> auto& content) {
  auto& plan = content.plan;
  io.values(content.made_at_ns, plan.revision, plan.from_ns, plan.step_duration_ns, plan.planning_ns, plan.processor_ns,
            plan.status, content.conflicts);
  io.structs(plan.paths, plan.path_count, plan.path_stride);
  io.structs(plan.statistics, plan.statistic_count, plan.statistic_stride);
}

// Robots, people and contacts are most of a trace. They are copied in their memory layout, which has no padding.
void fields(auto& io, Of<TraceSample> auto& content) {
  auto& sample = content.sample;
  io.values(sample.t_ns, sample.dt_ns, sample.control_tick, content.plan_revision);
  io.elements(sample.robots, sample.robot_count, sample.robot_stride);
  io.elements(sample.people, sample.person_count, sample.person_stride);
  io.elements(sample.contacts, sample.contact_count, sample.contact_stride);
  io.elements(sample.calls, sample.call_count, sample.call_stride);
  io.elements(sample.events, sample.event_count, sample.event_stride);
  io.structs(content.routes, content.route_count, content.route_stride);
}

void fields(auto& io, Of<TraceScan> auto& scan) {
  io.values(scan.t_ns, scan.robot, scan.angle_min, scan.angle_increment, scan.range_min, scan.range_max);
  io.array(scan.ranges);
}

void fields(auto& io, Of<TraceTrajectory> auto& trajectory) {
  io.values(trajectory.t_ns, trajectory.source, trajectory.role, trajectory.step_ns);
  io.array(trajectory.poses);
}

void fields(auto& io, Of<TraceNote> auto& note) {
  io.values(note.t_ns, note.source);
  io.text(note.text);
}

void fields(auto& io, Of<TraceEnd> auto& content) {
  auto& end = content.end;
  io.values(end.ending, end.t_ns);
  io.elements(end.robots, end.robot_count, end.robot_stride);
  io.text(content.reason);
}

}  // namespace dmrp::core
