// SPDX-License-Identifier: MIT
#include "core/trace/trace_decoder.hpp"

#include <algorithm>
#include <string_view>

#include "core/trace/trace_elements.hpp"

namespace dmrp::core {
namespace {

// The least number of bytes of one element in a record: bounds for damaged counts.
constexpr std::size_t robot_bytes = 4 + 4 + 24 + 48 + 20 + 4;
constexpr std::size_t polygon_bytes = 8;
constexpr std::size_t shape_bytes = 4 + 4 + 16 + 8 + 8 + 4;
constexpr std::size_t path_bytes = 4;
constexpr std::size_t statistic_bytes = 12;

const dmrp_limits* take_limits(RecordCursor& record, TraceStorage& storage) {
  auto* limits = allocate<dmrp_limits>(storage, 1);
  limits->struct_size = sizeof(dmrp_limits);
  record.take_block([&](RecordCursor& in) {
    for (double* value :
         {&limits->v_min, &limits->v_max, &limits->v_y_max, &limits->omega_max, &limits->a_max, &limits->alpha_max})
      *value = in.take<double>();
    if (in.version() == 1) return;
    for (double* value : {&limits->wheelbase_m, &limits->steering_max, &limits->steering_rate_max})
      *value = in.take<double>();
  });
  return limits;
}

dmrp_polygon take_polygon(RecordCursor& record, TraceStorage& storage) {
  dmrp_polygon polygon{};
  record.take_block([&](RecordCursor& in) {
    polygon.vertex_count = in.take_count(sizeof(dmrp_vec2));
    polygon.vertices = take_stored<dmrp_vec2>(in, storage, polygon.vertex_count);
  });
  return polygon;
}

const dmrp_footprint* take_footprint(RecordCursor& record, TraceStorage& storage) {
  auto* footprint = allocate<dmrp_footprint>(storage, 1);
  footprint->struct_size = sizeof(dmrp_footprint);
  footprint->part_stride = sizeof(dmrp_polygon);
  record.take_block([&](RecordCursor& in) {
    footprint->radius_m = in.take<double>();
    footprint->inscribed_radius_m = in.take<double>();
    // Format version 1 has one polygon, without vertices for a disc.
    const std::uint32_t part_count = in.version() == 1 ? 1 : in.take_count(polygon_bytes);
    auto* parts = allocate<dmrp_polygon>(storage, part_count);
    for (std::uint32_t i = 0; i < part_count; ++i) parts[i] = take_polygon(in, storage);
    if (part_count == 0 || (in.version() == 1 && parts[0].vertex_count == 0)) return;
    footprint->parts = parts;
    footprint->part_count = part_count;
  });
  return footprint;
}

dmrp_robot take_robot(RecordCursor& record, TraceStorage& storage) {
  dmrp_robot robot{};
  record.take_block([&](RecordCursor& in) {
    robot.name = take_stored_text(in, storage);
    robot.kinematics = in.take<std::uint32_t>();
    robot.start = in.take<dmrp_pose>();
    robot.limits = take_limits(in, storage);
    robot.footprint = take_footprint(in, storage);
    const TraceElements stored = take_element_count<dmrp_goal>(in);
    auto* goals = allocate<dmrp_goal>(storage, stored.count);
    take_elements(in, stored, goals);
    robot.goal_count = stored.count;
    robot.goal_stride = sizeof(dmrp_goal);
    robot.goals = goals;
    robot.type = in.version() == 1 ? "" : take_stored_text(in, storage);
  });
  return robot;
}

dmrp_shape take_shape(RecordCursor& record, TraceStorage& storage) {
  dmrp_shape shape{};
  record.take_block([&](RecordCursor& in) {
    shape.name = take_stored_text(in, storage);
    shape.kind = in.take<std::uint32_t>();
    shape.center = in.take<dmrp_vec2>();
    shape.radius_m = in.take<double>();
    shape.height_m = in.take<double>();
    shape.vertex_count = in.take_count(sizeof(dmrp_vec2));
    shape.vertices = take_stored<dmrp_vec2>(in, storage, shape.vertex_count);
  });
  return shape;
}

bool take_presence(RecordCursor& in) {
  const auto presence = in.take<std::uint8_t>();
  if (presence > 1) in.fail("a presence flag other than 0 and 1");
  return presence == 1;
}

template <class Value>
const Value* take_optional(RecordCursor& in, TraceStorage& storage, std::size_t count) {
  if (!take_presence(in)) return nullptr;
  in.require(count, sizeof(Value));
  return take_stored<Value>(in, storage, count);
}

const dmrp_grid* take_grid(RecordCursor& record, TraceStorage& storage) {
  if (!take_presence(record)) return nullptr;
  auto* grid = allocate<dmrp_grid>(storage, 1);
  grid->struct_size = sizeof(dmrp_grid);
  record.take_block([&](RecordCursor& in) {
    grid->width = in.take<std::uint32_t>();
    grid->height = in.take<std::uint32_t>();
    grid->resolution_m = in.take<double>();
    grid->origin = in.take<dmrp_vec2>();
    const std::size_t cells = std::size_t{grid->width} * grid->height;
    grid->free = take_optional<std::uint8_t>(in, storage, cells);
    grid->edges = take_optional<std::uint8_t>(in, storage, cells);
    grid->clearance = take_optional<float>(in, storage, cells);
  });
  return grid;
}

dmrp_path take_path(RecordCursor& record, TraceStorage& storage) {
  dmrp_path path{};
  path.struct_size = sizeof(dmrp_path);
  path.stride = sizeof(dmrp_waypoint);
  record.take_block([&](RecordCursor& in) {
    const TraceElements stored = take_element_count<dmrp_waypoint>(in);
    auto* waypoints = allocate<dmrp_waypoint>(storage, stored.count);
    take_elements(in, stored, waypoints);
    path.count = stored.count;
    path.waypoints = waypoints;
  });
  return path;
}

dmrp_statistic take_statistic(RecordCursor& record, TraceStorage& storage) {
  dmrp_statistic statistic{};
  record.take_block([&](RecordCursor& in) {
    statistic.name = take_stored_text(in, storage);
    statistic.value = in.take<double>();
  });
  return statistic;
}

}  // namespace

const char* take_stored_text(ByteCursor& in, TraceStorage& storage) {
  const std::string_view text = in.take_text();
  char* copy = allocate<char>(storage, text.size() + 1);
  std::copy(text.begin(), text.end(), copy);
  return copy;
}

dmrp_world take_world(RecordCursor& in, TraceStorage& storage) {
  dmrp_world world{};
  world.struct_size = sizeof(dmrp_world);
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
  if (in.version() == 1)
    take_grid(in, storage);  // for the navigation of people
  else
    world.person_radius_m = in.take<double>();
  return world;
}

TracePlan take_plan(RecordCursor& in, TraceStorage& storage, std::uint32_t robot_count) {
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

  plan.path_count = in.take_count(path_bytes);
  if (plan.path_count != 0 && plan.path_count != robot_count) in.fail("a plan without a path for every robot");
  plan.path_stride = sizeof(dmrp_path);
  auto* paths = allocate<dmrp_path>(storage, plan.path_count);
  plan.paths = paths;
  for (std::uint32_t i = 0; i < plan.path_count; ++i) paths[i] = take_path(in, storage);

  plan.statistic_count = in.take_count(statistic_bytes);
  plan.statistic_stride = sizeof(dmrp_statistic);
  auto* statistics = allocate<dmrp_statistic>(storage, plan.statistic_count);
  plan.statistics = statistics;
  for (std::uint32_t i = 0; i < plan.statistic_count; ++i) statistics[i] = take_statistic(in, storage);
  return made;
}

dmrp_trial_end take_end(RecordCursor& in, TraceStorage& storage, std::uint32_t robot_count) {
  dmrp_trial_end end{};
  end.struct_size = sizeof(dmrp_trial_end);
  end.ending = in.take<std::uint32_t>();
  end.t_ns = in.take<std::int64_t>();
  const TraceElements stored = take_element_count<dmrp_robot_end>(in);
  if (stored.count != robot_count) in.fail("an end record with another number of robots");
  auto* robots = allocate<dmrp_robot_end>(storage, stored.count);
  take_elements(in, stored, robots);
  end.robots = robots;
  end.robot_count = stored.count;
  end.robot_stride = sizeof(dmrp_robot_end);
  return end;
}

void take_calls(RecordCursor& in, std::vector<dmrp_call>& calls) {
  const TraceElements stored = take_element_count<dmrp_call>(in);
  calls.resize(stored.count);
  if (in.version() > 1) return take_elements(in, stored, calls.data());
  for (dmrp_call& call : calls) {
    call = {};
    call.kind = in.take<std::uint32_t>();
    call.robot = in.take<std::uint32_t>();
    call.status = in.take<std::int32_t>();
    call.duration_ns = in.take<std::int64_t>();
  }
}

}  // namespace dmrp::core
