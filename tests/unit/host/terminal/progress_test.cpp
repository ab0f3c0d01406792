// SPDX-License-Identifier: MIT
// The progress bar keeps its heading at every width, and no line of it wraps.
#include "host/terminal/progress.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "host/terminal/colors.hpp"
#include "host/terminal/display_width.hpp"

namespace progress_test {

using namespace dmrp::host;

const std::string heading = "quickstart · mall · 4 robots, 12 people · 3 trials";

TEST_CASE("where the heading has room beside the bar, every line shows both") {
  REQUIRE(has_room_beside_bar(heading, 100, 119));
  for (const double elapsed_s : {0.0, 12.3, 3599.0, 1e6})
    for (std::uint64_t done = 0; done <= 100; ++done) {
      const std::string line = progress_line(heading, done, 100, elapsed_s, 119);
      INFO(line);
      CHECK(line.starts_with(heading));
      CHECK(display_width(line) <= 119);
      CHECK(line.find("/100") != std::string::npos);
    }
}

TEST_CASE("at 80 columns the heading has a line of its own, and the bar one that does not wrap") {
  CHECK_FALSE(has_room_beside_bar(heading, 3, 79));
  CHECK(has_room_beside_bar("short", 3, 79));
  CHECK(progress_line("", 1, 3, 2.0, 79) == "█████░░░░░░░░░░░ 1/3  2.0 s, 4.0 s to go");
  CHECK(progress_line("", 1, 3, 2.0, 79, "mall · CBS + DWA") ==
        "█████░░░░░░░░░░░ 1/3  2.0 s, 4.0 s to go  mall · CBS + DWA");
  CHECK(progress_line("", 1, 3, 2.0, 50, "mall · CBS + DWA") == "█████░░░░░░░░░░░ 1/3  2.0 s, 4.0 s to go");
  CHECK(progress_line("", 1, 3, 2.0, 30) == "1/3  2.0 s, 4.0 s to go");
  CHECK(progress_line("", 1, 3, 2.0, 10) == "1/3");
}

TEST_CASE("a terminal has colours unless NO_COLOR is set or it is dumb") {
  CHECK(allows_colors("xterm", nullptr));
  CHECK(allows_colors("xterm", ""));
  CHECK_FALSE(allows_colors("xterm", "1"));
  CHECK_FALSE(allows_colors("dumb", nullptr));
  CHECK_FALSE(allows_colors(nullptr, nullptr));
}

}  // namespace progress_test
