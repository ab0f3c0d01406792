// SPDX-License-Identifier: MIT
// canvas.hpp: a picture of pixels on which shapes are filled with smooth edges.
#pragma once

#include <dmrp/values.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace dmrp::host {

struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
};

// "#0072b2"
Color color_of(std::string_view hex);

// Black or white, the more legible one on `color`.
Color text_on(Color color);

// Places are in pixels from the upper left corner, x to the right and y down.
class Canvas {
 public:
  Canvas(int width, int height, Color color);

  int width() const { return width_; }
  int height() const { return height_; }

  // Rows from above, of red, green and blue for each pixel.
  std::span<const std::uint8_t> bytes() const { return bytes_; }

  // A simple polygon; what overlaps of it is filled once if it winds the same way.
  void polygon(std::span<const dmrp_vec2> corners, Color color, double opacity = 1.0);
  void disc(dmrp_vec2 middle, double radius, Color color, double opacity = 1.0);
  void ring(dmrp_vec2 middle, double radius, double line_width, Color color);

  // With round ends and joins.
  void line(std::span<const dmrp_vec2> points, double line_width, Color color, double opacity = 1.0);

  // Digits, '.', 's' and spaces, each 6 times `size` pixels wide and 7 high, with the middle of the text at `middle`.
  void text(dmrp_vec2 middle, std::string_view digits, double size, Color color);

 private:
  struct Box {
    int left;
    int top;
    int right;
    int bottom;
  };

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  // Raises the mask to the share of each pixel that the polygon covers.
  void cover(std::span<const dmrp_vec2> corners);
  void cover_row(const Box& box, double left, double right);
  void paint_covered(Color color, double opacity);

  int width_;
  int height_;
  std::vector<std::uint8_t> bytes_;
  std::vector<float> mask_;  // zero between calls
  Box covered_{};            // the part of the mask in use
  std::vector<float> row_;
  std::vector<double> crossings_;
};

}  // namespace dmrp::host
