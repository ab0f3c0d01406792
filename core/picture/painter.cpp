// SPDX-License-Identifier: MIT
#include "core/picture/painter.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>

namespace dmrp::core {
namespace {

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(std::string("cannot draw the picture: ") + cairo_status_to_string(status));
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

// Text that libcairo takes: control characters become spaces, and where it is no UTF-8, other than ASCII question marks.
std::string printable(cairo_t* page, std::string_view words) {
  std::string text(words);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  cairo_glyph_t* glyphs = nullptr;
  int count = 0;
  const cairo_status_t status =
      cairo_scaled_font_text_to_glyphs(cairo_get_scaled_font(page), 0.0, 0.0, text.data(),
                                       static_cast<int>(text.size()), &glyphs, &count, nullptr, nullptr, nullptr);
  cairo_glyph_free(glyphs);
  if (status == CAIRO_STATUS_INVALID_STRING)
    for (char& c : text)
      if (static_cast<unsigned char>(c) >= 0x80) c = '?';
  return text;
}

void set_ink(cairo_t* page, const Ink& ink) {
  cairo_set_source_rgba(page, ink.red / 255.0, ink.green / 255.0, ink.blue / 255.0, ink.opacity);
}

void set_font(cairo_t* page, const TextLook& look) {
  cairo_select_font_face(page, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         look.is_bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(page, look.size_px);
}

}  // namespace

struct Painter::Surface {
  ~Surface() {
    cairo_destroy(page);
    cairo_surface_destroy(surface);
  }

  PictureFormat format = PictureFormat::svg;
  std::string bytes{};  // of an SVG or a PDF, so far
  cairo_surface_t* surface = nullptr;
  cairo_t* page = nullptr;
};

Painter::Painter(PictureFormat format, double width_px, double height_px, double zoom)
    : surface_(std::make_unique<Surface>()) {
  surface_->format = format;
  if (format == PictureFormat::svg) {
    surface_->surface = cairo_svg_surface_create_for_stream(&append, &surface_->bytes, width_px, height_px);
    cairo_svg_surface_set_document_unit(surface_->surface, CAIRO_SVG_UNIT_PX);
  } else if (format == PictureFormat::pdf) {
    surface_->surface = cairo_pdf_surface_create_for_stream(&append, &surface_->bytes, width_px, height_px);
    // the time of drawing would make the bytes differ
    cairo_pdf_surface_set_metadata(surface_->surface, CAIRO_PDF_METADATA_CREATE_DATE, "1970-01-01T00:00:00Z");
  } else {
    surface_->surface =
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::lround(std::ceil(zoom * width_px - 1e-6))),
                                   static_cast<int>(std::lround(std::ceil(zoom * height_px - 1e-6))));
  }
  check(cairo_surface_status(surface_->surface));
  cairo_t* page = surface_->page = cairo_create(surface_->surface);
  if (format == PictureFormat::png || format == PictureFormat::frame) cairo_scale(page, zoom, zoom);
  cairo_set_line_cap(page, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(page, CAIRO_LINE_JOIN_ROUND);
  // nobody's settings of fonts change a picture
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(page, options);
  cairo_font_options_destroy(options);
  set_ink(page, ink_of(0xffffff));
  cairo_paint(page);
}

Painter::~Painter() = default;

void Painter::paint(const Look& look) {
  cairo_t* const page = surface_->page;
  if (look.fill) {
    set_ink(page, *look.fill);
    cairo_fill_preserve(page);
  }
  if (look.line) {
    constexpr std::array<double, 2> dashes = {4.0, 4.0};
    set_ink(page, *look.line);
    cairo_set_line_width(page, look.line_px);
    cairo_set_dash(page, dashes.data(), look.is_dashed ? 2 : 0, 0.0);
    cairo_stroke_preserve(page);
  }
  cairo_new_path(page);
}

void Painter::polygon(std::span<const dmrp_vec2> corners, const Look& look) {
  for (const dmrp_vec2 corner : corners) cairo_line_to(surface_->page, corner.x, corner.y);
  cairo_close_path(surface_->page);
  paint(look);
}

void Painter::disc(dmrp_vec2 middle, double radius_px, const Look& look) {
  cairo_arc(surface_->page, middle.x, middle.y, radius_px, 0.0, 2.0 * std::numbers::pi);
  cairo_close_path(surface_->page);
  paint(look);
}

void Painter::line(std::span<const dmrp_vec2> points, const Look& look) {
  for (const dmrp_vec2 point : points) cairo_line_to(surface_->page, point.x, point.y);
  paint({{}, look.line, look.line_px, look.is_dashed});
}

void Painter::text(dmrp_vec2 at, std::string_view words, const TextLook& look) {
  cairo_t* const page = surface_->page;
  const double width = look.anchor == Anchor::begin ? 0.0 : text_width(words, look);
  set_font(page, look);
  const std::string text = printable(page, words);
  const dmrp_vec2 from = {at.x - (look.anchor == Anchor::middle ? 0.5 : 1.0) * width, at.y + 0.36 * look.size_px};
  if (look.has_halo) {
    cairo_move_to(page, from.x, from.y);
    cairo_text_path(page, text.c_str());
    paint({{}, ink_of(0xffffff).fainter(0.85), 0.3 * look.size_px});
  }
  cairo_move_to(page, from.x, from.y);
  set_ink(page, look.ink);
  cairo_show_text(page, text.c_str());
  cairo_new_path(page);
}

double Painter::text_width(std::string_view words, const TextLook& look) {
  set_font(surface_->page, look);
  cairo_text_extents_t extents{};
  cairo_text_extents(surface_->page, printable(surface_->page, words).c_str(), &extents);
  return extents.x_advance;
}

std::string Painter::document() {
  assert(surface_->format != PictureFormat::frame);
  check(cairo_status(surface_->page));
  if (surface_->format == PictureFormat::png) {
    cairo_surface_flush(surface_->surface);
    check(cairo_surface_write_to_png_stream(surface_->surface, &append, &surface_->bytes));
  } else {
    cairo_surface_finish(surface_->surface);
  }
  check(cairo_surface_status(surface_->surface));
  return surface_->bytes;
}

std::span<const std::uint8_t> Painter::frame() {
  assert(surface_->format == PictureFormat::frame);
  check(cairo_status(surface_->page));
  cairo_surface_flush(surface_->surface);
  return {cairo_image_surface_get_data(surface_->surface),
          static_cast<std::size_t>(cairo_image_surface_get_stride(surface_->surface)) *
              static_cast<std::size_t>(cairo_image_surface_get_height(surface_->surface))};
}

void Painter::copy(Painter& other) {
  const std::span<const std::uint8_t> from = other.frame();
  assert(frame().size() == from.size());
  std::memcpy(cairo_image_surface_get_data(surface_->surface), from.data(), from.size());
  cairo_surface_mark_dirty(surface_->surface);
}

}  // namespace dmrp::core
