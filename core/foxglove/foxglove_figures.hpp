// SPDX-License-Identifier: MIT
// foxglove_figures.hpp: the figures of a trial in a 3-D scene: their shapes, sizes and colours. Internal to
// foxglove_channels.cpp.
#pragma once

#include <dmrp/sample.h>
#include <dmrp/world.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/foxglove/foxglove_scene.hpp"

namespace dmrp::core {

inline constexpr double figure_robot_height_m = 0.4;

// A robot in its own frame.
struct RobotFigure {
  std::size_t index = 0;  // gives the colour
  std::string_view name;
  double radius_m = 0.0;
  std::span<const std::vector<dmrp_vec2>> parts;  // of the outline; empty: a disc
  std::uint32_t state = DMRP_ROBOT_ACTIVE;
};

// Each adds primitives to the entity, in the world frame unless stated otherwise. `robot` gives the colour.
void draw_border(SceneEntity& entity, dmrp_vec2 lower, dmrp_vec2 upper);
void draw_shape(SceneEntity& entity, const dmrp_shape& shape);
void draw_goal(SceneEntity& entity, const dmrp_goal& goal, std::size_t robot, std::string_view label);
void draw_robot(SceneEntity& entity, const RobotFigure& robot);
void draw_person(SceneEntity& entity, const dmrp_person& person);
void draw_path(SceneEntity& entity, const dmrp_path& path, std::size_t robot);
void draw_contact(SceneEntity& entity, dmrp_vec2 point);
void draw_trajectory(SceneEntity& entity, std::span<const dmrp_pose> poses, std::size_t robot, std::uint32_t role);
void draw_halo(SceneEntity& entity, double robot_radius_m);  // around a robot, in its frame

}  // namespace dmrp::core
