// SPDX-License-Identifier: MIT
#include "core/foxglove/foxglove_figures.hpp"

#include <dmrp/ext/annotate.h>

#include <algorithm>
#include <array>

#include "core/picture/colors.hpp"

namespace dmrp::core {
namespace {

constexpr std::size_t candidate_points = 8;  // approximately, of a candidate trajectory
constexpr double person_height_m = 1.7;

// Colours that differ under every kind of colour vision (Okabe and Ito, 2008).
constexpr std::array<Color, 7> series{{{0.0, 0.447, 0.698, 1.0},
                                       {0.902, 0.624, 0.0, 1.0},
                                       {0.0, 0.62, 0.451, 1.0},
                                       {0.8, 0.475, 0.655, 1.0},
                                       {0.337, 0.706, 0.914, 1.0},
                                       {0.835, 0.369, 0.0, 1.0},
                                       {0.941, 0.894, 0.259, 1.0}}};
constexpr Color wall_color{0.45, 0.45, 0.48, 1.0};
constexpr Color furniture_color{0.72, 0.62, 0.49, 1.0};
constexpr Color border_color{0.3, 0.3, 0.33, 1.0};
constexpr Color person_color{0.55, 0.58, 0.62, 0.9};
constexpr Color failed_color{0.25, 0.25, 0.25, 1.0};
constexpr Color contact_color{0.85, 0.1, 0.1, 0.8};
constexpr Color halo_color{0.95, 0.7, 0.1, 0.35};
constexpr Color label_color{1.0, 1.0, 1.0, 1.0};

Color series_color(std::size_t index, double alpha = 1.0) {
  Color color = series[index % series.size()];
  color.a = alpha;
  return color;
}

}  // namespace

void draw_border(SceneEntity& entity, dmrp_vec2 lower, dmrp_vec2 upper) {
  const std::array<ScenePose, 4> corners{{{lower.x, lower.y, 0.0, 0.0},
                                          {upper.x, lower.y, 0.0, 0.0},
                                          {upper.x, upper.y, 0.0, 0.0},
                                          {lower.x, upper.y, 0.0, 0.0}}};
  entity.line(corners, true, 0.08, border_color);
}

void draw_shape(SceneEntity& entity, const dmrp_shape& shape) {
  const Color& color = shape.height_m >= wall_height_m ? wall_color : furniture_color;
  if (shape.kind == DMRP_SHAPE_CIRCLE)
    entity.cylinder({shape.center.x, shape.center.y, 0.0, 0.0}, shape.radius_m, shape.height_m, color);
  else if (shape.kind == DMRP_SHAPE_POLYGON)
    entity.prism({shape.vertices, shape.vertex_count}, 0.0, shape.height_m, color);
}

void draw_goal(SceneEntity& entity, const dmrp_goal& goal, std::size_t robot, std::string_view label) {
  entity.cylinder({goal.pose.x, goal.pose.y, 0.0, 0.0}, std::max(goal.tolerance_m, 0.05), 0.02,
                  series_color(robot, 0.6));
  entity.text({goal.pose.x, goal.pose.y, 0.3, 0.0}, 0.3, series_color(robot), label);
}

void draw_robot(SceneEntity& entity, const RobotFigure& robot) {
  const Color color = robot.state == DMRP_ROBOT_FAILED
                          ? failed_color
                          : series_color(robot.index, robot.state == DMRP_ROBOT_FINISHED ? 0.4 : 1.0);
  if (robot.parts.empty()) entity.cylinder({}, robot.radius_m, figure_robot_height_m, color);
  for (const std::vector<dmrp_vec2>& part : robot.parts) entity.prism(part, 0.0, figure_robot_height_m, color);
  entity.arrow({0.0, 0.0, figure_robot_height_m, 0.0}, 1.6 * robot.radius_m, 0.25 * robot.radius_m, label_color);
  entity.text({0.0, 0.0, figure_robot_height_m + 0.35, 0.0}, 0.3, label_color, robot.name);
}

void draw_person(SceneEntity& entity, const dmrp_person& person) {
  entity.cylinder({person.position.x, person.position.y, 0.0, 0.0}, person.radius_m, person_height_m, person_color);
}

void draw_path(SceneEntity& entity, const dmrp_path& path, std::size_t robot) {
  std::vector<ScenePose> points;
  for (std::uint32_t i = 0; i < path.count; ++i) {
    const dmrp_waypoint& waypoint = *DMRP_AT(dmrp_waypoint, path.waypoints, path.stride, i);
    points.push_back({waypoint.x, waypoint.y, 0.03, 0.0});
  }
  entity.line(points, false, 0.06, series_color(robot, 0.8));
}

void draw_contact(SceneEntity& entity, dmrp_vec2 point) {
  entity.sphere({point.x, point.y, 0.5 * figure_robot_height_m, 0.0}, 0.3, contact_color);
}

void draw_trajectory(SceneEntity& entity, std::span<const dmrp_pose> poses, std::size_t robot, std::uint32_t role) {
  const bool predicted = role == DMRP_ANNOTATE_PREDICTED;
  const std::size_t stride = predicted ? 1 : std::max<std::size_t>(poses.size() / candidate_points, 1);
  std::vector<ScenePose> points;
  for (std::size_t i = 0; i < poses.size(); i += stride) points.push_back({poses[i].x, poses[i].y, 0.05, 0.0});
  entity.line(points, false, predicted ? 0.05 : 0.02, series_color(robot, predicted ? 0.9 : 0.3));
}

void draw_halo(SceneEntity& entity, double robot_radius_m) {
  entity.cylinder({0.0, 0.0, 0.01, 0.0}, 2.5 * robot_radius_m, 0.02, halo_color);
}

}  // namespace dmrp::core
