// SPDX-License-Identifier: MIT
// painter.hpp: lines, areas and words on a page, by libcairo.
//
// Equal calls give equal bytes in every format, with the same libcairo and the font DejaVu Sans. (Libcairo writes into an
// SVG how many surfaces the process has made: the same picture a second time in one process has another number.)
#pragma once

#include <dmrp/values.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/picture/colors.hpp"

namespace dmrp::core {

// What becomes of the page: a document, or the bytes of a frame.
enum class PictureFormat { svg, pdf, png, frame };

// An area has a fill, an outline or both; a line is an outline alone.
struct Look {
  std::optional<Ink> fill{};
  std::optional<Ink> line{};
  double line_px = 1.0;
  bool is_dashed = false;
};

enum class Anchor { begin, middle, end };

struct TextLook {
  double size_px = 12.0;
  Ink ink = ink_of(0x333333);
  Anchor anchor = Anchor::middle;
  bool is_bold = false;
  bool has_halo = false;  // white around the letters, so that they stand out from what is below
};

// Places are in pixels from the upper left corner, x to the right and y down. Later marks lie on top.
class Painter {
 public:
  // `zoom`: the dots of an image a pixel; documents of lines have none. Throws std::runtime_error, as all functions do, if
  // libcairo cannot.
  Painter(PictureFormat format, double width_px, double height_px, double zoom = 1.0);
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;
  ~Painter();

  void polygon(std::span<const dmrp_vec2> corners, const Look& look);
  void disc(dmrp_vec2 middle, double radius_px, const Look& look);
  void line(std::span<const dmrp_vec2> points, const Look& look);

  // `at`: the middle of the height.
  void text(dmrp_vec2 at, std::string_view words, const TextLook& look);
  double text_width(std::string_view words, const TextLook& look);

  // Ends an SVG, a PDF or a PNG.
  std::string document();

  // A frame's rows from above; each dot has a byte of blue, green and red, and an unused one.
  std::span<const std::uint8_t> frame();

  // Makes this frame equal to another one of the same size.
  void copy(Painter& other);

 private:
  struct Surface;
  void paint(const Look& look);
  std::unique_ptr<Surface> surface_;
};

}  // namespace dmrp::core
