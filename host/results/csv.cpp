// SPDX-License-Identifier: MIT
#include "host/results/csv.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace dmrp::host {

std::string shortest_number(double value) {
  if (std::isnan(value)) return {};
  std::array<char, 32> buffer;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

// Written by hand: quoting takes fewer lines than the use of a CSV library.
CsvWriter& CsvWriter::field(std::string_view text) {
  if (line_begun_) text_ += ',';
  line_begun_ = true;
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    text_ += text;
    return *this;
  }
  text_ += '"';
  for (const char character : text) {
    if (character == '"') text_ += '"';
    text_ += character;
  }
  text_ += '"';
  return *this;
}

CsvWriter& CsvWriter::field(const std::optional<double>& value) {
  return value ? field(*value) : field(std::string_view());
}

// Lines end with LF instead of RFC 4180's CR LF: every reader accepts it, and text tools prefer it.
void CsvWriter::end_line() {
  text_ += '\n';
  line_begun_ = false;
}

}  // namespace dmrp::host
