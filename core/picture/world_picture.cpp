// SPDX-License-Identifier: MIT
#include "core/picture/world_picture.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

namespace dmrp::core {
namespace {

using namespace toolkit;

constexpr double plan_width_px = 800.0;  // at most, of a document
constexpr double plan_height_px = 1000.0;
constexpr double least_width_px = 640.0;  // of a document, for its legend
constexpr double png_zoom = 2.0;          // legible when printed
constexpr double frame_height_px = 640.0;
constexpr double left_px = 40.0;  // margins of the plan, for coordinates, title and legend
constexpr double right_px = 16.0;
constexpr double top_px = 44.0;
constexpr double bottom_px = 84.0;
constexpr double legend_row_px = 17.0;
constexpr double title_px = 17.0;  // smaller where the title is long
constexpr double clock_px = 180.0;
constexpr double least_robot_px = 4.5;  // radii
constexpr double least_person_px = 2.5;

constexpr Ink white = ink_of(0xffffff);
constexpr Ink text_ink = ink_of(0x333333);
constexpr Ink region_ink = ink_of(0x56b4e9);
constexpr Ink flow_ink = ink_of(0x2a7aa8);
constexpr Ink name_ink = ink_of(0x1f5f85);
constexpr Ink person_ink = ink_of(0x7d8792);
constexpr Ink walk_ink = ink_of(0x6b5a36);
constexpr Ink contact_ink = ink_of(0xa63c00);
constexpr Ink any_robot = ink_of(0x3a3f45);  // in legends

const Look floor_look = {ink_of(0xfafaf7), ink_of(0x444444), 2.0};

// How a legend shows a mark.
enum class Form { box, disc, line, arrow, cross };

struct Style {
  Mark mark;
  const char* name;
  Form form;
  Look look;
};

const std::array<Style, 14> styles = {{
    {Mark::wall, "wall", Form::box, {ink_of(0x4a4f57), {}}},
    {Mark::furniture, "furniture", Form::box, {ink_of(0xc9c4b8), ink_of(0x8c877b), 0.75}},
    {Mark::region, "where people come from and go to", Form::box, {region_ink.fainter(0.15), region_ink, 0.75, true}},
    {Mark::flow, "flow of people", Form::arrow, {{}, flow_ink.fainter(0.7), 1.5}},
    {Mark::start, "start", Form::disc, {white, any_robot, 1.75}},
    {Mark::goal, "goal", Form::disc, {any_robot.fainter(0.2), any_robot, 1.25, true}},
    {Mark::robot, "robot", Form::disc, {any_robot, white, 1.0}},
    {Mark::failed, "robot that failed", Form::disc, {{}, contact_ink, 2.0}},
    {Mark::plan, "planned path", Form::line, {{}, any_robot.fainter(0.8), 1.5, true}},
    {Mark::path, "planned path", Form::line, {{}, any_robot.fainter(0.8), 2.5}},
    {Mark::way, "way driven", Form::line, {{}, any_robot, 2.25}},
    {Mark::person, "person", Form::disc, {person_ink, white, 0.75}},
    {Mark::walk, "way of a person", Form::line, {{}, walk_ink.fainter(0.6), 0.75}},
    {Mark::contact, "contact", Form::cross, {{}, contact_ink, 2.5}},
}};

const Style& style_of(Mark mark) {
  return *std::find_if(styles.begin(), styles.end(), [&](const Style& style) { return style.mark == mark; });
}

const Look& look_of(Mark mark) {
  return style_of(mark).look;
}

// A mark of a robot has the robot's colour.
Look look_of(Mark mark, std::size_t robot) {
  Look look = look_of(mark);
  for (std::optional<Ink>* ink : {&look.fill, &look.line})
    if (*ink && (*ink)->fainter(0.0) == any_robot.fainter(0.0)) *ink = robot_ink(robot).fainter((*ink)->opacity);
  return look;
}

// Letters on white need darker inks than marks do.
Ink darker(const Ink& ink) {
  const auto part = [](std::uint8_t value) { return static_cast<std::uint8_t>(value * 7 / 10); };
  return {part(ink.red), part(ink.green), part(ink.blue)};
}

std::string number_text(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value + 0.0, std::chars_format::general, 6);
  return {text.data(), end.ptr};
}

// 1, 2 or 5 times a power of ten, at least `step`.
double nice_step(double step) {
  const double power = std::pow(10.0, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= step * (1.0 - 1e-9)) return factor * power;
  return 10.0 * power;
}

}  // namespace

WorldPicture::Layout::Layout(const Page& page, dmrp_vec2 lower, dmrp_vec2 upper) {
  const bool is_frame = page.format == PictureFormat::frame;
  const dmrp_vec2 size_m = upper - lower;
  double room_x = plan_width_px;
  double room_y = plan_height_px;
  if (is_frame) {
    zoom = page.height / frame_height_px;
    width = page.width / zoom;
    height = page.height / zoom;
    room_x = width - left_px - right_px;
    room_y = height - top_px - bottom_px;
  }
  scale = std::min(room_x / size_m.x, room_y / size_m.y);
  if (!is_frame) {
    zoom = page.format == PictureFormat::png ? png_zoom : 1.0;
    width = std::max(std::ceil(scale * size_m.x) + left_px + right_px, least_width_px);
    height = std::ceil(scale * size_m.y) + top_px + bottom_px;
    room_y = scale * size_m.y;
  }
  corner = {left_px + 0.5 * (width - left_px - right_px - scale * size_m.x),
            top_px + 0.5 * (room_y - scale * size_m.y)};
}

WorldPicture::WorldPicture(const Page& page, dmrp_vec2 lower, dmrp_vec2 upper, std::string_view title)
    : lower_(lower),
      upper_(upper),
      layout_(page, lower, upper),
      painter_(page.format, layout_.width, layout_.height, layout_.zoom) {
  TextLook heading = {title_px, text_ink, Anchor::begin, true};
  const double room_px = layout_.width - left_px - right_px - (page.format == PictureFormat::frame ? clock_px : 0.0);
  heading.size_px *= std::min(1.0, room_px / std::max(1.0, painter_.text_width(title, heading)));
  painter_.text({left_px, 0.5 * top_px}, title, heading);
  const std::array<dmrp_vec2, 4> corners = {lower, {upper.x, lower.y}, upper, {lower.x, upper.y}};
  painter_.polygon(places(corners), floor_look);
  axes();
  scale_bar();
}

dmrp_vec2 WorldPicture::place(dmrp_vec2 at) const {
  return {layout_.corner.x + layout_.scale * (at.x - lower_.x), layout_.corner.y + layout_.scale * (upper_.y - at.y)};
}

std::vector<dmrp_vec2> WorldPicture::places(std::span<const dmrp_vec2> points) const {
  std::vector<dmrp_vec2> all;
  all.reserve(points.size());
  for (const dmrp_vec2 point : points) all.push_back(place(point));
  return all;
}

// Every fifth line of the grid has its coordinate in the margin.
void WorldPicture::axes() {
  const double step = nice_step(16.0 / layout_.scale);
  const auto lines = [&](double from, double to, const auto& draw) {
    const std::int64_t last = std::llround(std::floor(to / step + 1e-9));
    for (std::int64_t i = std::llround(std::ceil(from / step - 1e-9)); i <= last; ++i) {
      const bool is_major = i % 5 == 0;
      draw(static_cast<double>(i) * step, is_major,
           Look{{}, ink_of(is_major ? 0xbbbbbb : 0xdddddd), is_major ? 0.75 : 0.5});
    }
  };
  const TextLook below = {10.0, ink_of(0x666666)};
  TextLook beside = below;
  beside.anchor = Anchor::end;
  lines(lower_.x, upper_.x, [&](double x, bool is_major, const Look& look) {
    const std::array<dmrp_vec2, 2> ends = {place({x, lower_.y}), place({x, upper_.y})};
    painter_.line(ends, look);
    if (is_major) painter_.text(ends[0] + dmrp_vec2{0.0, 10.0}, number_text(x), below);
  });
  lines(lower_.y, upper_.y, [&](double y, bool is_major, const Look& look) {
    const std::array<dmrp_vec2, 2> ends = {place({lower_.x, y}), place({upper_.x, y})};
    painter_.line(ends, look);
    if (is_major) painter_.text(ends[0] - dmrp_vec2{6.0, 0.0}, number_text(y), beside);
  });
  painter_.text({layout_.width - right_px, layout_.height - bottom_px + 32.0}, "x and y in m", beside);
}

// A quarter of the plan at most.
void WorldPicture::scale_bar() {
  const double length_m = nice_step(0.1 * (upper_.x - lower_.x));
  const double length_px = layout_.scale * length_m;
  const dmrp_vec2 from = {left_px, layout_.height - bottom_px + 32.0};
  const Look look = {{}, text_ink, 1.0};
  for (const double end : {0.0, length_px}) {
    const std::array<dmrp_vec2, 2> tick = {from + dmrp_vec2{end, -3.0}, from + dmrp_vec2{end, 3.0}};
    painter_.line(tick, look);
  }
  const std::array<dmrp_vec2, 2> bar = {from, from + dmrp_vec2{length_px, 0.0}};
  painter_.line(bar, look);
  painter_.text(bar[1] + dmrp_vec2{7.0, 0.0}, number_text(length_m) + " m", {11.0, text_ink, Anchor::begin});
}

void WorldPicture::shape(const dmrp_shape& shape) {
  const Look& look = look_of(shape.height_m >= wall_height_m ? Mark::wall : Mark::furniture);
  if (shape.kind == DMRP_SHAPE_CIRCLE)
    painter_.disc(place(shape.center), layout_.scale * shape.radius_m, look);
  else
    painter_.polygon(places({shape.vertices, shape.vertex_count}), look);
}

void WorldPicture::shapes(const dmrp_world& world) {
  for (std::uint32_t i = 0; i < world.shape_count; ++i)
    shape(*DMRP_AT(dmrp_shape, world.shapes, world.shape_stride, i));
}

void WorldPicture::region(dmrp_vec2 lower, dmrp_vec2 upper) {
  const std::array<dmrp_vec2, 4> corners = {lower, {upper.x, lower.y}, upper, {lower.x, upper.y}};
  painter_.polygon(places(corners), look_of(Mark::region));
}

// On the page.
void WorldPicture::arrow(dmrp_vec2 from, dmrp_vec2 to) {
  const dmrp_vec2 back = 7.0 * normalized(from - to);
  const std::array<dmrp_vec2, 2> shaft = {from, to};
  const std::array<dmrp_vec2, 3> head = {to + rotate(back, 0.45), to, to + rotate(back, -0.45)};
  painter_.line(shaft, look_of(Mark::flow));
  painter_.line(head, look_of(Mark::flow));
}

void WorldPicture::flow(dmrp_vec2 from, dmrp_vec2 to) {
  arrow(place(from), place(to));
}

void WorldPicture::name(dmrp_vec2 at, std::string_view words, Anchor anchor) {
  painter_.text(place(at), words, {10.0, name_ink, anchor, false, true});
}

double WorldPicture::body_px(double radius_m, double least_px) const {
  return std::max(layout_.scale * radius_m, least_px);
}

// A disc where the heading is free, or the outline would be too small.
void WorldPicture::body(const dmrp_footprint& footprint, const dmrp_pose& pose, const Look& look) {
  const double radius_px = body_px(footprint.radius_m, least_robot_px);
  if (footprint.part_count == 0 || std::isnan(pose.theta) || radius_px > layout_.scale * footprint.radius_m)
    return painter_.disc(place({pose.x, pose.y}), radius_px, look);
  for (std::uint32_t i = 0; i < footprint.part_count; ++i) {
    const dmrp_polygon& part = *DMRP_AT(dmrp_polygon, footprint.parts, footprint.part_stride, i);
    painter_.polygon(places(to_world(pose, PolygonView(part.vertices, part.vertex_count))), look);
  }
}

void WorldPicture::goal(std::size_t robot, const dmrp_footprint& footprint, const dmrp_pose& pose) {
  body(footprint, pose, look_of(Mark::goal, robot));
}

void WorldPicture::start(std::size_t robot, dmrp_vec2 at) {
  painter_.disc(place(at), 3.5, look_of(Mark::start, robot));
  number_at(robot, place(at) + dmrp_vec2{9.0, -9.0});
}

// A body has a nose where it looks.
void WorldPicture::robot(std::size_t robot, const dmrp_footprint& footprint, const dmrp_pose& pose,
                         std::uint32_t state) {
  const dmrp_vec2 at = place({pose.x, pose.y});
  const double radius_px = body_px(footprint.radius_m, least_robot_px);
  const auto around = [&](double distance, double angle) {
    const dmrp_vec2 step = distance * from_angle(pose.theta + angle);
    return at + dmrp_vec2{step.x, -step.y};
  };
  if (!std::isnan(pose.theta)) {
    const double reach_px = std::max(1.75 * radius_px, radius_px + 6.0);
    const std::array<dmrp_vec2, 3> nose = {around(reach_px, 0.0), around(radius_px, 0.75), around(radius_px, -0.75)};
    painter_.polygon(nose, {robot_ink(robot)});
  }
  body(footprint, pose, look_of(Mark::robot, robot));
  if (state == DMRP_ROBOT_FAILED) painter_.disc(at, radius_px + 3.5, look_of(Mark::failed));
}

void WorldPicture::number_at(std::size_t robot, dmrp_vec2 at) {
  painter_.text(at, std::to_string(robot), {11.0, darker(robot_ink(robot)), Anchor::middle, true, true});
}

void WorldPicture::number(std::size_t robot, const dmrp_footprint& footprint, dmrp_vec2 at) {
  const double radius_px = body_px(footprint.radius_m, least_robot_px);
  const double aside = radius_px > 11.0 ? 0.0 : 0.75 * radius_px + 6.0;
  number_at(robot, place(at) + dmrp_vec2{aside, -aside});
}

void WorldPicture::line(Mark mark, std::size_t robot, std::span<const dmrp_vec2> points) {
  painter_.line(places(points), look_of(mark, robot));
}

void WorldPicture::person(const dmrp_person& person) {
  const dmrp_vec2 at = place(person.position);
  const double radius_px = body_px(person.radius_m, least_person_px);
  painter_.disc(at, radius_px, look_of(Mark::person));
  if (norm(person.velocity) < 0.1) return;
  const dmrp_vec2 ahead = 1.6 * radius_px * normalized(person.velocity);
  const std::array<dmrp_vec2, 2> nose = {at, at + dmrp_vec2{ahead.x, -ahead.y}};
  painter_.line(nose, {{}, person_ink, 1.5});
}

void WorldPicture::contact(dmrp_vec2 at) {
  cross(place(at));
}

// On the page. A form that nothing else has: it is known without its colour.
void WorldPicture::cross(dmrp_vec2 at) {
  for (const Look& look : {Look{{}, white, 5.0}, look_of(Mark::contact)})
    for (const double side : {-1.0, 1.0}) {
      const std::array<dmrp_vec2, 2> stroke = {at + dmrp_vec2{-5.0, -5.0 * side}, at + dmrp_vec2{5.0, 5.0 * side}};
      painter_.line(stroke, look);
    }
}

// The mark in a legend, about 22 pixels wide.
void WorldPicture::sample(Mark mark, dmrp_vec2 at) {
  const Style& style = style_of(mark);
  const std::array<dmrp_vec2, 4> box = {at + dmrp_vec2{-10.0, -5.0}, at + dmrp_vec2{10.0, -5.0},
                                        at + dmrp_vec2{10.0, 5.0}, at + dmrp_vec2{-10.0, 5.0}};
  const std::array<dmrp_vec2, 2> line = {at - dmrp_vec2{11.0, 0.0}, at + dmrp_vec2{11.0, 0.0}};
  switch (style.form) {
    case Form::box:
      return painter_.polygon(box, style.look);
    case Form::disc:
      return painter_.disc(at, 4.5, style.look);
    case Form::line:
      return painter_.line(line, style.look);
    case Form::arrow:
      return arrow(line[0], line[1]);
    case Form::cross:
      return cross(at);
  }
}

void WorldPicture::legend(std::span<const Mark> marks) {
  const TextLook look = {11.0, text_ink, Anchor::begin};
  dmrp_vec2 at = {left_px, layout_.height - bottom_px + 52.0};
  for (const Mark mark : marks) {
    const double width = 30.0 + painter_.text_width(style_of(mark).name, look);
    if (at.x + width > layout_.width - right_px) at = {left_px, at.y + legend_row_px};
    sample(mark, at + dmrp_vec2{11.0, 0.0});
    painter_.text(at + dmrp_vec2{30.0, 0.0}, style_of(mark).name, look);
    at.x += width + 20.0;
  }
}

void WorldPicture::clock(std::string_view words) {
  painter_.text({layout_.width - right_px, 0.5 * top_px}, words, {title_px, text_ink, Anchor::end, true});
}

}  // namespace dmrp::core
