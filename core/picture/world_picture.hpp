// SPDX-License-Identifier: MIT
// world_picture.hpp: the picture of a world: the plan of its shapes with coordinates, title, scale and legend, and what is
// planned and moves in it.
#pragma once

#include <dmrp/person.h>
#include <dmrp/world.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/picture/painter.hpp"

namespace dmrp::core {

// What a legend explains.
enum class Mark : std::uint8_t {
  wall,
  furniture,
  region,
  flow,
  goal,
  start,
  robot,
  failed,
  plan,
  path,
  way,
  person,
  walk,
  contact
};

// The picture has this `format`: frames have a size in dots, documents fit the world.
struct Page {
  PictureFormat format = PictureFormat::svg;
  double width = 0.0;
  double height = 0.0;
};

// Places are in metres of the world. Robots have the colours of their numbers; in small pictures of large worlds, bodies
// are larger than they are. What is drawn later lies on top.
class WorldPicture {
 public:
  // Draws the world on a grid whose lines are named in metres. `title` may be empty.
  WorldPicture(const Page& page, dmrp_vec2 lower, dmrp_vec2 upper, std::string_view title);

  void shape(const dmrp_shape& shape);
  void shapes(const dmrp_world& world);
  void region(dmrp_vec2 lower, dmrp_vec2 upper);
  void flow(dmrp_vec2 from, dmrp_vec2 to);
  void name(dmrp_vec2 at, std::string_view words, Anchor anchor = Anchor::middle);  // of a region or a robot

  void goal(std::size_t robot, const dmrp_footprint& footprint, const dmrp_pose& pose);
  void start(std::size_t robot, dmrp_vec2 at);  // with its number
  void robot(std::size_t robot, const dmrp_footprint& footprint, const dmrp_pose& pose,
             std::uint32_t state = DMRP_ROBOT_ACTIVE);
  void number(std::size_t robot, const dmrp_footprint& footprint,
              dmrp_vec2 at);  // on a large body at this place, beside a small one
  // plan (beside ways; dashed), path (where nothing has moved yet), way, or walk, which has no robot's colour.
  void line(Mark mark, std::size_t robot, std::span<const dmrp_vec2> points);
  void person(const dmrp_person& person);
  void contact(dmrp_vec2 at);

  void legend(std::span<const Mark> marks);
  void clock(std::string_view words);  // at the right of the title

  Painter& painter() { return painter_; }

 private:
  // The world's place on the page, in pixels.
  struct Layout {
    Layout(const Page& page, dmrp_vec2 lower, dmrp_vec2 upper);
    double zoom = 1.0;
    double width = 0.0;
    double height = 0.0;
    double scale = 1.0;  // pixels a metre
    dmrp_vec2 corner{};  // upper left
  };

  dmrp_vec2 place(dmrp_vec2 at) const;
  std::vector<dmrp_vec2> places(std::span<const dmrp_vec2> points) const;
  void axes();
  void scale_bar();
  void body(const dmrp_footprint& footprint, const dmrp_pose& pose, const Look& look);
  double body_px(double radius_m, double least_px) const;
  void arrow(dmrp_vec2 from, dmrp_vec2 to);
  void cross(dmrp_vec2 at);
  void number_at(std::size_t robot, dmrp_vec2 at);
  void sample(Mark mark, dmrp_vec2 at);

  dmrp_vec2 lower_;
  dmrp_vec2 upper_;
  Layout layout_;
  Painter painter_;
};

}  // namespace dmrp::core
