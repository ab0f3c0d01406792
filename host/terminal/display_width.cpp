// SPDX-License-Identifier: MIT
#include "host/terminal/display_width.hpp"

#include <locale.h>
#include <wchar.h>

#include <algorithm>

namespace dmrp::host {
namespace {

// The UTF-8 locale of the C library. Never freed: it lives as long as the process.
locale_t utf8_locale() {
  static const locale_t locale = newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
  return locale;
}

// Sets the locale of this thread alone; setlocale() would change how plugins and libraries read numbers.
class ThreadLocale {
 public:
  explicit ThreadLocale(locale_t locale) : before_(uselocale(locale)) {}
  ~ThreadLocale() { uselocale(before_); }
  ThreadLocale(const ThreadLocale&) = delete;
  ThreadLocale& operator=(const ThreadLocale&) = delete;

 private:
  locale_t before_;
};

// Takes the first character off `text`, which is not empty. A byte that is no UTF-8 counts as one column.
std::size_t take_character(std::string_view& text) {
  mbstate_t state{};
  wchar_t character = 0;
  const std::size_t size = mbrtowc(&character, text.data(), text.size(), &state);
  const bool valid = size > 0 && size <= text.size();
  text.remove_prefix(valid ? size : 1);
  const int columns = valid ? wcwidth(character) : 1;
  return columns < 0 ? 1 : static_cast<std::size_t>(columns);
}

// Where the system has no C.UTF-8: the characters, without knowledge of wide and combining ones.
std::size_t count_characters(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0u) != 0x80u; }));
}

std::size_t missing(std::string_view text, std::size_t width) {
  return width - std::min(width, display_width(text));
}

}  // namespace

std::size_t display_width(std::string_view text) {
  const locale_t locale = utf8_locale();
  if (locale == locale_t{}) return count_characters(text);
  const ThreadLocale in_utf8(locale);
  std::size_t width = 0;
  while (!text.empty()) width += take_character(text);
  return width;
}

std::string pad_right(std::string_view text, std::size_t width) {
  return std::string(text) + std::string(missing(text, width), ' ');
}

std::string pad_left(std::string_view text, std::size_t width) {
  return std::string(missing(text, width), ' ') + std::string(text);
}

}  // namespace dmrp::host
