// SPDX-License-Identifier: MIT
#include "host/terminal/display_width.hpp"

#include <locale.h>

#include <catch2/catch.hpp>

namespace display_width_test {

using namespace dmrp::host;

TEST_CASE("the width of a text is that on a terminal", "[terminal]") {
  CHECK(display_width("") == 0);
  CHECK(display_width("abc") == 3);
  CHECK(display_width("±0.17 – ö") == 9);
  CHECK(display_width("e\xCC\x81") == 1);                 // e with a combining accent
  CHECK(display_width("\xE6\xBC\xA2\xE5\xAD\x97") == 4);  // two ideographs
  CHECK(display_width("\xF0\x9F\xA4\x96") == 2);          // a robot's face
  CHECK(display_width("\xFF\xC3") == 2);                  // no UTF-8
  CHECK(pad_left("±1", 4) == "  ±1");
  CHECK(pad_right("ö", 3) == "ö  ");
  CHECK(pad_left("long", 2) == "long");
}

TEST_CASE("measuring a text leaves the locale as it is", "[terminal]") {
  const locale_t before = uselocale(nullptr);
  const std::string process = setlocale(LC_ALL, nullptr);
  CHECK(display_width("\xE6\xBC\xA2") == 2);
  CHECK(uselocale(nullptr) == before);
  CHECK(setlocale(LC_ALL, nullptr) == process);
}

}  // namespace display_width_test
