// SPDX-License-Identifier: MIT
#include "host/errors/escaped_text.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

namespace escaped_text_test {

using dmrp::host::escaped;

TEST_CASE("a text is plain if nothing of it is escaped, however long it is") {
  CHECK(dmrp::host::is_plain(std::string(10'000, 'x') + "\u00e9"));
  CHECK_FALSE(dmrp::host::is_plain(std::string(10'000, 'x') + "\n"));
  CHECK_FALSE(dmrp::host::is_plain("\xff"));
}

TEST_CASE("text in UTF-8 stays as it is") {
  const std::string text = "caf\u00e9 \u4e2d\u6587 \U0001F916 \"quoted\" back\\slash ~\u00a0";
  CHECK(escaped(text.c_str()) == text);
  CHECK(escaped("").empty());
  CHECK(escaped(nullptr).empty());
}

TEST_CASE("control characters are escaped") {
  CHECK(escaped("a\nb\tc\rd") == "a\\nb\\tc\\x0dd");
  CHECK(escaped("\x1b[2J\x07\x7f") == "\\x1b[2J\\x07\\x7f");
  CHECK(escaped("\xc2\x9b"
                "1m") == "\\xc2\\x9b1m");                                            // the C1 form of ESC [
  CHECK(escaped("\xe2\x80\xa8 \xe2\x80\xa9") == "\\xe2\\x80\\xa8 \\xe2\\x80\\xa9");  // line and paragraph separator
}

TEST_CASE("bytes that are not UTF-8 are escaped one by one") {
  CHECK(escaped("a\xff\xfe z") == "a\\xff\\xfe z");
  CHECK(escaped("\x80") == "\\x80");
  CHECK(escaped("caf\xc3") == "caf\\xc3");                       // cut short
  CHECK(escaped("\xe4\xb8z") == "\\xe4\\xb8z");                  // cut short by another character
  CHECK(escaped("\xc0\xaf") == "\\xc0\\xaf");                    // overlong '/'
  CHECK(escaped("\xe0\x80\xaf") == "\\xe0\\x80\\xaf");           // overlong
  CHECK(escaped("\xed\xa0\x80") == "\\xed\\xa0\\x80");           // a surrogate
  CHECK(escaped("\xf4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80");  // beyond U+10FFFF
  CHECK(escaped("\xf0\x9f\xa4\x96") == "\xf0\x9f\xa4\x96");
}

TEST_CASE("whatever the text, the result is valid for JSON and short") {
  std::string bytes;
  for (int i = 1; i < 70'000; ++i) bytes += static_cast<char>(i % 255 + 1);
  const std::string text = escaped(bytes.c_str());
  CHECK_NOTHROW(nlohmann::json(text).dump());
  CHECK(text.size() <= 4 * 4000);
  CHECK(text.find('\n') == std::string::npos);
  CHECK(escaped(std::string(1u << 20, 'x').c_str()) == std::string(4000, 'x'));

  std::string euros;
  for (int i = 0; i < 2000; ++i) euros += "\u20ac";
  CHECK(escaped(euros.c_str()) == euros.substr(0, 3999));  // no part of a character
}

}  // namespace escaped_text_test
