// SPDX-License-Identifier: MIT
#include "core/foxglove/foxglove_scene.hpp"

#include <cassert>
#include <cmath>

namespace dmrp::core {
namespace {

constexpr std::int64_t second_ns = 1'000'000'000;

void put_color(JsonText& json, const Color& color) {
  json.raw(R"({"r":)").number(color.r).raw(R"(,"g":)").number(color.g);
  json.raw(R"(,"b":)").number(color.b).raw(R"(,"a":)").number(color.a).raw("}");
}

void put_points(JsonText& json, std::span<const ScenePose> points) {
  json.raw("[");
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) json.raw(",");
    put_position(json, points[i].x, points[i].y, points[i].z);
  }
  json.raw("]");
}

}  // namespace

void put_time(JsonText& json, std::int64_t t_ns) {
  json.raw(R"({"sec":)").integer(t_ns / second_ns).raw(R"(,"nsec":)").integer(t_ns % second_ns).raw("}");
}

void put_position(JsonText& json, double x, double y, double z) {
  json.raw(R"({"x":)").number(x).raw(R"(,"y":)").number(y).raw(R"(,"z":)").number(z).raw("}");
}

void put_rotation(JsonText& json, double theta) {
  if (theta == 0.0) {  // most things: nobody sees where a disc looks
    json.raw(R"({"x":0,"y":0,"z":0,"w":1})");
    return;
  }
  json.raw(R"({"x":0,"y":0,"z":)").number(std::sin(0.5 * theta));
  json.raw(R"(,"w":)").number(std::cos(0.5 * theta)).raw("}");
}

void put_pose(JsonText& json, const ScenePose& pose) {
  json.raw(R"({"position":)");
  put_position(json, pose.x, pose.y, pose.z);
  json.raw(R"(,"orientation":)");
  put_rotation(json, pose.theta);
  json.raw("}");
}

void SceneEntity::cylinder(const ScenePose& foot, double radius_m, double height_m, const Color& color) {
  cylinders_.comma_unless_first().raw(R"({"pose":)");
  put_pose(cylinders_, {foot.x, foot.y, foot.z + 0.5 * height_m, foot.theta});
  cylinders_.raw(R"(,"size":)");
  put_position(cylinders_, 2.0 * radius_m, 2.0 * radius_m, height_m);
  cylinders_.raw(R"(,"bottom_scale":1,"top_scale":1,"color":)");
  put_color(cylinders_, color);
  cylinders_.raw("}");
}

void SceneEntity::sphere(const ScenePose& center, double radius_m, const Color& color) {
  spheres_.comma_unless_first().raw(R"({"pose":)");
  put_pose(spheres_, center);
  spheres_.raw(R"(,"size":)");
  put_position(spheres_, 2.0 * radius_m, 2.0 * radius_m, 2.0 * radius_m);
  spheres_.raw(R"(,"color":)");
  put_color(spheres_, color);
  spheres_.raw("}");
}

void SceneEntity::arrow(const ScenePose& tail, double length_m, double thickness_m, const Color& color) {
  constexpr double head_share = 0.4;  // of the length
  arrows_.comma_unless_first().raw(R"({"pose":)");
  put_pose(arrows_, tail);
  arrows_.raw(R"(,"shaft_length":)").number((1.0 - head_share) * length_m);
  arrows_.raw(R"(,"shaft_diameter":)").number(thickness_m);
  arrows_.raw(R"(,"head_length":)").number(head_share * length_m);
  arrows_.raw(R"(,"head_diameter":)").number(2.0 * thickness_m).raw(R"(,"color":)");
  put_color(arrows_, color);
  arrows_.raw("}");
}

void SceneEntity::text(const ScenePose& center, double size_m, const Color& color, std::string_view text) {
  texts_.comma_unless_first().raw(R"({"pose":)");
  put_pose(texts_, center);
  texts_.raw(R"(,"billboard":true,"font_size":)").number(size_m).raw(R"(,"scale_invariant":false,"color":)");
  put_color(texts_, color);
  texts_.raw(R"(,"text":)").string(text).raw("}");
}

void SceneEntity::line(std::span<const ScenePose> points, bool closed, double thickness_m, const Color& color) {
  lines_.comma_unless_first().raw(closed ? R"({"type":1,"pose":)" : R"({"type":0,"pose":)");
  put_pose(lines_, {});
  lines_.raw(R"(,"thickness":)").number(thickness_m).raw(R"(,"scale_invariant":false,"points":)");
  put_points(lines_, points);
  lines_.raw(R"(,"color":)");
  put_color(lines_, color);
  lines_.raw(R"(,"colors":[],"indices":[]})");
}

void SceneEntity::prism(std::span<const dmrp_vec2> outline, double z, double height_m, const Color& color) {
  const std::size_t n = outline.size();
  assert(n >= 3);
  std::vector<ScenePose> points;  // the foot of every corner, then its top
  for (const double at : {z, z + height_m})
    for (const dmrp_vec2& corner : outline) points.push_back({corner.x, corner.y, at, 0.0});
  triangles_.comma_unless_first().raw(R"({"pose":)");
  put_pose(triangles_, {});
  triangles_.raw(R"(,"points":)");
  put_points(triangles_, points);
  triangles_.raw(R"(,"color":)");
  put_color(triangles_, color);
  triangles_.raw(R"(,"colors":[],"indices":[)");
  JsonText indices;
  const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
    for (const std::size_t index : {a, b, c}) indices.comma_unless_first().integer(static_cast<std::int64_t>(index));
  };
  for (std::size_t i = 0; i < n; ++i) {  // the outer face has its corners counter-clockwise
    const std::size_t next = (i + 1) % n;
    triangle(i, next, n + next);
    triangle(i, n + next, n + i);
  }
  for (std::size_t i = 1; i + 1 < n; ++i) triangle(n, n + i, n + i + 1);
  triangles_.raw(indices.text()).raw("]}");
}

void SceneEntity::note(std::string_view key, std::string_view value) {
  metadata_.comma_unless_first().raw(R"({"key":)").string(key).raw(R"(,"value":)").string(value).raw("}");
}

void SceneEntity::clear() {
  for (JsonText* list : {&metadata_, &arrows_, &spheres_, &cylinders_, &lines_, &triangles_, &texts_}) list->clear();
}

void SceneUpdate::begin(std::int64_t t_ns) {
  json_.clear();
  json_.raw(R"({"deletions":[],"entities":[)");
  t_ns_ = t_ns;
  first_ = true;
}

void SceneUpdate::add(const SceneEntity& entity, std::string_view id, const Where& where) {
  json_.raw(first_ ? R"({"timestamp":)" : R"(,{"timestamp":)");
  first_ = false;
  put_time(json_, t_ns_);
  json_.raw(R"(,"frame_id":)").string(where.frame).raw(R"(,"id":)").string(id).raw(R"(,"lifetime":)");
  put_time(json_, where.lifetime_ns);
  json_.raw(where.locked ? R"(,"frame_locked":true)" : R"(,"frame_locked":false)");
  json_.raw(R"(,"metadata":[)").raw(entity.metadata_.text());
  json_.raw(R"(],"arrows":[)").raw(entity.arrows_.text());
  json_.raw(R"(],"cubes":[],"spheres":[)").raw(entity.spheres_.text());
  json_.raw(R"(],"cylinders":[)").raw(entity.cylinders_.text());
  json_.raw(R"(],"lines":[)").raw(entity.lines_.text());
  json_.raw(R"(],"triangles":[)").raw(entity.triangles_.text());
  json_.raw(R"(],"texts":[)").raw(entity.texts_.text());
  json_.raw(R"(],"models":[]})");
}

std::span<const std::uint8_t> SceneUpdate::message() {
  json_.raw("]}");
  return json_.bytes();
}

}  // namespace dmrp::core
