// SPDX-License-Identifier: MIT
#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "core/picture/trial_picture.hpp"
#include "core/trace/trace_reader.hpp"
#include "tests/unit/core/trace/trace_example.hpp"

namespace picture_test {

using namespace dmrp;
using namespace dmrp::core;

constexpr Ink black = ink_of(0x000000);

// The covered area in dots, of black on white.
double dark_area(Painter& painter) {
  double sum = 0.0;
  const auto bytes = painter.frame();
  for (std::size_t i = 0; i < bytes.size(); i += 4) sum += 1.0 - bytes[i] / 255.0;
  return sum;
}

std::size_t count_of(std::span<const std::uint8_t> frame, const Ink& ink) {
  std::size_t dots = 0;
  for (std::size_t i = 0; i < frame.size(); i += 4)
    if (frame[i] == ink.blue && frame[i + 1] == ink.green && frame[i + 2] == ink.red) ++dots;
  return dots;
}

std::string example_map(PictureFormat format, const std::string& title) {
  const TraceBytes bytes = dmrp::test::example_trace(10);
  TraceReader trace(bytes);
  TrialMap map(trace.world());
  while (const dmrp_sample* sample = trace.next_sample()) map.observe(*sample);
  return map.document(format, title);
}

TEST_CASE("areas and lines cover dots by their share", "[picture]") {
  Painter square(PictureFormat::frame, 10, 8);
  const std::array<dmrp_vec2, 4> corners = {{{2.5, 3}, {5, 3}, {5, 5.5}, {2.5, 5.5}}};
  square.polygon(corners, {black});
  CHECK(dark_area(square) == Approx(6.25).margin(0.05));
  Painter larger(PictureFormat::frame, 10, 8, 2.0);
  larger.polygon(corners, {black});
  CHECK(larger.frame().size() == 4 * square.frame().size());
  CHECK(dark_area(larger) == Approx(25.0).margin(0.1));
  Painter line(PictureFormat::frame, 60, 20);
  const std::array<dmrp_vec2, 3> points = {{{10, 10}, {30, 10}, {50, 10}}};
  line.line(points, {{}, black.fainter(0.5), 4.0});
  CHECK(dark_area(line) == Approx(0.5 * (160 + 3.14 * 4)).epsilon(0.03));
  Painter white(PictureFormat::frame, 60, 20);
  line.copy(white);
  CHECK(dark_area(line) == 0.0);
}

TEST_CASE("words are drawn whatever their bytes are", "[picture]") {
  for (const char* words : {"robot 1",
                            "r\xff"
                            "bot",
                            "Stra\xc3\x9f"
                            "e",
                            "a\nb"}) {
    Painter painter(PictureFormat::frame, 100, 20);
    painter.text({50, 10}, words, {12.0, black});
    const double alone = dark_area(painter);
    CHECK(alone > 20.0);
    const std::array<dmrp_vec2, 4> corners = {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}};
    painter.polygon(corners, {black});
    CHECK(dark_area(painter) == Approx(alone + 16.0).margin(0.01));
  }
}

TEST_CASE("robots have the colours of the report's style sheet", "[picture]") {
  std::ifstream file(DMRP_PAGE_STYLES);
  std::stringstream text;
  text << file.rdbuf();
  const std::string styles = text.str();
  for (std::size_t i = 0; i < 24; ++i) {
    const Ink ink = robot_ink(i);
    std::array<char, 8> hex{};
    std::snprintf(hex.data(), hex.size(), "#%02x%02x%02x", ink.red, ink.green, ink.blue);
    // the light theme is the first
    const std::size_t at = styles.find("--series-" + std::to_string(i + 1) + ": ");
    REQUIRE(at != std::string::npos);
    CHECK(styles.substr(styles.find('#', at), 7) == hex.data());
  }
}

TEST_CASE("a map is a document of its format, the same each time", "[picture]") {
  CHECK(example_map(PictureFormat::svg, "a").substr(0, 5) == "<?xml");
  CHECK(example_map(PictureFormat::pdf, "a").substr(0, 5) == "%PDF-");
  CHECK(example_map(PictureFormat::png, "a").substr(1, 3) == "PNG");
  for (const PictureFormat format : {PictureFormat::pdf, PictureFormat::png}) {
    CHECK(example_map(format, "a") == example_map(format, "a"));
    CHECK(example_map(format, "a") != example_map(format, "b"));
  }
}

TEST_CASE("a frame has its size, and the robots where they are", "[picture]") {
  const TraceBytes bytes = dmrp::test::example_trace(10);
  TraceReader trace(bytes);
  TrialFrames frames(trace.world(), 640, 480, "title");
  const dmrp_sample* sample = trace.next_sample();
  REQUIRE(sample);
  frames.observe(*sample);
  const auto first = frames.frame(*sample, "0.0 s");
  CHECK(first.size() == 4 * 640 * 480);
  CHECK(count_of(first, robot_ink(0)) > 50);
  CHECK(count_of(first, robot_ink(1)) > 50);
  CHECK(count_of(first, robot_ink(2)) == 0);
  // what moves leaves nothing but its way
  const std::vector<std::uint8_t> before(first.begin(), first.end());
  const auto again = frames.frame(*sample, "0.0 s");
  CHECK(std::equal(again.begin(), again.end(), before.begin()));
  const auto later = frames.frame(*sample, "1.0 s");
  CHECK_FALSE(std::equal(later.begin(), later.end(), before.begin()));
}

}  // namespace picture_test
