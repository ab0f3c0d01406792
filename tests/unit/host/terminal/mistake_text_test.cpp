// SPDX-License-Identifier: MIT
// A mistake shows its line of the file, with a caret under the place.
#include "host/terminal/mistake_text.hpp"

#include <catch2/catch.hpp>

#include "host/errors/mistakes.hpp"

namespace mistake_text_test {

using dmrp::host::InputError;
using dmrp::host::mistake_text;
using dmrp::host::Mistakes;
using dmrp::host::SourcePlace;

InputError mistake(std::size_t line, std::size_t column, const std::string& text, const std::string& said = "said") {
  return InputError("a.toml:" + std::to_string(line) + ":" + std::to_string(column) + ": " + said,
                    {"a.toml", line, column, text});
}

TEST_CASE("a mistake is its line, the file's line and a caret") {
  CHECK(mistake_text(mistake(4, 10, "trials = \"three\""), false) ==
        "a.toml:4:10: said\n"
        "    4 | trials = \"three\"\n"
        "      |          ^\n");
  CHECK(mistake_text(mistake(4, 10, "trials = \"three\""), true) ==
        "\x1b[1ma.toml:4:10:\x1b[0m said\n"
        "    4 | trials = \"three\"\n"
        "      |          \x1b[1;31m^\x1b[0m\n");
}

TEST_CASE("the caret stands under characters, not under bytes") {
  CHECK(mistake_text(mistake(1, 6, "ü = \"日本\" x"), false) ==
        "a.toml:1:6: said\n"
        "    1 | ü = \"日本\" x\n"
        "      |      ^\n");
  CHECK(mistake_text(mistake(1, 8, "ü = \"日本\" x"), false) ==
        "a.toml:1:8: said\n"
        "    1 | ü = \"日本\" x\n"
        "      |          ^\n");
  CHECK(mistake_text(mistake(1, 2, "\tx\x1b[2J"), false) ==
        "a.toml:1:2: said\n"
        "    1 |  x [2J\n"
        "      |  ^\n");
}

TEST_CASE("a long line is cut around the place") {
  const std::string text = mistake_text(mistake(1, 501, std::string(500, 'a') + "X" + std::string(500, 'b')), false);
  const std::string cut = "..." + std::string(60, 'a') + "X" + std::string(39, 'b') + "...";
  CHECK(text == "a.toml:1:501: said\n    1 | " + cut + "\n      | " + std::string(63, ' ') + "^\n");
  CHECK(mistake_text(mistake(1, 9, "short"), false) == "a.toml:1:9: said\n    1 | short\n      |      ^\n");
}

TEST_CASE("mistakes without a place or a line stay one line") {
  CHECK(mistake_text(InputError("none.toml: there is no such experiment file"), true) ==
        "none.toml: there is no such experiment file\n");
  CHECK(mistake_text(mistake(1, 1, ""), false) == "a.toml:1:1: said\n");
}

TEST_CASE("all mistakes are told, those of a file in the order of its lines, each once") {
  Mistakes mistakes;
  CHECK(mistakes.attempt([] {}));
  CHECK_NOTHROW(mistakes.end());
  for (const std::size_t line : {9, 2, 9}) CHECK_FALSE(mistakes.attempt([&] { throw mistake(line, 1, ""); }));
  CHECK_FALSE(mistakes.attempt([&] {
    Mistakes inner;
    inner.attempt([] { throw InputError("b.toml:1:1: said", SourcePlace{"b.toml", 1, 1, ""}); });
    inner.attempt([] { throw mistake(5, 1, "x"); });
    inner.end();
  }));
  try {
    mistakes.end();
    FAIL("nothing was thrown");
  } catch (const InputError& error) {
    CHECK(std::string(error.what()) == "a.toml:2:1: said");
    CHECK(mistake_text(error, false) ==
          "a.toml:2:1: said\n"
          "a.toml:5:1: said\n"
          "    5 | x\n"
          "      | ^\n"
          "a.toml:9:1: said\n"
          "b.toml:1:1: said\n"
          "4 mistakes\n");
  }
}

TEST_CASE("reading ends after a hundred mistakes") {
  Mistakes mistakes;
  std::size_t runs = 0;
  for (std::size_t line = 1; line <= 1000; ++line)
    mistakes.attempt([&] {
      ++runs;
      throw mistake(line, 1, "");
    });
  CHECK(runs == 100);
  try {
    mistakes.end();
  } catch (const InputError& error) {
    CHECK(mistake_text(error, false).ends_with("a.toml:100:1: said\nthe first 100 mistakes; there may be more\n"));
  }
}

}  // namespace mistake_text_test
