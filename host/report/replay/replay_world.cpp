// SPDX-License-Identifier: MIT
#include "host/report/replay/replay_world.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "host/report/replay/replay_numbers.hpp"

namespace dmrp::host {
namespace {

using nlohmann::json;

json point(dmrp_vec2 at) {
  return {thousandths(at.x), thousandths(at.y)};
}

json points(const dmrp_vec2* vertices, std::uint32_t count) {
  std::vector<std::int64_t> flat;
  for (std::uint32_t i = 0; i < count; ++i) {
    flat.push_back(thousandths(vertices[i].x));
    flat.push_back(thousandths(vertices[i].y));
  }
  return flat;
}

json shape_json(const dmrp_shape& shape) {
  json to = {{"name", shape.name}, {"height", thousandths(shape.height_m)}};
  if (shape.kind == DMRP_SHAPE_CIRCLE) {
    to["center"] = point(shape.center);
    to["radius"] = thousandths(shape.radius_m);
  } else {
    to["vertices"] = points(shape.vertices, shape.vertex_count);
  }
  return to;
}

json goal_json(const dmrp_goal& goal) {
  json to = {{"at", point({goal.pose.x, goal.pose.y})}, {"tolerance", thousandths(goal.tolerance_m)}};
  if (std::isfinite(goal.pose.theta)) to["theta"] = thousandths(goal.pose.theta);
  return to;
}

json path_json(const dmrp_path& path) {
  Deltas x;
  Deltas y;
  Deltas t;
  for (std::uint32_t i = 0; i < path.count; ++i) {
    x.add(thousandths(path.waypoints[i].x));
    y.add(thousandths(path.waypoints[i].y));
    t.add(milliseconds(path.waypoints[i].t_ns));
  }
  return {{"x", std::move(x).json()}, {"y", std::move(y).json()}, {"t", std::move(t).json()}};
}

}  // namespace

json replay_world(const dmrp_world& world) {
  json shapes = json::array();
  for (std::uint32_t i = 0; i < world.shape_count; ++i) shapes.push_back(shape_json(world.shapes[i]));
  return {{"lower", point(world.lower)}, {"upper", point(world.upper)}, {"shapes", std::move(shapes)}};
}

json replay_robot(const dmrp_robot& robot) {
  json goals = json::array();
  for (std::uint32_t i = 0; i < robot.goal_count; ++i) goals.push_back(goal_json(robot.goals[i]));
  const dmrp_footprint& footprint = *robot.footprint;
  const std::string type = robot.type;
  json to = {{"name", type.empty() ? robot.name : std::string(robot.name) + " (" + type + ")"},
             {"radius", thousandths(footprint.radius_m)},
             {"v_max", thousandths(robot.limits->v_max)},
             {"goals", std::move(goals)}};
  if (robot.kinematics == DMRP_KINEMATICS_HOLONOMIC) to["drive"] = "holonomic";
  if (robot.kinematics == DMRP_KINEMATICS_ACKERMANN) {
    to["drive"] = "ackermann";
    to["wheelbase"] = thousandths(robot.limits->wheelbase_m);
  }
  for (std::uint32_t i = 0; i < footprint.part_count; ++i)
    to["parts"].push_back(points(footprint.parts[i].vertices, footprint.parts[i].vertex_count));
  return to;
}

json replay_plans(const std::deque<core::TracePlan>& plans) {
  json list = json::array();
  for (const core::TracePlan& made : plans) {
    json paths = json::array();
    for (std::uint32_t i = 0; i < made.plan.path_count; ++i) paths.push_back(path_json(made.plan.paths[i]));
    list.push_back({{"revision", made.plan.revision},
                    {"made", milliseconds(made.made_at_ns)},
                    {"from", milliseconds(made.plan.from_ns)},
                    {"paths", std::move(paths)}});
  }
  return list;
}

}  // namespace dmrp::host
