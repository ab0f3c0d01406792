// SPDX-License-Identifier: MIT
// The formats: https://netpbm.sourceforge.net/doc/pgm.html
#include "host/maps/map_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/scene/cell_map.hpp"
#include "host/errors/input_error.hpp"
#include "host/files/read_file.hpp"

namespace dmrp::host {

namespace {

constexpr std::uint32_t max_maxval = 65'535;
constexpr std::string_view png_magic = "\x89PNG";

bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

// Reads the numbers of a PGM in sequence.
class PgmText {
 public:
  PgmText(std::string_view bytes, const std::string& shown_path) : bytes_(bytes), shown_path_(shown_path) {}

  std::size_t position() const { return position_; }

  // A position as "file:line:column".
  std::string place(std::size_t position) const {
    const std::string_view before = bytes_.substr(0, position);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t line_end = before.rfind('\n');
    const std::size_t column = line_end == std::string_view::npos ? position + 1 : position - line_end;
    return fmt::format("{}:{}:{}", shown_path_, line, column);
  }
  [[noreturn]] void fail(std::size_t position, const std::string& text) const {
    throw InputError(place(position) + ": " + text);
  }

  // The next number, after blanks and comments. `what`: its name in messages.
  std::uint32_t number(const char* what, std::uint32_t most) {
    skip_blanks();
    const std::size_t begin = position_;
    std::uint64_t value = 0;
    for (; position_ < bytes_.size() && bytes_[position_] >= '0' && bytes_[position_] <= '9'; ++position_)
      value = std::min<std::uint64_t>(10 * value + static_cast<std::uint64_t>(bytes_[position_] - '0'), 1ull << 40);
    if (position_ == begin)
      fail(begin, begin == bytes_.size() ? fmt::format("the file ends before {}", what)
                                         : fmt::format("{} must be a whole number", what));
    if (value > most) fail(begin, fmt::format("{} must be at most {}", what, most));
    return static_cast<std::uint32_t>(value);
  }

  // Fails unless the file ends here, but for blanks and comments.
  void end_of_samples() {
    skip_blanks();
    if (position_ < bytes_.size()) fail(position_, "the file goes on after the image's last grey value");
  }

  // Skips the single blank before raw samples.
  void skip_one_blank() {
    if (position_ == bytes_.size() || !is_space(bytes_[position_])) fail(position_, "expected a blank after maxval");
    ++position_;
  }

 private:
  void skip_blanks() {
    while (position_ < bytes_.size() && (is_space(bytes_[position_]) || bytes_[position_] == '#')) {
      if (bytes_[position_] == '#') position_ = std::min(bytes_.find('\n', position_), bytes_.size() - 1);
      ++position_;
    }
  }

  std::string_view bytes_;
  const std::string& shown_path_;
  std::size_t position_ = 2;  // after the magic number
};

void read_plain_samples(PgmText& text, MapImage& image) {
  for (std::uint32_t& level : image.level) level = text.number("a grey value", image.white);
  text.end_of_samples();
}

// Some writers end the file with a line end. More bytes are a sign that the grey values are not where they seem to be.
void check_surplus(std::string_view bytes, const PgmText& text, const MapImage& image, std::size_t sample_bytes) {
  const std::size_t begin = text.position();
  const std::string_view surplus = bytes.substr(begin + image.level.size() * sample_bytes);
  const bool is_shifted = bytes[begin - 1] == '\r' && bytes[begin] == '\n';
  if (surplus.empty() || (!is_shifted && (surplus == "\n" || surplus == "\r\n"))) return;
  text.fail(begin, fmt::format("the file has {} byte{} more than {} x {} grey values need{}", surplus.size(),
                               surplus.size() == 1 ? "" : "s", image.width, image.height,
                               is_shifted ? ": its header must end with LF, not CR LF" : ""));
}

// One byte per sample, or two bytes, the higher first, if maxval needs them.
void read_raw_samples(std::string_view bytes, const PgmText& text, MapImage& image) {
  const std::size_t begin = text.position();
  const std::size_t sample_bytes = image.white > 255 ? 2 : 1;
  const std::size_t there = (bytes.size() - begin) / sample_bytes;
  if (there < image.level.size())
    text.fail(begin, fmt::format("the image ends after {} of {} grey values", there, image.level.size()));
  check_surplus(bytes, text, image, sample_bytes);
  for (std::size_t i = 0; i < image.level.size(); ++i) {
    const std::size_t at = begin + i * sample_bytes;
    std::uint32_t level = static_cast<unsigned char>(bytes[at]);
    if (sample_bytes == 2) level = 256 * level + static_cast<unsigned char>(bytes[at + 1]);
    if (level > image.white)
      text.fail(begin, fmt::format("grey value {} of the image is {}, above maxval {}", i + 1, level, image.white));
    image.level[i] = level;
  }
}

}  // namespace

void check_map_size(std::uint64_t width, std::uint64_t height, const std::string& place) {
  if (width == 0 || height == 0) throw InputError(fmt::format("{}: the image has no cells", place));
  if (width > core::max_map_side || height > core::max_map_side || width * height > core::max_map_cells)
    throw InputError(fmt::format("{}: the map is too large: {} x {} cells, at most {} a side and {} altogether", place,
                                 width, height, core::max_map_side, core::max_map_cells));
}

MapImage read_pgm(std::string_view bytes, const std::string& shown_path) {
  PgmText text(bytes, shown_path);
  if (!bytes.starts_with("P2") && !bytes.starts_with("P5"))
    throw InputError(shown_path + ":1:1: expected a PGM (P2 or P5) or PNG image");
  MapImage image;
  const std::size_t header = text.position();
  image.width = text.number("the width", std::numeric_limits<std::uint32_t>::max());
  image.height = text.number("the height", std::numeric_limits<std::uint32_t>::max());
  check_map_size(image.width, image.height, text.place(header));
  image.white = text.number("maxval", max_maxval);
  if (image.white == 0) text.fail(text.position() - 1, "maxval must be at least 1");
  image.level.resize(std::size_t{image.width} * image.height);
  if (bytes[1] == '2') {
    read_plain_samples(text, image);
  } else {
    text.skip_one_blank();
    read_raw_samples(bytes, text, image);
  }
  return image;
}

MapImage read_map_image(const std::filesystem::path& file, const std::string& shown_path) {
  const std::string bytes = read_file(file, shown_path);
  return bytes.starts_with(png_magic) ? read_png(bytes, shown_path) : read_pgm(bytes, shown_path);
}

}  // namespace dmrp::host
