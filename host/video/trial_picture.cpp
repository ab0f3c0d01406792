// SPDX-License-Identifier: MIT
#include "host/video/trial_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <dmrp/toolkit/polygon.hpp>
#include <string>

namespace dmrp::host {
namespace {

constexpr double wall_height_m = 2.0;  // lower shapes are furniture
constexpr double margin_px = 12.0;
constexpr double least_robot_px = 7.0;  // radius of a disc
constexpr double least_person_px = 3.0;
constexpr double least_step_px = 2.0;  // of trails
constexpr Color floor_color = {255, 255, 255};
constexpr Color outside = {246, 247, 248};
constexpr Color wall = {89, 97, 107};
constexpr Color furniture = {211, 208, 198};
constexpr Color person = {125, 135, 146};
constexpr Color contact_color = {166, 60, 0};
constexpr Color ink = {26, 29, 33};

// --series-1 to --series-24 of the report's style sheet.
constexpr std::array<const char*, 24> robot_colors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
                                                      "#3a3f45", "#b8a800", "#000db8", "#8e52fd", "#8e4f6a", "#5b007f",
                                                      "#830f05", "#715b13", "#cc0e9e", "#4643d0", "#7e7fd0", "#cc103d",
                                                      "#511522", "#d1a194", "#f6486f", "#c66cf7", "#7f1f63", "#352053"};

int even(double size) {
  return std::max(2, 2 * static_cast<int>(std::ceil(size / 2.0)));
}

}  // namespace

Color robot_color(std::size_t robot) {
  return color_of(robot_colors[robot % robot_colors.size()]);
}

TrialPicture::TrialPicture(const dmrp_world& world, int width, int height)
    : world_(world), trails_(world.robot_count), empty_(2, 2, outside) {
  const double world_width_m = world.upper.x - world.lower.x;
  const double world_height_m = world.upper.y - world.lower.y;
  scale_ = std::min((width - 2.0 * margin_px) / world_width_m, (height - 2.0 * margin_px) / world_height_m);
  empty_ =
      Canvas(even(scale_ * world_width_m + 2.0 * margin_px), even(scale_ * world_height_m + 2.0 * margin_px), outside);
  draw_shapes(empty_);
}

dmrp_vec2 TrialPicture::place(double x, double y) const {
  return {margin_px + (x - world_.lower.x) * scale_, margin_px + (world_.upper.y - y) * scale_};
}

void TrialPicture::draw_shapes(Canvas& canvas) const {
  const auto [left, top] = place(world_.lower.x, world_.upper.y);
  const auto [right, bottom] = place(world_.upper.x, world_.lower.y);
  const std::vector<dmrp_vec2> border = {{left, top}, {right, top}, {right, bottom}, {left, bottom}, {left, top}};
  canvas.polygon(std::span(border).first(4), floor_color);
  for (std::uint32_t i = 0; i < world_.shape_count; ++i) {
    const dmrp_shape& shape = *DMRP_AT(dmrp_shape, world_.shapes, world_.shape_stride, i);
    const Color color = shape.height_m >= wall_height_m ? wall : furniture;
    if (shape.kind == DMRP_SHAPE_CIRCLE) {
      canvas.disc(place(shape.center.x, shape.center.y), shape.radius_m * scale_, color);
      continue;
    }
    std::vector<dmrp_vec2> corners;
    for (std::uint32_t v = 0; v < shape.vertex_count; ++v)
      corners.push_back(place(shape.vertices[v].x, shape.vertices[v].y));
    canvas.polygon(corners, color);
  }
  canvas.line(border, 2.0, wall);
}

void TrialPicture::observe(const dmrp_sample& sample) {
  for (std::uint32_t i = 0; i < sample.robot_count; ++i) {
    const dmrp_pose& pose = sample.robots[i].pose;
    const dmrp_vec2 at = place(pose.x, pose.y);
    std::vector<dmrp_vec2>& trail = trails_[i];
    if (trail.empty() || std::hypot(at.x - trail.back().x, at.y - trail.back().y) >= least_step_px) trail.push_back(at);
  }
}

// The goal and the path in force.
void TrialPicture::draw_task(Canvas& canvas, std::size_t robot, const dmrp_sample& sample) const {
  const dmrp_robot& known = world_.robots[robot];
  const Color color = robot_color(robot);
  const std::uint32_t goal_index = std::min(sample.robots[robot].goal_index, known.goal_count - 1);
  const dmrp_goal& goal = *DMRP_AT(dmrp_goal, known.goals, known.goal_stride, goal_index);
  const dmrp_vec2 at = place(goal.pose.x, goal.pose.y);
  const double radius = std::max(least_robot_px, known.footprint->radius_m * scale_);
  canvas.ring(at, radius, 1.5, color);
  canvas.disc(at, 0.3 * radius, color);
  if (!sample.plan) return;
  const dmrp_path& path = *DMRP_AT(dmrp_path, sample.plan->paths, sample.plan->path_stride, robot);
  std::vector<dmrp_vec2> points;
  for (std::uint32_t i = 0; i < path.count; ++i) {
    const dmrp_waypoint& waypoint = *DMRP_AT(dmrp_waypoint, path.waypoints, path.stride, i);
    points.push_back(place(waypoint.x, waypoint.y));
  }
  canvas.line(points, 1.5, color, 0.35);
}

std::vector<dmrp_vec2> TrialPicture::outline(const dmrp_pose& pose, const dmrp_polygon& part) const {
  std::vector<dmrp_vec2> corners;
  for (std::uint32_t v = 0; v < part.vertex_count; ++v) {
    const dmrp_vec2 at = part.vertices[v];
    corners.push_back(place(pose.x + at.x * std::cos(pose.theta) - at.y * std::sin(pose.theta),
                            pose.y + at.x * std::sin(pose.theta) + at.y * std::cos(pose.theta)));
  }
  return corners;
}

void TrialPicture::draw_robot(Canvas& canvas, std::size_t robot, const dmrp_robot_sample& state) const {
  const dmrp_footprint& footprint = *world_.robots[robot].footprint;
  const Color color = robot_color(robot);
  const dmrp_vec2 at = place(state.pose.x, state.pose.y);
  const double radius = std::max(least_robot_px, footprint.radius_m * scale_);
  const auto around = [&](double distance, double angle) {
    return dmrp_vec2{at.x + distance * std::cos(state.pose.theta + angle),
                     at.y - distance * std::sin(state.pose.theta + angle)};
  };
  const std::array<dmrp_vec2, 3> heading = {around(1.75 * radius, 0.0), around(radius, 0.65), around(radius, -0.65)};
  canvas.polygon(heading, color);
  if (footprint.part_count == 0) {
    canvas.disc(at, radius + 1.0, floor_color);
    canvas.disc(at, radius, color);
  }
  for (std::uint32_t i = 0; i < footprint.part_count; ++i)
    canvas.polygon(outline(state.pose, *DMRP_AT(dmrp_polygon, footprint.parts, footprint.part_stride, i)), color);
  if (state.state == DMRP_ROBOT_FAILED) canvas.ring(at, radius + 3.0, 2.5, contact_color);
  canvas.text(at, std::to_string(robot), robot < 10 ? 1.2 : 1.0, text_on(color));
}

Canvas TrialPicture::draw(const dmrp_sample& sample) const {
  Canvas canvas = empty_;
  for (std::uint32_t i = 0; i < sample.robot_count; ++i) {
    draw_task(canvas, i, sample);
    canvas.line(trails_[i], 2.0, robot_color(i), 0.7);
  }
  for (std::uint32_t i = 0; i < sample.person_count; ++i) {
    const dmrp_person& one = sample.people[i];
    const dmrp_vec2 at = place(one.position.x, one.position.y);
    const double radius = std::max(least_person_px, one.radius_m * scale_);
    canvas.disc(at, radius, person);
    const double speed = std::hypot(one.velocity.x, one.velocity.y);
    if (speed < 0.1) continue;
    const std::array<dmrp_vec2, 2> nose = {
        at, {at.x + 1.4 * radius * one.velocity.x / speed, at.y - 1.4 * radius * one.velocity.y / speed}};
    canvas.line(nose, 2.0, person);
  }
  for (std::uint32_t i = 0; i < sample.robot_count; ++i) draw_robot(canvas, i, sample.robots[i]);
  for (std::uint32_t i = 0; i < sample.contact_count; ++i)
    canvas.ring(place(sample.contacts[i].point.x, sample.contacts[i].point.y), 14.0, 3.0, contact_color);
  const std::string time = fmt::format("{:.1f} s", static_cast<double>(sample.t_ns) * 1e-9);
  const double width_px = 12.0 * static_cast<double>(time.size());
  const std::array<dmrp_vec2, 4> box = {{{4, 4}, {16 + width_px, 4}, {16 + width_px, 26}, {4, 26}}};
  canvas.polygon(box, floor_color, 0.85);
  canvas.text({10 + width_px / 2.0, 15}, time, 2.0, ink);
  return canvas;
}

}  // namespace dmrp::host
