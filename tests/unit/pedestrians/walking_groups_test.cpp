// SPDX-License-Identifier: MIT
// Groups in the social force model, compared with Moussaid et al., PLoS ONE 5 (2010): they walk side by side and 0.8 m
// apart at low density, 0.04 m/s slower for each member, and stay together among other people.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>

#include "tests/unit/pedestrians/walking_world.hpp"

namespace walking_groups_test {

using namespace dmrp::test;
using dmrp::toolkit::distance;
using dmrp::toolkit::Stream;

const std::string social_force = "dmrp.pedestrian.social_force";
constexpr double body_radius_m = 0.2;  // the host's default

// Members of a group who walk east to targets side by side; `begin`: their first positions.
void add_group(Walk& walk, uint32_t group, const std::vector<dmrp_vec2>& begin, double speed) {
  for (std::size_t i = 0; i < begin.size(); ++i) {
    const double y = begin[0].y + 0.8 * (static_cast<double>(i) - 0.5 * static_cast<double>(begin.size() - 1));
    dmrp_person one = person(walk.people.size() + 1, begin[i], {98.0, y}, speed);
    one.group = group;
    one.radius_m = body_radius_m;
    walk.people.push_back(one);
  }
}

double mean_x(const Walk& walk, std::size_t size) {
  double sum_m = 0.0;
  for (std::size_t i = 0; i < size; ++i) sum_m += walk.people[i].position.x;
  return sum_m / static_cast<double>(size);
}

// Members abreast, in the middle of a hall 8 m wide.
std::vector<dmrp_vec2> abreast(std::size_t size) {
  std::vector<dmrp_vec2> begin;
  for (std::size_t i = 0; i < size; ++i)
    begin.push_back({3.0, 4.0 + 0.8 * (static_cast<double>(i) - 0.5 * static_cast<double>(size - 1))});
  return begin;
}

// The shape of a group that walks along x.
struct Shape {
  double longest_m = 0.0;  // greatest distance of neighbours, from right to left, at any time
  double abreast = 0.0;    // share of the time in which the group is wider than long
  double mean_m = 0.0;     // mean distance of neighbours
  double middle_m = 0.0;   // how far the middle one of three is ahead of the others, on average
};

Shape watch(Walk& walk, std::size_t first, std::size_t size, double duration_s) {
  Shape shape;
  int steps = 0;
  walk.until(duration_s, [&] {
    std::vector<dmrp_vec2> at;
    for (std::size_t i = first; i < first + size; ++i) at.push_back(walk.people[i].position);
    std::sort(at.begin(), at.end(), [](dmrp_vec2 a, dmrp_vec2 b) { return a.x < b.x; });
    const double long_m = at.back().x - at.front().x;
    std::sort(at.begin(), at.end(), [](dmrp_vec2 a, dmrp_vec2 b) { return a.y < b.y; });
    const double broad_m = at.back().y - at.front().y;
    shape.abreast += broad_m > long_m;
    for (std::size_t i = 1; i < size; ++i) {
      shape.longest_m = std::max(shape.longest_m, distance(at[i - 1], at[i]));
      shape.mean_m += distance(at[i - 1], at[i]) / static_cast<double>(size - 1);
    }
    if (size == 3) shape.middle_m += at[1].x - 0.5 * (at[0].x + at[2].x);
    ++steps;
    return false;
  });
  shape.abreast /= steps;
  shape.mean_m /= steps;
  shape.middle_m /= steps;
  return shape;
}

TEST_CASE("a pair walks side by side and close together from any first positions") {
  const WalkingWorld world({100.0, 8.0}, {});
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    Stream chance(seed, "test.pair");
    const dmrp_vec2 begin = {3.0, chance.uniform(2.5, 5.5)};
    const double angle = chance.uniform(-3.0, 3.0);
    Walk walk(world, social_force);
    add_group(walk, 1, {begin, begin + 0.8 * dmrp::toolkit::from_angle(angle)}, chance.uniform(0.8, 1.5));
    watch(walk, 0, 2, 10.0);
    const Shape shape = watch(walk, 0, 2, 40.0);
    INFO("angle " << angle);
    CHECK(shape.longest_m < 1.5);
    CHECK(shape.abreast > 0.9);
    CHECK(shape.mean_m == Approx(0.8).margin(0.1));  // Moussaid's table 1: 0.78 m at low density
  }
}

TEST_CASE("groups of three walk side by side or in a V") {
  const WalkingWorld world({100.0, 8.0}, {});
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    Stream chance(seed, "test.three");
    const dmrp_vec2 begin = {4.0, chance.uniform(2.5, 5.5)};
    const double angle = chance.uniform(-3.0, 3.0);
    const dmrp_vec2 aside = 0.8 * dmrp::toolkit::from_angle(angle);
    Walk walk(world, social_force);
    add_group(walk, 1, {begin - aside, begin, begin + aside}, chance.uniform(0.8, 1.5));
    watch(walk, 0, 3, 10.0);
    const Shape shape = watch(walk, 0, 3, 40.0);
    INFO("angle " << angle);
    CHECK(shape.longest_m < 1.6);
    CHECK(shape.abreast > 0.9);
    CHECK(shape.mean_m == Approx(0.8).margin(0.2));
    CHECK(shape.middle_m < 0.05);  // Moussaid's V: the middle one behind, not ahead
  }
}

TEST_CASE("groups walk as much slower as Moussaid's") {
  const WalkingWorld world({100.0, 8.0}, {});
  for (const std::size_t size : {1, 2, 3, 4}) {
    Walk walk(world, social_force);
    add_group(walk, size > 1 ? 1 : 0, abreast(size), 1.3);
    walk_for(walk, 10.0);
    const double from_m = mean_x(walk, size);
    walk_for(walk, 40.0);
    const double observed = (1.26 - 0.04 * static_cast<double>(size)) / (1.26 - 0.04);  // figure 2, low density
    CHECK((mean_x(walk, size) - from_m) / 40.0 / 1.3 == Approx(observed).margin(0.015));
  }
}

TEST_CASE("groups in a counter-flow stay together and mostly side by side") {
  const WalkingWorld world({100.0, 8.0}, {});
  for (const std::size_t size : {2, 3})
    for (uint64_t seed = 1; seed <= 3; ++seed) {
      Stream chance(seed, "test.stream");
      Walk walk(world, social_force);
      add_group(walk, 1, std::vector<dmrp_vec2>{{3.0, 3.2}, {3.0, 4.0}, {3.0, 4.8}}, 1.2);
      walk.people.resize(size);
      for (int i = 0; i < 16; ++i) {
        const double y = chance.uniform(1.0, 7.0);
        walk.people.push_back(person(walk.people.size() + 1, {20.0 + 4.0 * i, y}, {2.0, y}, chance.uniform(0.9, 1.5)));
        walk.people.back().radius_m = body_radius_m;
      }
      const Shape shape = watch(walk, 0, size, 40.0);
      CHECK(shape.longest_m < 3.0);
      CHECK(shape.mean_m < 1.2);
      CHECK(shape.abreast > 0.5);
    }
}

}  // namespace walking_groups_test
