// SPDX-License-Identifier: MIT
// foxglove_scene.hpp: entities of a 3-D scene as JSON messages foxglove.SceneUpdate; internal to core/foxglove.
#pragma once

#include <dmrp/values.h>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/foxglove/json_text.hpp"

namespace dmrp::core {

struct Color {
  double r, g, b, a;
};

// A pose at a height z above the floor.
struct ScenePose {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  double theta = 0.0;
};

void put_time(JsonText& json, std::int64_t t_ns);  // {"sec":...,"nsec":...}
void put_position(JsonText& json, double x, double y, double z);
void put_rotation(JsonText& json, double theta);  // around z
void put_pose(JsonText& json, const ScenePose& pose);

// A set of primitives under one id. Lengths in metres; `z` is the height of a body's base.
class SceneEntity {
 public:
  void cylinder(const ScenePose& foot, double radius_m, double height_m, const Color& color);
  void sphere(const ScenePose& center, double radius_m, const Color& color);
  void arrow(const ScenePose& tail, double length_m, double thickness_m, const Color& color);
  void text(const ScenePose& center, double size_m, const Color& color, std::string_view text);
  void line(std::span<const ScenePose> points, bool closed, double thickness_m, const Color& color);
  void prism(std::span<const dmrp_vec2> outline, double z, double height_m, const Color& color);  // convex, no bottom
  void note(std::string_view key, std::string_view value);  // metadata, shown when the entity is selected

  void clear();

 private:
  friend class SceneUpdate;
  JsonText metadata_, arrows_, spheres_, cylinders_, lines_, triangles_, texts_;
};

// Builds one message.
//
//   scene.begin(t_ns);
//   scene.add(entity, "map", "shape_0", {});
//   write(scene.message());
class SceneUpdate {
 public:
  struct Where {
    std::string_view frame = "map";
    bool locked = false;           // moves with its frame
    std::int64_t lifetime_ns = 0;  // 0: until the next entity with this id
  };

  void begin(std::int64_t t_ns);
  void add(const SceneEntity& entity, std::string_view id, const Where& where);
  std::span<const std::uint8_t> message();

 private:
  JsonText json_;
  std::int64_t t_ns_ = 0;
  bool first_ = true;
};

}  // namespace dmrp::core
