// SPDX-License-Identifier: MIT
// trace_layout.hpp: the fields of each record in their order, the one list of them. Internal to traces.
//
// `io` is a TraceFieldWriter, which writes the fields, a TraceFieldReader, which fills them in, or lists them for the
// schema (trace_schema.cpp).
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

// Fields, after a text with their names.
#define DMRP_NAMED(...) #__VA_ARGS__, __VA_ARGS__

// Values, stored as in memory, which has no padding: writer and reader copy them, the schema has their fields.

void fields(auto& io, Of<dmrp_vec2> auto& vec) {
  io.values(DMRP_NAMED(vec.x, vec.y));
}

void fields(auto& io, Of<dmrp_pose> auto& pose) {
  io.values(DMRP_NAMED(pose.x, pose.y, pose.theta));
}

void fields(auto& io, Of<dmrp_twist> auto& twist) {
  io.values(DMRP_NAMED(twist.v_x, twist.v_y, twist.omega));
}

void fields(auto& io, Of<dmrp_segment> auto& segment) {
  io.values(DMRP_NAMED(segment.from, segment.to));
}

void fields(auto& io, Of<dmrp_goal> auto& goal) {
  io.values(DMRP_NAMED(goal.pose, goal.tolerance_m, goal.tolerance_rad, goal.tolerance_speed, goal.settle_ns));
}

void fields(auto& io, Of<dmrp_waypoint> auto& waypoint) {
  io.values(DMRP_NAMED(waypoint.x, waypoint.y, waypoint.theta, waypoint.t_ns, waypoint.goal_index, waypoint.reserved));
}

void fields(auto& io, Of<dmrp_robot_sample> auto& robot) {
  io.values(DMRP_NAMED(robot.pose, robot.velocity, robot.command, robot.state, robot.goal_index, robot.progress_m,
                       robot.steering_angle, robot.answer, robot.answer_status, robot.reserved));
}

void fields(auto& io, Of<dmrp_person> auto& person) {
  io.values(DMRP_NAMED(person.id, person.group, person.target_id, person.position, person.velocity, person.radius_m,
                       person.desired_speed, person.target, person.area_lower, person.area_upper, person.reaction,
                       person.reserved));
}

void fields(auto& io, Of<dmrp_contact> auto& contact) {
  io.values(DMRP_NAMED(contact.kind, contact.flags, contact.a, contact.b, contact.depth_m, contact.point,
                       contact.impact_speed));
}

void fields(auto& io, Of<dmrp_call> auto& call) {
  io.values(DMRP_NAMED(call.kind, call.robot, call.status, call.reserved));
  io.clock(DMRP_NAMED(call.duration_ns));
}

void fields(auto& io, Of<dmrp_robot_event> auto& event) {
  io.values(DMRP_NAMED(event.kind, event.robot, event.t_ns, event.detail, event.other));
}

void fields(auto& io, Of<dmrp_robot_end> auto& end) {
  io.values(DMRP_NAMED(end.state, end.failure, end.arrival_ns, end.visits, end.culprit));
}

void fields(auto& io, Of<AnnotationSource> auto& source) {
  io.values(DMRP_NAMED(source.plugin_kind, source.robot));
}

// Structs, each a block, and the records.

void fields(auto& io, Of<dmrp_limits> auto& limits) {
  io.values(DMRP_NAMED(limits.v_min, limits.v_max, limits.v_y_max, limits.omega_max, limits.a_max, limits.alpha_max,
                       limits.wheelbase_m, limits.steering_max, limits.steering_rate_max));
}

void fields(auto& io, Of<dmrp_polygon> auto& polygon) {
  io.array(DMRP_NAMED(polygon.vertices, polygon.vertex_count));
}

void fields(auto& io, Of<dmrp_footprint> auto& footprint) {
  io.values(DMRP_NAMED(footprint.radius_m, footprint.inscribed_radius_m));
  io.structs(DMRP_NAMED(footprint.parts, footprint.part_count, footprint.part_stride));
}

void fields(auto& io, Of<dmrp_robot> auto& robot) {
  io.text(DMRP_NAMED(robot.name));
  io.text(DMRP_NAMED(robot.type));
  io.values(DMRP_NAMED(robot.kinematics, robot.start));
  io.pointer(DMRP_NAMED(robot.limits));
  io.pointer(DMRP_NAMED(robot.footprint));
  io.elements(DMRP_NAMED(robot.goals, robot.goal_count, robot.goal_stride));
}

void fields(auto& io, Of<dmrp_shape> auto& shape) {
  io.text(DMRP_NAMED(shape.name));
  io.values(DMRP_NAMED(shape.kind, shape.center, shape.radius_m, shape.height_m));
  io.array(DMRP_NAMED(shape.vertices, shape.vertex_count));
}

void fields(auto& io, Of<dmrp_grid> auto& grid) {
  io.values(DMRP_NAMED(grid.width, grid.height, grid.resolution_m, grid.origin));
  io.optional_array(DMRP_NAMED(grid.free, grid.width, grid.height));
  io.optional_array(DMRP_NAMED(grid.edges, grid.width, grid.height));
  io.optional_array(DMRP_NAMED(grid.clearance, grid.width, grid.height));
}

void fields(auto& io, Of<TraceWorld> auto& content) {
  auto& world = content.world;
  io.values(DMRP_NAMED(content.format_version, world.person_count, world.lower, world.upper, world.step_ns,
                       world.control_period_ns, world.time_limit_ns, world.call_budget_ns, world.person_radius_m));
  io.structs(DMRP_NAMED(world.robots, world.robot_count, world.robot_stride));
  io.structs(DMRP_NAMED(world.shapes, world.shape_count, world.shape_stride));
  io.array(DMRP_NAMED(world.segments, world.segment_count));
  io.optional_pointer(DMRP_NAMED(world.planning_grid));
}

void fields(auto& io, Of<dmrp_path> auto& path) {
  io.values(DMRP_NAMED(path.flags));
  io.elements(DMRP_NAMED(path.waypoints, path.count, path.stride));
}

void fields(auto& io, Of<TraceRoute> auto& route) {
  io.values(DMRP_NAMED(route.robot, route.update_flags, route.path_flags, route.kept));
  io.elements(DMRP_NAMED(route.waypoints, route.count, route.stride));
}

void fields(auto& io, Of<dmrp_statistic> auto& statistic) {
  io.text(DMRP_NAMED(statistic.name));
  io.values(DMRP_NAMED(statistic.value));
}

void fields(auto& io, Of<TracePlan> auto& content) {
  auto& plan = content.plan;
  io.values(DMRP_NAMED(content.made_at_ns, plan.revision, plan.from_ns, plan.step_duration_ns));
  io.clock(DMRP_NAMED(plan.planning_ns));
  io.clock(DMRP_NAMED(plan.processor_ns));
  io.values(DMRP_NAMED(plan.status, content.conflicts));
  io.structs(DMRP_NAMED(plan.paths, plan.path_count, plan.path_stride));
  io.structs(DMRP_NAMED(plan.statistics, plan.statistic_count, plan.statistic_stride));
}

void fields(auto& io, Of<TraceSample> auto& content) {
  auto& sample = content.sample;
  io.values(DMRP_NAMED(sample.t_ns, sample.dt_ns, sample.control_tick, content.plan_revision));
  io.elements(DMRP_NAMED(sample.robots, sample.robot_count, sample.robot_stride));
  io.elements(DMRP_NAMED(sample.people, sample.person_count, sample.person_stride));
  io.elements(DMRP_NAMED(sample.contacts, sample.contact_count, sample.contact_stride));
  io.elements(DMRP_NAMED(sample.calls, sample.call_count, sample.call_stride));
  io.elements(DMRP_NAMED(sample.events, sample.event_count, sample.event_stride));
  io.structs(DMRP_NAMED(content.routes, content.route_count, content.route_stride));
}

void fields(auto& io, Of<TraceScan> auto& scan) {
  io.values(DMRP_NAMED(scan.t_ns, scan.robot, scan.angle_min, scan.angle_increment, scan.range_min, scan.range_max));
  io.array(DMRP_NAMED(scan.ranges));
}

void fields(auto& io, Of<TraceTrajectory> auto& trajectory) {
  io.values(DMRP_NAMED(trajectory.t_ns, trajectory.source, trajectory.role, trajectory.step_ns));
  io.array(DMRP_NAMED(trajectory.poses));
}

void fields(auto& io, Of<TraceNote> auto& note) {
  io.values(DMRP_NAMED(note.t_ns, note.source));
  io.text(DMRP_NAMED(note.text));
}

void fields(auto& io, Of<TraceEnd> auto& content) {
  auto& end = content.end;
  io.values(DMRP_NAMED(end.ending, end.t_ns));
  io.elements(DMRP_NAMED(end.robots, end.robot_count, end.robot_stride));
  io.text(DMRP_NAMED(content.reason));
}

#undef DMRP_NAMED

}  // namespace dmrp::core
