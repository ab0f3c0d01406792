// SPDX-License-Identifier: MIT
// svg.hpp: draws a plan of a world as an SVG document.
//
//   SvgPlan plan({{0, 0}, {40, 40}}, "mall");
//   plan.polygon(shelf, {"furniture"}, "shelf B");
//   plan.polyline(path, {"path", series_color(robot)});
//   plan.text({3.0, 4.5}, "R1", {"label"});
//   file << plan.document();
//
// All coordinates are world coordinates in metres, y up. Later elements lie on top. Equal calls give equal bytes in
// every locale.
//
// Elements have a CSS class: `free`, `wall`, `furniture`, `region`, `grid`, `path`, `robot`, `person`, `start`, `goal`,
// `label`, `heading`, `flow`, `name`, `plan`, `way`, `walk`, `contact`; the document has a style for each of these, and none for other names. Line widths and text sizes
// are in pixels of the page, not in metres.
#pragma once

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "polygon.hpp"
#include "rectangle.hpp"
#include "vec2.hpp"

namespace dmrp::toolkit {

// The palette of Okabe and Ito (2008), whose colours differ under colour blindness; it repeats after eight.
inline std::string_view series_color(std::size_t index) {
  constexpr std::array<std::string_view, 8> colors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                      "#e69f00", "#56b4e9", "#000000", "#f0e442"};
  return colors[index % colors.size()];
}

// Escapes text for use between tags and in attributes. Control characters, which XML forbids, become spaces.
inline std::string escape_xml(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return escaped;
}

// At most two decimals, rounded half away from zero, no trailing zeros, never "-0". Finite, below 1e15.
inline std::string format_svg_number(double value) {
  assert(std::abs(value) < 1e15);
  const std::int64_t hundredths = std::llround(std::abs(value) * 100.0);
  std::string text = value < 0.0 && hundredths != 0 ? "-" : "";
  text += std::to_string(hundredths / 100);
  const auto decimals = static_cast<char>(hundredths % 100);
  if (decimals != 0) {
    text += '.';
    text += static_cast<char>('0' + decimals / 10);
    if (decimals % 10 != 0) text += static_cast<char>('0' + decimals % 10);
  }
  return text;
}

// `color` overrides the class's colour: the stroke of a line, the fill of any other element.
struct SvgStyle {
  std::string_view name;
  std::string_view color = {};
};

class SvgPlan {
  static constexpr double margin = 16.0;

 public:
  // A page that shows the rectangle `world`, `page_width` pixels wide without the margins. `heading` may be empty.
  explicit SvgPlan(const Rectangle& world, std::string_view heading = {}, double page_width = 800.0,
                   double left_margin = margin)
      : world_(world),
        scale_(page_width / (world.upper.x - world.lower.x)),
        left_(left_margin),
        top_(heading.empty() ? margin : 3 * margin) {
    assert(world.lower.x < world.upper.x && page_width > 0.0);
    width_ = left_ + page_width + margin;
    height_ = scale_ * (world.upper.y - world.lower.y) + top_ + 3.0 * margin;
    rectangle(world, {"free"});
    if (!heading.empty()) page_text({left_, 2.0 * margin}, heading, "heading");
  }

  // A browser shows `title` while the pointer rests on the figure.
  void rectangle(const Rectangle& box, SvgStyle style, std::string_view title = {}) {
    const dmrp_vec2 corner = page({box.lower.x, box.upper.y});
    element("rect",
            attribute("x", corner.x) + attribute("y", corner.y) +
                attribute("width", scale_ * (box.upper.x - box.lower.x)) +
                attribute("height", scale_ * (box.upper.y - box.lower.y)) + look(style, false),
            title);
  }

  void circle(dmrp_vec2 center, double radius_m, SvgStyle style, std::string_view title = {}) {
    const dmrp_vec2 at = page(center);
    element("circle",
            attribute("cx", at.x) + attribute("cy", at.y) + attribute("r", scale_ * radius_m) + look(style, false),
            title);
  }

  void polygon(PolygonView vertices, SvgStyle style, std::string_view title = {}) {
    element("polygon", points(vertices) + look(style, false), title);
  }

  // A path as in polyline.hpp.
  template <class Path>
  void polyline(const Path& path, SvgStyle style, std::string_view title = {}) {
    element("polyline", points(path) + look(style, true), title);
  }

  void line(dmrp_vec2 from, dmrp_vec2 to, SvgStyle style) { polyline(std::array<dmrp_vec2, 2>{from, to}, style); }

  // A line with a head of fixed size at `to`.
  void arrow(dmrp_vec2 from, dmrp_vec2 to, SvgStyle style) {
    line(from, to, style);
    const dmrp_vec2 back = normalized(from - to) * (7.0 / scale_);
    polyline(std::array<dmrp_vec2, 3>{to + rotate(back, 0.45), to, to + rotate(back, -0.45)}, style);
  }

  // Centred at a point of the world.
  void text(dmrp_vec2 at, std::string_view words, SvgStyle style) {
    page_text(page(at), words, style.name, style.color);
  }

  // A grid with the coordinates of every fifth line in the margins; the left one should have 36 pixels. What is drawn
  // later lies on it.
  void axes() {
    const double step = nice_step((world_.upper.x - world_.lower.x) / 50.0);
    const auto first = [step](double from) { return std::llround(std::ceil(from / step - 1e-9)); };
    const auto last = [step](double to) { return std::llround(std::floor(to / step + 1e-9)); };
    for (std::int64_t i = first(world_.lower.x); i <= last(world_.upper.x); ++i) {
      const double x = static_cast<double>(i) * step;
      line({x, world_.lower.y}, {x, world_.upper.y}, {i % 5 == 0 ? "major-grid" : "grid"});
      if (i % 5 == 0) page_text(page({x, world_.lower.y}) + dmrp_vec2{0.0, 9.0}, number(x), "axis");
    }
    for (std::int64_t i = first(world_.lower.y); i <= last(world_.upper.y); ++i) {
      const double y = static_cast<double>(i) * step;
      line({world_.lower.x, y}, {world_.upper.x, y}, {i % 5 == 0 ? "major-grid" : "grid"});
      if (i % 5 == 0) page_text(page({world_.lower.x, y}) - dmrp_vec2{5.0, 0.0}, number(y), "axis ends");
    }
    page_text({width_ - margin, height_ - margin}, "x and y in m", "axis ends");
  }

  // A scale bar of this length, below the plan.
  void scale_bar(double length_m) {
    const dmrp_vec2 from = page(world_.lower) + dmrp_vec2{0.0, 1.2 * margin};
    const double length = scale_ * length_m;
    append({"<path class=\"scale\" d=\"M", number(from.x), " ", number(from.y - 3.0), "v6m0-3h", number(length),
            "m0-3v6\"/>\n"});
    page_text(from + dmrp_vec2{length + 8.0, 4.0}, joined({number(length_m), " m"}), "scale-label");
  }

  // The whole document so far.
  std::string document() const {
    const std::string width = number(width_);
    const std::string height = number(height_);
    return joined({"<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 ", width, " ", height, "\" width=\"", width,
                   "\" height=\"", height, "\">\n<style>\n", style_sheet, "</style>\n<rect class=\"page\" width=\"",
                   width, "\" height=\"", height, "\"/>\n", body_, "</svg>\n"});
  }

 private:
  static constexpr std::string_view style_sheet =
      "  text { font: 12px system-ui, 'DejaVu Sans', sans-serif; fill: #333; text-anchor: middle;"
      " dominant-baseline: central; }\n"
      "  polyline { fill: none; stroke: #333; stroke-width: 1.5; stroke-linejoin: round; stroke-linecap: round; }\n"
      "  .page { fill: #fff; }\n"
      "  .free { fill: #fafaf7; stroke: #444; stroke-width: 2; }\n"
      "  .wall { fill: #4a4f57; }\n"
      "  .furniture { fill: #b9b4a8; stroke: #8c877b; stroke-width: 0.75; }\n"
      "  .region { fill: #56b4e9; fill-opacity: 0.15; stroke: #56b4e9; stroke-dasharray: 4 3; }\n"
      "  .grid { stroke: #ddd; stroke-width: 0.5; }\n"
      "  .major-grid { stroke: #bbb; stroke-width: 0.75; }\n"
      "  text.axis { font-size: 10px; fill: #666; }\n"
      "  text.begins { text-anchor: start; }\n"
      "  text.ends { text-anchor: end; }\n"
      "  .flow { stroke: #2a7aa8; stroke-width: 1.5; stroke-opacity: 0.7; }\n"
      "  text.name { font-size: 10px; fill: #1f5f85; }\n"
      "  .plan { stroke-width: 1; stroke-opacity: 0.6; stroke-dasharray: 4 3; }\n"
      "  .way { stroke-width: 2; }\n"
      "  .walk { stroke: #8a6d3b; stroke-width: 0.75; stroke-opacity: 0.55; }\n"
      "  .contact { fill: #a63c00; }\n"
      "  .path { stroke-width: 2.5; stroke-opacity: 0.8; }\n"
      "  .robot { fill: #0072b2; stroke: #fff; stroke-width: 1; }\n"
      "  .person { fill: #e69f00; fill-opacity: 0.8; stroke: #fff; stroke-width: 1; }\n"
      "  .start { fill: #0072b2; stroke: #fff; stroke-width: 1; }\n"
      "  .goal { fill: #0072b2; fill-opacity: 0.25; stroke: #333; stroke-width: 1; stroke-dasharray: 3 2; }\n"
      "  .label { font-size: 11px; }\n"
      "  text.heading { font-size: 18px; font-weight: 600; text-anchor: start; }\n"
      "  .scale { fill: none; stroke: #333; }\n"
      "  text.scale-label { text-anchor: start; dominant-baseline: auto; }\n";

  static std::string number(double value) { return format_svg_number(value); }

  // 1, 2 or 5 times a power of ten, at least `step`.
  static double nice_step(double step) {
    const double power = std::pow(10.0, std::floor(std::log10(step)));
    for (const double factor : {1.0, 2.0, 5.0})
      if (factor * power >= step * (1.0 - 1e-9)) return factor * power;
    return 10.0 * power;
  }

  // Written out because gcc 12 falsely warns of overlapping memory in `"text" + std::string` (its bug 105651).
  static std::string joined(std::initializer_list<std::string_view> parts) {
    std::string whole;
    for (const std::string_view part : parts) whole += part;
    return whole;
  }
  void append(std::initializer_list<std::string_view> parts) { body_ += joined(parts); }

  static std::string attribute(std::string_view name, double value) {
    return joined({" ", name, "=\"", number(value), "\""});
  }

  static std::string look(SvgStyle style, bool is_line) {
    const std::string class_attribute = joined({" class=\"", escape_xml(style.name), "\""});
    if (style.color.empty()) return class_attribute;
    return joined({class_attribute, " style=\"", is_line ? "stroke" : "fill", ":", escape_xml(style.color), "\""});
  }

  dmrp_vec2 page(dmrp_vec2 at) const {
    return {left_ + scale_ * (at.x - world_.lower.x), top_ + scale_ * (world_.upper.y - at.y)};
  }

  template <class Path>
  std::string points(const Path& path) const {
    std::string list;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const dmrp_vec2 at = page(position(path[i]));
      if (i > 0) list += ' ';
      list += joined({number(at.x), ",", number(at.y)});
    }
    return joined({" points=\"", list, "\""});
  }

  void element(std::string_view name, const std::string& attributes, std::string_view title) {
    append({"<", name, attributes});
    if (title.empty()) {
      append({"/>\n"});
    } else {
      append({"><title>", escape_xml(title), "</title></", name, ">\n"});
    }
  }

  void page_text(dmrp_vec2 at, std::string_view words, std::string_view name, std::string_view color = {}) {
    append({"<text", attribute("x", at.x), attribute("y", at.y), look({name, color}, false), ">", escape_xml(words),
            "</text>\n"});
  }

  Rectangle world_;
  double scale_;  // pixels a metre
  double left_;
  double top_;
  double width_ = 0.0;
  double height_ = 0.0;
  std::string body_;
};

}  // namespace dmrp::toolkit
