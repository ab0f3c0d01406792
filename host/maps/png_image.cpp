// SPDX-License-Identifier: MIT
// Reads PNG images of every kind by libpng as 8-bit red, green and blue, with alpha if the file has it.
#include <fmt/format.h>
#include <png.h>

#include <array>
#include <csetjmp>
#include <cstring>
#include <new>

#include "host/errors/input_error.hpp"
#include "host/maps/map_image.hpp"

namespace dmrp::host {

namespace {

// The data of libpng's callbacks.
struct Source {
  std::string_view rest;
  std::array<char, 160> message{};
};

// Owns libpng's structs.
struct Decoder {
  png_structp png = nullptr;
  png_infop info = nullptr;
  Decoder() = default;
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
  ~Decoder() { png_destroy_read_struct(&png, &info, nullptr); }
};

void take_bytes(png_structp png, png_bytep to, std::size_t count) {
  auto& source = *static_cast<Source*>(png_get_io_ptr(png));
  if (count > source.rest.size()) png_error(png, "the file ends early");
  std::memcpy(to, source.rest.data(), count);
  source.rest.remove_prefix(count);
}

void note_error(png_structp png, png_const_charp message) {
  auto& source = *static_cast<Source*>(png_get_error_ptr(png));
  std::strncpy(source.message.data(), message, source.message.size() - 1);
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

// Steps that libpng may leave by longjmp on an error: they have no variables with destructors.
bool read_header(png_structp png, png_infop info) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_read_info(png, info);
  return true;
}

bool choose_channels(png_structp png, png_infop info) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_expand(png);  // palettes, fewer bits than 8, transparent colours
  png_set_scale_16(png);
  png_set_gray_to_rgb(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  return true;
}

bool read_rows(png_structp png, png_bytepp rows) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_read_image(png, rows);
  png_read_end(png, nullptr);
  return true;
}

}  // namespace

MapImage read_png(std::string_view bytes, const std::string& shown_path) {
  Source source{bytes};
  const auto fail = [&] {
    throw InputError(fmt::format("{}:1:1: the PNG image cannot be read: {}", shown_path, source.message.data()));
  };
  Decoder decoder;
  decoder.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, &note_error, &ignore_warning);
  decoder.info = decoder.png ? png_create_info_struct(decoder.png) : nullptr;
  if (!decoder.info) throw std::bad_alloc();
  png_set_read_fn(decoder.png, &source, &take_bytes);
  // The size is checked below, with our own message.
  png_set_user_limits(decoder.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  if (!read_header(decoder.png, decoder.info)) fail();

  MapImage image;
  image.width = png_get_image_width(decoder.png, decoder.info);
  image.height = png_get_image_height(decoder.png, decoder.info);
  check_map_size(image.width, image.height, shown_path + ":1:1");
  if (!choose_channels(decoder.png, decoder.info)) fail();
  const std::size_t channels = png_get_channels(decoder.png, decoder.info);
  const std::size_t row_bytes = png_get_rowbytes(decoder.png, decoder.info);
  std::vector<png_byte> pixels(row_bytes * image.height);
  std::vector<png_bytep> rows;
  for (std::uint32_t y = 0; y < image.height; ++y) rows.push_back(pixels.data() + y * row_bytes);
  if (!read_rows(decoder.png, rows.data())) fail();

  image.white = 3 * 255;
  const std::size_t count = std::size_t{image.width} * image.height;
  image.level.resize(count);
  if (channels == 4) image.alpha.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const png_byte* const pixel = pixels.data() + i * channels;
    image.level[i] = std::uint32_t{pixel[0]} + pixel[1] + pixel[2];
    if (channels == 4) image.alpha[i] = pixel[3];
  }
  return image;
}

}  // namespace dmrp::host
