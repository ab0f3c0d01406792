// SPDX-License-Identifier: MIT
// trial_picture.hpp: the flat picture of a trial at one moment, as the report's replay shows it.
#pragma once

#include <vector>

#include "core/trace/trace_reader.hpp"
#include "host/video/canvas.hpp"

namespace dmrp::host {

// The colour of a robot, as in the report; they repeat after 24.
Color robot_color(std::size_t robot);

class TrialPicture {
 public:
  // Fits the world into `width` by `height` pixels; both sizes of the picture are even, as video formats want them.
  TrialPicture(const dmrp_world& world, int width, int height);

  // Samples in the order of time: trails grow with them.
  void observe(const dmrp_sample& sample);

  // The last observed sample, with its time.
  Canvas draw(const dmrp_sample& sample) const;

 private:
  dmrp_vec2 place(double x, double y) const;
  std::vector<dmrp_vec2> outline(const dmrp_pose& pose, const dmrp_polygon& part) const;
  void draw_shapes(Canvas& canvas) const;
  void draw_task(Canvas& canvas, std::size_t robot, const dmrp_sample& sample) const;
  void draw_robot(Canvas& canvas, std::size_t robot, const dmrp_robot_sample& state) const;

  const dmrp_world& world_;
  double scale_ = 1.0;  // pixels a metre
  std::vector<std::vector<dmrp_vec2>> trails_;
  Canvas empty_;  // the world without what moves
};

}  // namespace dmrp::host
