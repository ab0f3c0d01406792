// SPDX-License-Identifier: MIT
// text_lines.hpp: the lines of a text file, and errors that name a line and a column.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dmrp::host {

// A field of a line and the column of its first character, from 1.
struct TextField {
  std::string_view text;
  std::size_t column = 1;
};

class TextLines {
 public:
  // `text`: the content of the file. `shown_path`: its path in messages.
  TextLines(std::string text, std::string shown_path);

  TextLines(const TextLines&) = delete;
  TextLines& operator=(const TextLines&) = delete;

  std::size_t count() const { return lines_.size(); }

  // Without its end, which may be "\n" or "\r\n". Lines count from 1; beyond the last one they are empty.
  std::string_view line(std::size_t number) const { return number <= count() ? lines_[number - 1] : ""; }

  // Throws InputError: "file:line:column: text".
  [[noreturn]] void fail(std::size_t line, std::size_t column, const std::string& text) const;

 private:
  std::string shown_path_;
  std::string text_;
  std::vector<std::string_view> lines_;
};

}  // namespace dmrp::host
