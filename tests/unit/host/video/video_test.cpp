// SPDX-License-Identifier: MIT
#include <array>
#include <catch2/catch.hpp>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "host/video/canvas.hpp"
#include "host/video/trial_picture.hpp"
#include "tests/unit/core/trace/trace_example.hpp"

namespace dmrp::host {
namespace {

int red_at(const Canvas& canvas, int x, int y) {
  return canvas.bytes()[3 * static_cast<std::size_t>(y * canvas.width() + x)];
}

// The covered area in pixels, of black on white.
double dark_area(const Canvas& canvas) {
  double sum = 0.0;
  for (int y = 0; y < canvas.height(); ++y)
    for (int x = 0; x < canvas.width(); ++x) sum += 1.0 - red_at(canvas, x, y) / 255.0;
  return sum;
}

constexpr Color white = {255, 255, 255};
constexpr Color black = {0, 0, 0};

TEST_CASE("a polygon covers pixels by their share, and nothing outside of the canvas", "[video]") {
  Canvas canvas(10, 8, white);
  const std::array<dmrp_vec2, 4> square = {{{2.5, 3}, {5, 3}, {5, 5.5}, {2.5, 5.5}}};
  canvas.polygon(square, black);
  CHECK(red_at(canvas, 1, 3) == 255);
  CHECK(red_at(canvas, 2, 3) == 128);
  CHECK(red_at(canvas, 3, 3) == 0);
  CHECK(red_at(canvas, 5, 3) == 255);
  CHECK(red_at(canvas, 3, 5) == 128);
  CHECK(dark_area(canvas) == Approx(6.25).margin(0.02));
  const std::array<dmrp_vec2, 3> far = {{{-1e7, -50}, {30, -50}, {30, 1e7}}};
  canvas.polygon(far, black);
  CHECK(red_at(canvas, 9, 0) == 0);
}

TEST_CASE("discs and lines have their areas, and overlapping parts of a line are painted once", "[video]") {
  Canvas disc(40, 40, white);
  disc.disc({20, 20}, 12, black);
  CHECK(dark_area(disc) == Approx(std::numbers::pi * 144).epsilon(0.02));
  Canvas line(60, 20, white);
  const std::array<dmrp_vec2, 3> points = {{{10, 10}, {30, 10}, {50, 10}}};
  line.line(points, 4, black, 0.5);
  CHECK(dark_area(line) == Approx(0.5 * (160 + std::numbers::pi * 4)).epsilon(0.03));
  CHECK(red_at(line, 30, 10) == 128);
}

TEST_CASE("digits are drawn around their middle", "[video]") {
  Canvas canvas(40, 20, white);
  canvas.text({20, 10}, "11", 2, black);
  CHECK(dark_area(canvas) == Approx(2 * 10 * 4));  // ten squares a digit
  double left = 0.0;
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) left += red_at(canvas, x, y) == 0 ? 1.0 : 0.0;
  CHECK(left == Approx(40));
}

TEST_CASE("robots have the colours of the report's style sheet", "[video]") {
  std::ifstream file(DMRP_PAGE_STYLES);
  std::stringstream text;
  text << file.rdbuf();
  const std::string styles = text.str();
  for (std::size_t i = 0; i < 24; ++i) {
    const std::string name = "--series-" + std::to_string(i + 1) + ": ";
    const std::size_t at = styles.find(name);  // the light theme is the first
    REQUIRE(at != std::string::npos);
    const Color expected = color_of(styles.substr(at + name.size(), 7));
    const Color color = robot_color(i);
    CHECK(std::array{color.red, color.green, color.blue} == std::array{expected.red, expected.green, expected.blue});
  }
}

TEST_CASE("a picture has the world's proportions and the robots where they are", "[video]") {
  const core::TraceBytes bytes = test::example_trace(10);
  core::TraceReader trace(bytes);
  const dmrp_world& world = trace.world();
  TrialPicture picture(world, 640, 480);
  const dmrp_sample* sample = trace.next_sample();
  REQUIRE(sample);
  picture.observe(*sample);
  const Canvas canvas = picture.draw(*sample);
  CHECK(canvas.width() % 2 == 0);
  CHECK(canvas.height() % 2 == 0);
  CHECK(canvas.width() <= 642);
  CHECK(canvas.height() <= 482);
  const double proportions = (world.upper.x - world.lower.x) / (world.upper.y - world.lower.y);
  CHECK((canvas.width() - 24.0) / (canvas.height() - 24.0) == Approx(proportions).epsilon(0.02));

  const auto count = [&](Color color) {
    std::size_t pixels = 0;
    for (std::size_t i = 0; i < canvas.bytes().size(); i += 3)
      if (canvas.bytes()[i] == color.red && canvas.bytes()[i + 1] == color.green && canvas.bytes()[i + 2] == color.blue)
        ++pixels;
    return pixels;
  };
  CHECK(count(robot_color(0)) > 50);
  CHECK(count(robot_color(1)) > 50);
  CHECK(count(robot_color(2)) == 0);
}

}  // namespace
}  // namespace dmrp::host
