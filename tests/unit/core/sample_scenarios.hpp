// SPDX-License-Identifier: MIT
// sample_scenarios.hpp: small worlds to test in.
#pragma once

#include <cmath>
#include <cstdint>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/random.hpp>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/scenario.hpp"
#include "core/scene/settings.hpp"
#include "core/scene/static_geometry.hpp"

namespace dmrp::core::test {

inline constexpr double any_heading = std::numeric_limits<double>::quiet_NaN();

inline Scenario empty_scenario(double width_m, double height_m) {
  Scenario scenario;
  scenario.name = "sample";
  scenario.upper = {width_m, height_m};
  return scenario;
}

inline Shape box(const std::string& name, dmrp_vec2 lower, dmrp_vec2 upper) {
  Shape shape;
  shape.name = name;
  shape.vertices = {lower, {upper.x, lower.y}, upper, {lower.x, upper.y}};
  return shape;
}

inline Shape circle(const std::string& name, dmrp_vec2 center, double radius_m) {
  Shape shape;
  shape.name = name;
  shape.kind = Shape::Kind::circle;
  shape.center = center;
  shape.radius_m = radius_m;
  return shape;
}

inline RobotTask robot(dmrp_pose start, std::vector<dmrp_pose> goals) {
  RobotTask task;
  task.start = start;
  task.goals = std::move(goals);
  return task;
}

inline RobotTask robot(dmrp_pose start, dmrp_vec2 goal) {
  return robot(start, std::vector<dmrp_pose>{{goal.x, goal.y, any_heading}});
}

// Turned boxes, discs and irregular polygons, some touching each other.
inline Scenario random_scenario(std::uint64_t seed, double side_m, int shapes) {
  toolkit::Stream stream(seed, "test.scenario");
  Scenario scenario = empty_scenario(side_m, side_m);
  for (int i = 0; i < shapes; ++i) {
    const dmrp_vec2 center = {stream.uniform(0.0, side_m), stream.uniform(0.0, side_m)};
    const double size_m = stream.uniform(0.1, 1.0);
    const std::string name = "shape " + std::to_string(i);
    switch (stream.below(3)) {
      case 0:
        scenario.shapes.push_back(circle(name, center, size_m));
        break;
      case 1: {
        Shape shape = box(name, {-size_m, -0.1}, {size_m, 0.1});
        const double angle = stream.uniform(-3.0, 3.0);
        shape.vertices = toolkit::to_world(dmrp_pose{center.x, center.y, angle}, shape.vertices);
        scenario.shapes.push_back(shape);
        break;
      }
      default: {
        Shape shape;
        shape.name = name;
        double angle = 0.0;
        while ((angle += stream.uniform(0.3, 1.5)) < 6.2)
          shape.vertices.push_back(center + size_m * toolkit::from_angle(angle));
        scenario.shapes.push_back(shape);
      }
    }
  }
  return scenario;
}

inline std::shared_ptr<const StaticGeometry> geometry_of(const Scenario& scenario) {
  return std::make_shared<const StaticGeometry>(scenario);
}

// A place where a disc stands free, at least `apart_m` from the others.
inline dmrp_vec2 free_place(const StaticGeometry& geometry, toolkit::Stream& stream, double radius_m,
                            const std::vector<dmrp_vec2>& others, double apart_m) {
  for (;;) {
    const dmrp_vec2 place = {stream.uniform(geometry.lower().x, geometry.upper().x),
                             stream.uniform(geometry.lower().y, geometry.upper().y)};
    bool is_free = geometry.disc_is_free(place, radius_m);
    for (const dmrp_vec2 other : others) is_free = is_free && toolkit::distance(place, other) >= apart_m;
    if (is_free) return place;
  }
}

// A hall with a kiosk and a planter, and people who walk through it both ways.
inline Scenario busy_hall(std::uint32_t people) {
  Scenario scenario = empty_scenario(30, 12);
  scenario.shapes = {box("kiosk", {14, 4}, {16, 8}), circle("planter", {8, 6}, 0.7)};
  scenario.regions = {{"west", {0.5, 1}, {2.5, 11}}, {"north", {14, 9}, {16, 11}}, {"east", {27.5, 1}, {29.5, 11}}};
  scenario.flows = {{"eastward", {0, 1, 2}, people / 2}, {"westward", {2, 0}, people - people / 2}};
  return scenario;
}

}  // namespace dmrp::core::test
