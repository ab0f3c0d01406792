// SPDX-License-Identifier: MIT
#include "host/export/trial_map.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/svg.hpp>
#include <map>
#include <vector>

namespace dmrp::host {

namespace {

constexpr double wall_height_m = 2.0;    // lower shapes are furniture
constexpr double least_step_m = 0.05;    // between the points of a way
constexpr double left_margin_px = 36.0;  // for the coordinates

using Way = std::vector<dmrp_vec2>;

// What moved in a trial.
struct Ways {
  explicit Ways(std::uint32_t robots) : planned(robots), driven(robots), last(robots) {}

  std::vector<Way> planned;            // by robot
  std::vector<Way> driven;             // by robot
  std::vector<dmrp_pose> last;         // by robot
  std::map<std::uint64_t, Way> walks;  // by the person's id
  std::vector<dmrp_vec2> contacts;
};

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

// The footprint at a pose; its circle where the heading is free.
void draw_footprint(toolkit::SvgPlan& picture, const dmrp_footprint& footprint, const dmrp_pose& pose,
                    const toolkit::SvgStyle& style) {
  if (footprint.part_count == 0 || std::isnan(pose.theta))
    return picture.circle({pose.x, pose.y}, footprint.radius_m, style);
  for (std::uint32_t i = 0; i < footprint.part_count; ++i) {
    const dmrp_polygon& part = *DMRP_AT(dmrp_polygon, footprint.parts, footprint.part_stride, i);
    picture.polygon(toolkit::to_world(pose, toolkit::PolygonView(part.vertices, part.vertex_count)), style);
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

void draw_robot(toolkit::SvgPlan& picture, const dmrp_robot& robot, std::size_t number, const Way& way,
                const dmrp_pose& last) {
  const auto color = toolkit::series_color(number);
  for (std::uint32_t i = 0; i < robot.goal_count; ++i) {
    const dmrp_goal& goal = *DMRP_AT(dmrp_goal, robot.goals, robot.goal_stride, i);
    draw_footprint(picture, *robot.footprint, goal.pose, {"goal", color});
  }
  picture.polyline(way, {"way", color});
  picture.circle(way.front(), 0.5 * robot.footprint->inscribed_radius_m, {"start", color});
  draw_footprint(picture, *robot.footprint, last, {"robot", color});
  picture.text({way.front().x + 0.4, way.front().y + 0.4}, std::to_string(number), {"label", color});
}

Ways ways_of(core::TraceReader& trace) {
  Ways ways(trace.world().robot_count);
  while (const dmrp_sample* sample = trace.next_sample()) {
    for (std::uint32_t i = 0; i < sample->robot_count; ++i) {
      ways.last[i] = sample->robots[i].pose;
      lengthen(ways.driven[i], {ways.last[i].x, ways.last[i].y});
      if (ways.planned[i].empty() && sample->plan)
        ways.planned[i] = points_of(*DMRP_AT(dmrp_path, sample->plan->paths, sample->plan->path_stride, i));
    }
    for (std::uint32_t i = 0; i < sample->person_count; ++i) {
      const dmrp_person& person = *DMRP_AT(dmrp_person, sample->people, sample->person_stride, i);
      lengthen(ways.walks[person.id], person.position);
    }
    for (std::uint32_t i = 0; i < sample->contact_count; ++i) ways.contacts.push_back(sample->contacts[i].point);
  }
  return ways;
}

}  // namespace

std::string trial_map(core::TraceReader& trace, const std::string& title) {
  const dmrp_world& world = trace.world();
  const Ways ways = ways_of(trace);
  toolkit::SvgPlan picture({world.lower, world.upper}, title, 800.0, left_margin_px);
  picture.axes();
  draw_world(picture, world);
  for (const auto& [id, walk] : ways.walks) picture.polyline(walk, {"walk"});
  for (std::size_t i = 0; i < ways.planned.size(); ++i)
    if (!ways.planned[i].empty()) picture.polyline(ways.planned[i], {"plan", toolkit::series_color(i)});
  for (std::uint32_t i = 0; i < world.robot_count; ++i)
    if (!ways.driven[i].empty()) draw_robot(picture, world.robots[i], i, ways.driven[i], ways.last[i]);
  for (const dmrp_vec2 contact : ways.contacts) picture.circle(contact, 0.15, {"contact"}, "contact");
  picture.scale_bar(5.0);
  return picture.document();
}

}  // namespace dmrp::host
