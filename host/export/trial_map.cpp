// SPDX-License-Identifier: MIT
#include "host/export/trial_map.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <dmrp/toolkit/svg.hpp>
#include <vector>

namespace dmrp::host {

namespace {

constexpr double wall_height_m = 2.0;    // lower shapes are furniture
constexpr double least_step_m = 0.05;    // between the points of a way
constexpr double left_margin_px = 36.0;  // for the coordinates

using Ways = std::vector<std::vector<dmrp_vec2>>;  // by robot

void draw_world(toolkit::SvgPlan& picture, const dmrp_world& world) {
  for (std::uint32_t i = 0; i < world.shape_count; ++i) {
    const dmrp_shape& shape = *DMRP_AT(dmrp_shape, world.shapes, world.shape_stride, i);
    const char* const look = shape.height_m >= wall_height_m ? "wall" : "furniture";
    if (shape.kind == DMRP_SHAPE_CIRCLE)
      picture.circle(shape.center, shape.radius_m, {look});
    else
      picture.polygon(std::vector<dmrp_vec2>(shape.vertices, shape.vertices + shape.vertex_count), {look});
  }
}

std::vector<dmrp_vec2> points_of(const dmrp_path& path) {
  std::vector<dmrp_vec2> points;
  for (std::uint32_t i = 0; i < path.count; ++i) {
    const dmrp_waypoint& waypoint = *DMRP_AT(dmrp_waypoint, path.waypoints, path.stride, i);
    points.push_back({waypoint.x, waypoint.y});
  }
  return points;
}

void lengthen(std::vector<dmrp_vec2>& way, dmrp_vec2 to) {
  if (way.empty() || std::hypot(to.x - way.back().x, to.y - way.back().y) >= least_step_m) way.push_back(to);
}

void draw_robot(toolkit::SvgPlan& picture, const dmrp_robot& robot, std::size_t number,
                const std::vector<dmrp_vec2>& way) {
  const auto color = toolkit::series_color(number);
  const double radius_m = robot.footprint->radius_m;
  for (std::uint32_t i = 0; i < robot.goal_count; ++i) {
    const dmrp_goal& goal = *DMRP_AT(dmrp_goal, robot.goals, robot.goal_stride, i);
    picture.circle({goal.pose.x, goal.pose.y}, radius_m, {"goal", color});
  }
  picture.polyline(way, {"way", color});
  picture.circle(way.front(), 0.5 * radius_m, {"start", color});
  picture.circle(way.back(), radius_m, {"robot", color});
  picture.text({way.front().x + 0.4, way.front().y + 0.4}, std::to_string(number), {"label", color});
}

}  // namespace

std::string trial_map(core::TraceReader& trace, const std::string& title) {
  const dmrp_world& world = trace.world();
  Ways planned(world.robot_count);
  Ways driven(world.robot_count);
  std::vector<dmrp_vec2> contacts;
  while (const dmrp_sample* sample = trace.next_sample()) {
    for (std::uint32_t i = 0; i < sample->robot_count; ++i) {
      const dmrp_pose& pose = sample->robots[i].pose;
      lengthen(driven[i], {pose.x, pose.y});
      if (planned[i].empty() && sample->plan)
        planned[i] = points_of(*DMRP_AT(dmrp_path, sample->plan->paths, sample->plan->path_stride, i));
    }
    for (std::uint32_t i = 0; i < sample->contact_count; ++i) contacts.push_back(sample->contacts[i].point);
  }
  toolkit::SvgPlan picture({world.lower, world.upper}, title, 800.0, left_margin_px);
  picture.axes();
  draw_world(picture, world);
  for (std::size_t i = 0; i < planned.size(); ++i)
    if (!planned[i].empty()) picture.polyline(planned[i], {"plan", toolkit::series_color(i)});
  for (std::uint32_t i = 0; i < world.robot_count; ++i)
    if (!driven[i].empty()) draw_robot(picture, world.robots[i], i, driven[i]);
  for (const dmrp_vec2 contact : contacts) picture.circle(contact, 0.15, {"contact"}, "contact");
  picture.scale_bar(5.0);
  return picture.document();
}

}  // namespace dmrp::host
