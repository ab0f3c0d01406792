// SPDX-License-Identifier: MIT
// csv.hpp: writes CSV by RFC 4180, with numbers that read back bit by bit.
#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <string_view>

namespace dmrp::host {

// The shortest text that reads back as the same number; empty for NaN.
std::string shortest_number(double value);

class CsvWriter {
 public:
  CsvWriter& field(std::string_view text);
  CsvWriter& field(const std::string& text) { return field(std::string_view(text)); }
  CsvWriter& field(const char* text) { return field(std::string_view(text)); }
  CsvWriter& field(double value) { return field(shortest_number(value)); }
  CsvWriter& field(const std::optional<double>& value);  // empty for none
  CsvWriter& field(std::integral auto value) { return field(std::to_string(value)); }
  void end_line();

  const std::string& text() const { return text_; }

 private:
  std::string text_;
  bool line_begun_ = false;
};

}  // namespace dmrp::host
