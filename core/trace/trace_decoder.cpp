// SPDX-License-Identifier: MIT
#include "core/trace/trace_decoder.hpp"

#include <algorithm>
#include <string_view>

namespace dmrp::core {
namespace {

// The least number of bytes of one element in a record: bounds for damaged counts.
constexpr std::size_t robot_bytes = 4 + 4 + 24 + 48 + 20 + 4;
constexpr std::size_t goal_bytes = 56;
constexpr std::size_t shape_bytes = 4 + 4 + 16 + 8 + 8 + 4;
constexpr std::size_t waypoint_bytes = 36;
constexpr std::size_t statistic_bytes = 12;
constexpr std::size_t call_bytes = 20;
constexpr std::size_t robot_end_bytes = 16;

const dmrp_limits* take_limits(ByteCursor& in, TraceStorage& storage) {
  auto* limits = allocate<dmrp_limits>(storage, 1);
  limits->struct_size = sizeof(dmrp_limits);
  for (double* value :
       {&limits->v_min, &limits->v_max, &limits->v_y_max, &limits->omega_max, &limits->a_max, &limits->alpha_max})
    *value = in.take<double>();
  return limits;
}

const dmrp_footprint* take_footprint(ByteCursor& in, TraceStorage& storage) {
  auto* footprint = allocate<dmrp_footprint>(storage, 1);
  footprint->struct_size = sizeof(dmrp_footprint);
  footprint->radius_m = in.take<double>();
  footprint->inscribed_radius_m = in.take<double>();
  footprint->vertex_count = in.take_count(sizeof(dmrp_vec2));
  footprint->vertices = take_stored<dmrp_vec2>(in, storage, footprint->vertex_count);
  return footprint;
}

dmrp_robot take_robot(ByteCursor& in, TraceStorage& storage) {
  dmrp_robot robot{};
  robot.name = take_stored_text(in, storage);
  robot.kinematics = in.take<std::uint32_t>();
  robot.start = in.take<dmrp_pose>();
  robot.limits = take_limits(in, storage);
  robot.footprint = take_footprint(in, storage);
  robot.goal_count = in.take_count(goal_bytes);
  robot.goal_stride = sizeof(dmrp_goal);
  auto* goals = allocate<dmrp_goal>(storage, robot.goal_count);
  robot.goals = goals;
  for (std::uint32_t i = 0; i < robot.goal_count; ++i) {
    goals[i].pose = in.take<dmrp_pose>();
    goals[i].tolerance_m = in.take<double>();
    goals[i].tolerance_rad = in.take<double>();
    goals[i].tolerance_speed = in.take<double>();
    goals[i].settle_ns = in.take<std::int64_t>();
  }
  return robot;
}

dmrp_shape take_shape(ByteCursor& in, TraceStorage& storage) {
  dmrp_shape shape{};
  shape.name = take_stored_text(in, storage);
  shape.kind = in.take<std::uint32_t>();
  if (shape.kind != DMRP_SHAPE_CIRCLE && shape.kind != DMRP_SHAPE_POLYGON) in.fail("a shape of unknown kind");
  shape.center = in.take<dmrp_vec2>();
  shape.radius_m = in.take<double>();
  shape.height_m = in.take<double>();
  shape.vertex_count = in.take_count(sizeof(dmrp_vec2));
  shape.vertices = take_stored<dmrp_vec2>(in, storage, shape.vertex_count);
  return shape;
}

bool take_presence(ByteCursor& in) {
  const auto presence = in.take<std::uint8_t>();
  if (presence > 1) in.fail("a presence flag other than 0 and 1");
  return presence == 1;
}

template <class Value>
const Value* take_optional(ByteCursor& in, TraceStorage& storage, std::size_t count) {
  if (!take_presence(in)) return nullptr;
  in.require(count, sizeof(Value));
  return take_stored<Value>(in, storage, count);
}

const dmrp_grid* take_grid(ByteCursor& in, TraceStorage& storage) {
  if (!take_presence(in)) return nullptr;
  auto* grid = allocate<dmrp_grid>(storage, 1);
  grid->struct_size = sizeof(dmrp_grid);
  grid->width = in.take<std::uint32_t>();
  grid->height = in.take<std::uint32_t>();
  grid->resolution_m = in.take<double>();
  grid->origin = in.take<dmrp_vec2>();
  const std::size_t cells = std::size_t{grid->width} * grid->height;
  grid->free = take_optional<std::uint8_t>(in, storage, cells);
  grid->edges = take_optional<std::uint8_t>(in, storage, cells);
  grid->clearance = take_optional<float>(in, storage, cells);
  return grid;
}

dmrp_path take_path(ByteCursor& in, TraceStorage& storage) {
  dmrp_path path{};
  path.struct_size = sizeof(dmrp_path);
  path.count = in.take_count(waypoint_bytes);
  path.stride = sizeof(dmrp_waypoint);
  auto* waypoints = allocate<dmrp_waypoint>(storage, path.count);
  path.waypoints = waypoints;
  for (std::uint32_t i = 0; i < path.count; ++i) {
    waypoints[i].x = in.take<double>();
    waypoints[i].y = in.take<double>();
    waypoints[i].theta = in.take<double>();
    waypoints[i].t_ns = in.take<std::int64_t>();
    waypoints[i].goal_index = in.take<std::uint32_t>();
  }
  return path;
}

dmrp_call take_call(ByteCursor& in) {
  dmrp_call call{};
  call.kind = in.take<std::uint32_t>();
  call.robot = in.take<std::uint32_t>();
  call.status = in.take<std::int32_t>();
  call.duration_ns = in.take<std::int64_t>();
  return call;
}

}  // namespace

const char* take_stored_text(ByteCursor& in, TraceStorage& storage) {
  const std::string_view text = in.take_text();
  char* copy = allocate<char>(storage, text.size() + 1);
  std::copy(text.begin(), text.end(), copy);
  return copy;
}

dmrp_world take_world(ByteCursor& in, TraceStorage& storage) {
  dmrp_world world{};
  world.struct_size = sizeof(dmrp_world);
  world.self = -1;
  world.person_count = in.take<std::uint32_t>();
  world.lower = in.take<dmrp_vec2>();
  world.upper = in.take<dmrp_vec2>();
  world.step_ns = in.take<std::int64_t>();
  world.control_period_ns = in.take<std::int64_t>();
  world.time_limit_ns = in.take<std::int64_t>();
  world.call_budget_ns = in.take<std::int64_t>();

  world.robot_count = in.take_count(robot_bytes);
  world.robot_stride = sizeof(dmrp_robot);
  auto* robots = allocate<dmrp_robot>(storage, world.robot_count);
  world.robots = robots;
  for (std::uint32_t i = 0; i < world.robot_count; ++i) robots[i] = take_robot(in, storage);

  world.shape_count = in.take_count(shape_bytes);
  world.shape_stride = sizeof(dmrp_shape);
  auto* shapes = allocate<dmrp_shape>(storage, world.shape_count);
  world.shapes = shapes;
  for (std::uint32_t i = 0; i < world.shape_count; ++i) shapes[i] = take_shape(in, storage);

  world.segment_count = in.take_count(sizeof(dmrp_segment));
  world.segments = take_stored<dmrp_segment>(in, storage, world.segment_count);
  world.planning_grid = take_grid(in, storage);
  world.walking_grid = take_grid(in, storage);
  return world;
}

TracePlan take_plan(ByteCursor& in, TraceStorage& storage, std::uint32_t robot_count) {
  TracePlan made;
  made.made_at_ns = in.take<std::int64_t>();
  dmrp_plan& plan = made.plan;
  plan.struct_size = sizeof(dmrp_plan);
  plan.revision = in.take<std::uint64_t>();
  plan.from_ns = in.take<std::int64_t>();
  plan.step_duration_ns = in.take<std::int64_t>();
  plan.planning_ns = in.take<std::int64_t>();
  plan.status = in.take<std::int32_t>();
  made.conflicts = in.take<std::uint32_t>();

  plan.path_count = in.take_count(sizeof(std::uint32_t));
  if (plan.path_count != 0 && plan.path_count != robot_count) in.fail("a plan without a path for every robot");
  plan.path_stride = sizeof(dmrp_path);
  auto* paths = allocate<dmrp_path>(storage, plan.path_count);
  plan.paths = paths;
  for (std::uint32_t i = 0; i < plan.path_count; ++i) paths[i] = take_path(in, storage);

  plan.statistic_count = in.take_count(statistic_bytes);
  plan.statistic_stride = sizeof(dmrp_statistic);
  auto* statistics = allocate<dmrp_statistic>(storage, plan.statistic_count);
  plan.statistics = statistics;
  for (std::uint32_t i = 0; i < plan.statistic_count; ++i) {
    statistics[i].name = take_stored_text(in, storage);
    statistics[i].value = in.take<double>();
  }
  return made;
}

dmrp_trial_end take_end(ByteCursor& in, TraceStorage& storage, std::uint32_t robot_count) {
  dmrp_trial_end end{};
  end.struct_size = sizeof(dmrp_trial_end);
  end.ending = in.take<std::uint32_t>();
  end.t_ns = in.take<std::int64_t>();
  end.robot_count = in.take_count(robot_end_bytes);
  if (end.robot_count != robot_count) in.fail("an end record with another number of robots");
  end.robot_stride = sizeof(dmrp_robot_end);
  auto* robots = allocate<dmrp_robot_end>(storage, end.robot_count);
  end.robots = robots;
  for (std::uint32_t i = 0; i < end.robot_count; ++i) {
    robots[i].state = in.take<std::uint32_t>();
    robots[i].failure = in.take<std::uint32_t>();
    robots[i].arrival_ns = in.take<std::int64_t>();
  }
  return end;
}

void take_calls(ByteCursor& in, std::vector<dmrp_call>& calls) {
  calls.resize(in.take_count(call_bytes));
  for (dmrp_call& call : calls) call = take_call(in);
}

}  // namespace dmrp::core
