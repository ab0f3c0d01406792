// SPDX-License-Identifier: MIT
#include "host/maps/movingai.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <iterator>
#include <string_view>

#include "host/errors/input_error.hpp"
#include "host/files/read_file.hpp"
#include "host/files/text_lines.hpp"

namespace dmrp::host {

namespace {

constexpr std::string_view free_letters = ".GS";
constexpr std::string_view blocked_letters = "@OTW";

// Message text: printable and short.
std::string shortened(std::string_view text) {
  constexpr std::size_t longest = 24;
  std::string out;
  for (const char c : text.substr(0, longest)) out += c >= ' ' && c <= '~' ? c : '?';
  return text.size() > longest ? out + "..." : out;
}

// A line without what editors add and nobody sees: a byte order mark, blanks at the end.
std::string_view content(const TextLines& lines, std::size_t line) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  std::string_view text = lines.line(line);
  if (line == 1 && text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  return text.substr(0, text.find_last_not_of(" \t\r\v\f") + 1);
}

// Names the byte that hides in a line which looks as if it began with the word; "" if none does.
std::string hidden_byte(std::string_view line, std::string_view word) {
  const auto shows = [](char c) { return c > ' ' && c <= '~'; };
  std::string looks;
  std::copy_if(line.begin(), line.end(), std::back_inserter(looks), shows);
  if (!looks.starts_with(word)) return "";
  const auto hidden =
      std::find_if(line.begin(), line.end(), [&](char c) { return !shows(c) && c != ' ' && c != '\t'; });
  const auto byte = hidden != line.end() ? hidden : std::find_if_not(line.begin(), line.end(), shows);
  if (byte == line.end()) return "";
  return fmt::format(" (column {} has the byte 0x{:02X}, which does not show)", byte - line.begin() + 1,
                     static_cast<unsigned char>(*byte));
}

// The fields of a line: between tabs if it has any, otherwise between blanks.
std::vector<TextField> fields_of(std::string_view line) {
  const bool tabs = line.find('\t') != std::string_view::npos;
  std::vector<TextField> fields;
  for (std::size_t begin = 0; begin < line.size();) {
    const std::size_t end = std::min(line.find(tabs ? '\t' : ' ', begin), line.size());
    if (end > begin || tabs) fields.push_back({line.substr(begin, end - begin), begin + 1});
    begin = end + 1;
  }
  return fields;
}

std::uint32_t whole_number(const TextLines& lines, std::size_t line, const TextField& field, const char* what,
                           std::uint32_t least, std::uint32_t most) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(field.text.begin(), field.text.end(), number);
  if (error == std::errc::invalid_argument || end != field.text.end())
    lines.fail(line, field.column, fmt::format("{} must be a whole number, not '{}'", what, shortened(field.text)));
  if (error != std::errc() || number < least || number > most)
    lines.fail(line, field.column,
               fmt::format("{} must be {} to {}, not {}", what, least, most, shortened(field.text)));
  return static_cast<std::uint32_t>(number);
}

struct Size {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

// TextLines 1 to 4: type, height, width, map.
Size read_header(const TextLines& lines) {
  const auto type = fields_of(content(lines, 1));
  if (type.size() != 2 || type[0].text != "type")
    lines.fail(1, 1, "expected 'type octile': this is no MovingAI map" + hidden_byte(lines.line(1), "type"));
  Size size;
  for (std::size_t line = 2; line <= 3; ++line) {
    const auto fields = fields_of(content(lines, line));
    std::uint32_t Size::*side = nullptr;
    if (fields.size() == 2 && fields[0].text == "height") side = &Size::height;
    if (fields.size() == 2 && fields[0].text == "width") side = &Size::width;
    if (!side || size.*side != 0) {
      const char* const expected = size.height == 0 ? "height" : "width";
      lines.fail(line, 1, fmt::format("expected '{} N'{}", expected, hidden_byte(lines.line(line), expected)));
    }
    size.*side =
        whole_number(lines, line, fields[1], side == &Size::height ? "height" : "width", 1, core::max_map_side);
  }
  if (std::uint64_t{size.width} * size.height > core::max_map_cells)
    lines.fail(
        3, 1,
        fmt::format("the map is too large: {} x {} cells, at most {}", size.width, size.height, core::max_map_cells));
  if (content(lines, 4) != "map") lines.fail(4, 1, "expected 'map'" + hidden_byte(lines.line(4), "map"));
  return size;
}

void read_row(const TextLines& lines, std::size_t line, std::uint32_t width, std::uint8_t* row) {
  const std::string_view letters = content(lines, line);
  for (std::size_t x = 0; x < std::min<std::size_t>(letters.size(), width); ++x) {
    const bool is_free = free_letters.find(letters[x]) != std::string_view::npos;
    if (!is_free && blocked_letters.find(letters[x]) == std::string_view::npos)
      lines.fail(line, x + 1,
                 fmt::format("unknown cell {} (known: '.', 'G', 'S' free; '@', 'O', 'T', 'W' blocked)",
                             letters[x] >= ' ' && letters[x] <= '~'
                                 ? fmt::format("'{}'", letters[x])
                                 : fmt::format("of byte 0x{:02X}", static_cast<unsigned char>(letters[x]))));
    row[x] = is_free ? 1 : 0;
  }
  if (letters.size() != width)
    lines.fail(line, std::min<std::size_t>(letters.size(), width) + 1,
               fmt::format("the row has {} cells, not width = {}", letters.size(), width));
}

// A cell of a task, on the map and free.
MovingAiCell read_cell(const TextLines& lines, std::size_t line, const TextField& x, const TextField& y,
                       const char* what, const core::CellMap& map) {
  MovingAiCell cell;
  cell.x = whole_number(lines, line, x, fmt::format("the {}'s x", what).c_str(), 0, map.width - 1);
  cell.y = whole_number(lines, line, y, fmt::format("the {}'s y", what).c_str(), 0, map.height - 1);
  if (!map.is_free(cell.x, map.height - 1 - cell.y))
    lines.fail(line, x.column, fmt::format("the {} ({}, {}) is on a blocked cell", what, cell.x, cell.y));
  return cell;
}

bool is_length(std::string_view text) {
  const std::string number(text);
  char* end = nullptr;
  const double length = std::strtod(number.c_str(), &end);
  return !number.empty() && end == number.c_str() + number.size() && length >= 0.0;
}

MovingAiTask read_task(const TextLines& lines, std::size_t line, const core::CellMap& map) {
  constexpr std::size_t field_count = 9;
  const auto fields = fields_of(content(lines, line));
  if (fields.size() != field_count)
    lines.fail(line, fields.empty() ? 1 : fields.back().column,
               fmt::format("a task has {} fields (bucket, map, width, height, start x, y, goal x, y, length), not {}",
                           field_count, fields.size()));
  whole_number(lines, line, fields[0], "the bucket", 0, 1'000'000'000);
  const std::uint32_t width = whole_number(lines, line, fields[2], "the map's width", 1, core::max_map_side);
  const std::uint32_t height = whole_number(lines, line, fields[3], "the map's height", 1, core::max_map_side);
  if (width != map.width || height != map.height)
    lines.fail(line, fields[2].column,
               fmt::format("the task is for another map: '{}' of {} x {} cells, not {} x {}", shortened(fields[1].text),
                           width, height, map.width, map.height));
  if (!is_length(fields[8].text))
    lines.fail(line, fields[8].column, fmt::format("the length must be a number, not '{}'", shortened(fields[8].text)));
  return {read_cell(lines, line, fields[4], fields[5], "start", map),
          read_cell(lines, line, fields[6], fields[7], "goal", map), static_cast<std::uint32_t>(line)};
}

}  // namespace

core::CellMap read_movingai_map(const std::filesystem::path& file, const std::string& shown_path) {
  constexpr std::size_t header_lines = 4;
  const TextLines lines(read_file(file, shown_path), shown_path);
  const Size size = read_header(lines);
  core::CellMap map{size.width, size.height, {}};
  map.free.resize(std::size_t{size.width} * size.height);
  for (std::uint32_t y = 0; y < size.height; ++y) {
    const std::size_t line = header_lines + 1 + y;
    if (line > lines.count())
      lines.fail(line, 1, fmt::format("the map ends after {} rows, before height = {}", y, size.height));
    read_row(lines, line, size.width, map.free.data() + std::size_t{size.height - 1 - y} * size.width);
  }
  for (std::size_t line = header_lines + 1 + size.height; line <= lines.count(); ++line)
    if (!content(lines, line).empty()) lines.fail(line, 1, fmt::format("a row beyond height = {}", size.height));
  return map;
}

MovingAiTasks read_movingai_tasks(const std::filesystem::path& file, const std::string& shown_path,
                                  const core::CellMap& map) {
  const TextLines lines(read_file(file, shown_path), shown_path);
  const auto version = fields_of(content(lines, 1));
  if (version.size() != 2 || version[0].text != "version" || (version[1].text != "1" && version[1].text != "1.0"))
    lines.fail(
        1, 1,
        "expected 'version 1': this is no MovingAI scenario of version 1" + hidden_byte(lines.line(1), "version"));
  MovingAiTasks out{shown_path, "", {}};
  for (std::size_t line = 2; line <= lines.count(); ++line) {
    if (content(lines, line).empty()) continue;
    out.tasks.push_back(read_task(lines, line, map));
    if (out.map_name.empty()) out.map_name = std::string(fields_of(content(lines, line))[1].text);
  }
  return out;
}

dmrp_vec2 center_of(MovingAiCell cell, const core::CellMap& map, double cell_m) {
  return {(cell.x + 0.5) * cell_m, (map.height - 1 - cell.y + 0.5) * cell_m};
}

}  // namespace dmrp::host
