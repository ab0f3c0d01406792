// SPDX-License-Identifier: MIT
#include "host/video/canvas.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>
#include <numbers>

namespace dmrp::host {
namespace {

constexpr int scans_a_row = 4;
constexpr std::size_t circle_corners = 28;
constexpr std::size_t end_corners = 10;  // of the ends of thin lines

// Rows from above, of five pixels each.
struct Glyph {
  char letter;
  std::array<const char*, 7> rows;
};
constexpr std::array<Glyph, 12> glyphs = {{
    {'0', {" ### ", "#   #", "#  ##", "# # #", "##  #", "#   #", " ### "}},
    {'1', {"  #  ", " ##  ", "  #  ", "  #  ", "  #  ", "  #  ", " ### "}},
    {'2', {" ### ", "#   #", "    #", "   # ", "  #  ", " #   ", "#####"}},
    {'3', {" ### ", "#   #", "    #", "  ## ", "    #", "#   #", " ### "}},
    {'4', {"   # ", "  ## ", " # # ", "#  # ", "#####", "   # ", "   # "}},
    {'5', {"#####", "#    ", "#### ", "    #", "    #", "#   #", " ### "}},
    {'6', {"  ## ", " #   ", "#    ", "#### ", "#   #", "#   #", " ### "}},
    {'7', {"#####", "    #", "   # ", "  #  ", "  #  ", "  #  ", "  #  "}},
    {'8', {" ### ", "#   #", "#   #", " ### ", "#   #", "#   #", " ### "}},
    {'9', {" ### ", "#   #", "#   #", " ####", "    #", "   # ", " ##  "}},
    {'.', {"     ", "     ", "     ", "     ", "     ", " ##  ", " ##  "}},
    {'s', {"     ", "     ", " ### ", "#    ", " ### ", "    #", "#### "}},
}};

std::uint8_t mixed(std::uint8_t below, std::uint8_t above, double share) {
  return static_cast<std::uint8_t>(std::lround(below + (above - below) * share));
}

template <std::size_t count = circle_corners>
std::array<dmrp_vec2, count> circle(dmrp_vec2 middle, double radius) {
  std::array<dmrp_vec2, count> corners{};
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / count;
    corners[i] = {middle.x + radius * std::cos(angle), middle.y + radius * std::sin(angle)};
  }
  return corners;
}

int pixel(double place, int size) {
  return static_cast<int>(std::clamp(place, 0.0, static_cast<double>(size)));
}

// Where the polygon's edges cross a horizontal line, from the left.
void crossings(std::span<const dmrp_vec2> corners, double y, std::vector<double>& out) {
  out.clear();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const dmrp_vec2 a = corners[i];
    const dmrp_vec2 b = corners[(i + 1) % corners.size()];
    if ((a.y <= y) != (b.y <= y)) out.push_back(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
  }
  std::sort(out.begin(), out.end());
}

}  // namespace

Color color_of(std::string_view hex) {
  const auto part = [&](std::size_t at) {
    std::uint8_t value = 0;
    std::from_chars(hex.data() + at, hex.data() + at + 2, value, 16);
    return value;
  };
  return {part(1), part(3), part(5)};
}

Color text_on(Color color) {
  const double light = 0.299 * color.red + 0.587 * color.green + 0.114 * color.blue;
  return light > 140.0 ? Color{17, 17, 17} : Color{255, 255, 255};
}

Canvas::Canvas(int width, int height, Color color)
    : width_(width), height_(height), mask_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
  bytes_.reserve(3 * mask_.size());
  for (std::size_t i = 0; i < mask_.size(); ++i) bytes_.insert(bytes_.end(), {color.red, color.green, color.blue});
  covered_ = {width_, height_, 0, 0};
}

void Canvas::cover(std::span<const dmrp_vec2> corners) {
  Box box = {width_, height_, 0, 0};
  for (const dmrp_vec2 corner : corners) {
    box.left = std::min(box.left, pixel(std::floor(corner.x), width_));
    box.right = std::max(box.right, pixel(std::ceil(corner.x), width_));
    box.top = std::min(box.top, pixel(std::floor(corner.y), height_));
    box.bottom = std::max(box.bottom, pixel(std::ceil(corner.y), height_));
  }
  if (box.left >= box.right || box.top >= box.bottom) return;
  covered_ = {std::min(covered_.left, box.left), std::min(covered_.top, box.top), std::max(covered_.right, box.right),
              std::max(covered_.bottom, box.bottom)};
  for (int y = box.top; y < box.bottom; ++y) {
    row_.assign(static_cast<std::size_t>(box.right - box.left), 0.0F);
    for (int scan = 0; scan < scans_a_row; ++scan) {
      crossings(corners, y + (scan + 0.5) / scans_a_row, crossings_);
      for (std::size_t i = 0; i + 1 < crossings_.size(); i += 2)
        cover_row(box, std::clamp<double>(crossings_[i], box.left, box.right),
                  std::clamp<double>(crossings_[i + 1], box.left, box.right));
    }
    float* mask = &mask_[index(box.left, y)];
    for (std::size_t x = 0; x < row_.size(); ++x) mask[x] = std::max(mask[x], row_[x]);
  }
}

void Canvas::cover_row(const Box& box, double left, double right) {
  for (int x = static_cast<int>(left); x < right; ++x) {
    const double share = std::min(right, x + 1.0) - std::max(left, static_cast<double>(x));
    row_[static_cast<std::size_t>(x - box.left)] += static_cast<float>(share / scans_a_row);
  }
}

void Canvas::paint_covered(Color color, double opacity) {
  for (int y = covered_.top; y < covered_.bottom; ++y) {
    for (int x = covered_.left; x < covered_.right; ++x) {
      const std::size_t i = index(x, y);
      if (mask_[i] <= 0.0F) continue;
      const double share = opacity * std::min(1.0, static_cast<double>(mask_[i]));
      mask_[i] = 0.0F;
      std::uint8_t* to = &bytes_[3 * i];
      to[0] = mixed(to[0], color.red, share);
      to[1] = mixed(to[1], color.green, share);
      to[2] = mixed(to[2], color.blue, share);
    }
  }
  covered_ = {width_, height_, 0, 0};
}

void Canvas::polygon(std::span<const dmrp_vec2> corners, Color color, double opacity) {
  if (corners.size() < 3) return;
  cover(corners);
  paint_covered(color, opacity);
}

void Canvas::disc(dmrp_vec2 middle, double radius, Color color, double opacity) {
  polygon(circle(middle, radius), color, opacity);
}

void Canvas::ring(dmrp_vec2 middle, double radius, double line_width, Color color) {
  std::vector<dmrp_vec2> closed;
  for (const dmrp_vec2 corner : circle(middle, radius)) closed.push_back(corner);
  closed.push_back(closed.front());
  line(closed, line_width, color);
}

void Canvas::line(std::span<const dmrp_vec2> points, double line_width, Color color, double opacity) {
  using namespace toolkit;
  const double half = line_width / 2.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    cover(circle<end_corners>(points[i], half));
    if (i == 0) continue;
    const dmrp_vec2 a = points[i - 1];
    const dmrp_vec2 b = points[i];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (length < 1e-9) continue;
    const dmrp_vec2 side = {-(b.y - a.y) / length * half, (b.x - a.x) / length * half};
    const std::array<dmrp_vec2, 4> quad = {a + side, b + side, b - side, a - side};
    cover(quad);
  }
  paint_covered(color, opacity);
}

void Canvas::text(dmrp_vec2 middle, std::string_view digits, double size, Color color) {
  double x = std::round(middle.x - (6.0 * static_cast<double>(digits.size()) - 1.0) * size / 2.0);
  const double y = std::round(middle.y - 3.5 * size);
  for (const char letter : digits) {
    const auto glyph =
        std::find_if(glyphs.begin(), glyphs.end(), [&](const Glyph& one) { return one.letter == letter; });
    for (int row = 0; glyph != glyphs.end() && row < 7; ++row)
      for (int column = 0; column < 5; ++column) {
        if (glyph->rows.at(static_cast<std::size_t>(row))[column] != '#') continue;
        const dmrp_vec2 at = {x + column * size, y + row * size};
        const std::array<dmrp_vec2, 4> square = {
            {at, {at.x + size, at.y}, {at.x + size, at.y + size}, {at.x, at.y + size}}};
        cover(square);
      }
    x += 6.0 * size;
  }
  paint_covered(color, 1.0);
}

}  // namespace dmrp::host
