// SPDX-License-Identifier: MIT
#include "host/terminal/mistake_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "host/errors/mistakes.hpp"
#include "host/errors/one_line.hpp"
#include "host/terminal/colors.hpp"
#include "host/terminal/display_width.hpp"

namespace dmrp::host {

namespace {

constexpr std::size_t bytes_before = 60;  // of the place, that are shown of a long line
constexpr std::size_t bytes_shown = 100;

bool begins_character(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0u) != 0x80u;
}

// The index of the byte with which a character begins; characters count from 1.
std::size_t byte_of(std::string_view line, std::size_t character) {
  std::size_t seen = 0;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (begins_character(line[i]) && ++seen == character) return i;
  return line.size();
}

// The next byte at or behind `at` with which a character begins.
std::size_t whole_character(std::string_view line, std::size_t at) {
  while (at < line.size() && !begins_character(line[at])) ++at;
  return std::min(at, line.size());
}

//   12 | trials = "three"
//      |          ^
std::string quoted(const SourcePlace& place, bool colors) {
  const std::string number = fmt::format("{:>5}", place.line);
  const std::string line = one_line(place.text);  // a tab becomes a space
  const std::size_t at = byte_of(line, place.column);
  const std::size_t begin = at <= bytes_before ? 0 : whole_character(line, at - bytes_before);
  const std::size_t end = whole_character(line, std::min(line.size(), begin + bytes_shown));
  const std::string before = (begin > 0 ? "..." : "") + line.substr(begin, at - begin);
  const std::string after = line.substr(at, end - at) + (end < line.size() ? "..." : "");
  return fmt::format("{} | {}{}\n{} | {}{}\n", number, before, after, std::string(number.size(), ' '),
                     std::string(display_width(before), ' '), colored("^", TextColor::red, colors));
}

std::string one_mistake(const InputError& mistake, bool colors) {
  const std::string line = mistake.what();
  const SourcePlace& place = mistake.place();
  const std::string where = fmt::format("{}:{}:{}:", place.file, place.line, place.column);
  if (place.file.empty() || !line.starts_with(where)) return line + "\n";
  const std::string text = colored(where, TextColor::bold, colors) + line.substr(where.size()) + "\n";
  const bool has_line = place.text.find_first_not_of(" \t\r") != std::string::npos;
  return has_line ? text + quoted(place, colors) : text;
}

}  // namespace

std::string mistake_text(const InputError& error, bool colors) {
  const auto* const several = dynamic_cast<const InputErrors*>(&error);
  if (!several) return one_mistake(error, colors);
  std::string text;
  for (const InputError& mistake : several->mistakes()) text += one_mistake(mistake, colors);
  const std::size_t count = several->mistakes().size();
  return text + (count < most_mistakes ? fmt::format("{} mistakes\n", count)
                                       : fmt::format("the first {} mistakes; there may be more\n", count));
}

}  // namespace dmrp::host
