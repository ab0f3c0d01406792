// SPDX-License-Identifier: MIT
#include "core/foxglove/foxglove_schemas.hpp"

#include <string>
#include <utility>
#include <vector>

namespace dmrp::core {
namespace {

constexpr const char* number = R"({"type":"number"})";
constexpr const char* string = R"({"type":"string"})";
constexpr const char* boolean = R"({"type":"boolean"})";
constexpr const char* whole = R"({"type":"integer","minimum":0})";
constexpr const char* bytes = R"({"type":"string","contentEncoding":"base64"})";
constexpr const char* time = R"({"type":"object","title":"time","properties":{"sec":{"type":"integer","minimum":0},)"
                             R"("nsec":{"type":"integer","minimum":0,"maximum":999999999}},"required":["sec","nsec"]})";
constexpr const char* duration =
    R"({"type":"object","title":"duration","properties":{"sec":{"type":"integer"},)"
    R"("nsec":{"type":"integer","minimum":0,"maximum":999999999}},"required":["sec","nsec"]})";

using Fields = std::vector<std::pair<const char*, std::string>>;

// An object in which all fields are required.
std::string object(const std::string& title, const Fields& fields) {
  std::string properties;
  std::string names;
  for (const auto& [name, type] : fields) {
    const std::string comma = names.empty() ? "" : ",";
    const std::string quoted = '"' + std::string(name) + '"';
    properties += comma + quoted + ':' + type;
    names += comma + quoted;
  }
  return R"({"title":")" + title + R"(","type":"object","properties":{)" + properties + R"(},"required":[)" + names +
         "]}";
}

std::string array(const std::string& element) {
  return R"({"type":"array","items":)" + element + "}";
}

// Numbered from 0.
std::string enumeration(const std::string& title, const std::vector<std::string>& names) {
  std::string values;
  for (std::size_t i = 0; i < names.size(); ++i)
    values += std::string(i == 0 ? "" : ",") + R"({"title":")" + names[i] + R"(","const":)" + std::to_string(i) + "}";
  return R"({"title":")" + title + R"(","oneOf":[)" + values + "]}";
}

std::string vector3() {
  return object("foxglove.Vector3", {{"x", number}, {"y", number}, {"z", number}});
}
std::string quaternion() {
  return object("foxglove.Quaternion", {{"x", number}, {"y", number}, {"z", number}, {"w", number}});
}
std::string pose() {
  return object("foxglove.Pose", {{"position", vector3()}, {"orientation", quaternion()}});
}
std::string point3() {
  return object("foxglove.Point3", {{"x", number}, {"y", number}, {"z", number}});
}
std::string color() {
  return object("foxglove.Color", {{"r", number}, {"g", number}, {"b", number}, {"a", number}});
}

std::string arrow() {
  return object("foxglove.ArrowPrimitive", {{"pose", pose()},
                                            {"shaft_length", number},
                                            {"shaft_diameter", number},
                                            {"head_length", number},
                                            {"head_diameter", number},
                                            {"color", color()}});
}
// cubes and spheres
std::string sized(const std::string& title) {
  return object(title, {{"pose", pose()}, {"size", vector3()}, {"color", color()}});
}
std::string cylinder() {
  return object(
      "foxglove.CylinderPrimitive",
      {{"pose", pose()}, {"size", vector3()}, {"bottom_scale", number}, {"top_scale", number}, {"color", color()}});
}
std::string line() {
  return object("foxglove.LinePrimitive",
                {{"type", enumeration("foxglove.LineType", {"LINE_STRIP", "LINE_LOOP", "LINE_LIST"})},
                 {"pose", pose()},
                 {"thickness", number},
                 {"scale_invariant", boolean},
                 {"points", array(point3())},
                 {"color", color()},
                 {"colors", array(color())},
                 {"indices", array(whole)}});
}
std::string triangles() {
  return object("foxglove.TriangleListPrimitive", {{"pose", pose()},
                                                   {"points", array(point3())},
                                                   {"color", color()},
                                                   {"colors", array(color())},
                                                   {"indices", array(whole)}});
}
std::string text() {
  return object("foxglove.TextPrimitive", {{"pose", pose()},
                                           {"billboard", boolean},
                                           {"font_size", number},
                                           {"scale_invariant", boolean},
                                           {"color", color()},
                                           {"text", string}});
}
std::string model() {
  return object("foxglove.ModelPrimitive", {{"pose", pose()},
                                            {"scale", vector3()},
                                            {"color", color()},
                                            {"override_color", boolean},
                                            {"url", string},
                                            {"media_type", string},
                                            {"data", bytes}});
}

std::string entity() {
  return object("foxglove.SceneEntity",
                {{"timestamp", time},
                 {"frame_id", string},
                 {"id", string},
                 {"lifetime", duration},
                 {"frame_locked", boolean},
                 {"metadata", array(object("foxglove.KeyValuePair", {{"key", string}, {"value", string}}))},
                 {"arrows", array(arrow())},
                 {"cubes", array(sized("foxglove.CubePrimitive"))},
                 {"spheres", array(sized("foxglove.SpherePrimitive"))},
                 {"cylinders", array(cylinder())},
                 {"lines", array(line())},
                 {"triangles", array(triangles())},
                 {"texts", array(text())},
                 {"models", array(model())}});
}

McapSchema schema(const std::string& name, const Fields& fields) {
  return {name, "jsonschema", object(name, fields)};
}

}  // namespace

McapSchema scene_update_schema() {
  const std::string deletion =
      object("foxglove.SceneEntityDeletion",
             {{"timestamp", time},
              {"type", enumeration("foxglove.SceneEntityDeletionType", {"MATCHING_ID", "ALL"})},
              {"id", string}});
  return schema("foxglove.SceneUpdate", {{"deletions", array(deletion)}, {"entities", array(entity())}});
}

McapSchema frame_transforms_schema() {
  const std::string transform = object("foxglove.FrameTransform", {{"timestamp", time},
                                                                   {"parent_frame_id", string},
                                                                   {"child_frame_id", string},
                                                                   {"translation", vector3()},
                                                                   {"rotation", quaternion()}});
  return schema("foxglove.FrameTransforms", {{"transforms", array(transform)}});
}

McapSchema laser_scan_schema() {
  return schema("foxglove.LaserScan", {{"timestamp", time},
                                       {"frame_id", string},
                                       {"pose", pose()},
                                       {"start_angle", number},
                                       {"end_angle", number},
                                       {"ranges", array(number)},
                                       {"intensities", array(number)}});
}

McapSchema log_schema() {
  return schema("foxglove.Log",
                {{"timestamp", time},
                 {"level", enumeration("foxglove.LogLevel", {"UNKNOWN", "DEBUG", "INFO", "WARNING", "ERROR", "FATAL"})},
                 {"message", string},
                 {"name", string},
                 {"file", string},
                 {"line", whole}});
}

}  // namespace dmrp::core
