// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/unit/metrics/synthetic_trial.hpp"

using namespace dmrp::test;

namespace {

dmrp_person person(std::uint64_t id, dmrp_vec2 position, double radius_m = 0.2) {
  dmrp_person made{};
  made.id = id;
  made.position = position;
  made.radius_m = radius_m;
  return made;
}

Measurement measure_people(const std::string& id, const SyntheticTrial& trial, ParamOverrides overrides = {}) {
  PluginUnderTest plugin("libdmrp_rimea_metrics.so", id, std::move(overrides));
  const dmrp_world world = trial.world();
  const Measurement measurement = measure_once(plugin, trial, world);
  CHECK(same_bits(measurement, measure_once(plugin, trial, world)));
  return measurement;
}

}  // namespace

TEST_CASE("travel times run between two lines, interpolated between samples") {
  SyntheticTrial trial(0);
  trial.sample(0.0, {}).crowd({person(1, {0.5, 0.0}), person(2, {0.0, 1.0})});
  trial.sample(1.0, {}).crowd({person(1, {1.5, 0.0}), person(2, {0.5, 1.0})});
  trial.sample(2.0, {}).crowd({person(1, {3.5, 0.0}), person(2, {1.5, 1.0})});
  trial.end(2.0);
  const Measurement m = measure_people("rimea.travel_time", trial, {{"from_x_m", 1.0}, {"to_x_m", 2.5}});
  CHECK(m.values.at({"travel_time", DMRP_SUBJECT_PEDESTRIAN, 1}) == Approx(1.0));  // 0.5 s to 1.5 s
  CHECK(std::isnan(m.values.at({"travel_time", DMRP_SUBJECT_PEDESTRIAN, 2})));
  CHECK(m.system("travel_time") == Approx(1.0));
}

TEST_CASE("an evacuation ends when the last person left") {
  SyntheticTrial trial(0);
  trial.sample(0.0, {}).crowd({person(1, {0.0, 0.0}), person(2, {1.0, 0.0})});
  trial.sample(1.0, {}).crowd({person(2, {1.0, 0.0})});
  SECTION("everybody out") {
    trial.sample(3.0, {}).end(3.0);
    const Measurement m = measure_people("rimea.evacuation", trial);
    CHECK(m.system("evacuation_time") == 3.0);
    CHECK(m.system("people_left_behind") == 0.0);
  }
  SECTION("one stays") {
    trial.end(1.0);
    const Measurement m = measure_people("rimea.evacuation", trial);
    CHECK(std::isnan(m.system("evacuation_time")));
    CHECK(m.system("people_left_behind") == 1.0);
  }
}

TEST_CASE("density and speed are means over the intervals after the beginning") {
  SyntheticTrial trial(0);
  trial.sample(0.0, {}).crowd({person(1, {0.5, 0.5}), person(2, {1.0, 1.0})});
  trial.sample(0.5, {}).crowd({person(1, {0.5, 1.5}), person(2, {1.0, 1.0})});  // between two intervals
  trial.sample(1.0, {}).crowd({person(1, {1.5, 0.5}), person(2, {1.0, 1.0})});
  trial.sample(2.0, {}).crowd({person(1, {2.5, 0.5}), person(2, {1.0, 1.0})});  // one is outside
  trial.end(2.0);
  const ParamOverrides all = {{"upper_m", std::vector<double>{2.0, 2.0}}, {"extent", 4.0}, {"from_s", 0.0}};
  const Measurement m = measure_people("rimea.fundamental_diagram", trial, all);
  CHECK(m.system("density") == Approx((2.0 + 1.0) / 2.0 / 4.0));
  CHECK(m.system("walking_speed") == Approx((1.0 + 0.0 + 0.0) / 3.0));
  CHECK(m.system("specific_flow") == Approx(0.375 / 3.0));

  ParamOverrides late = all;
  late["from_s"] = 1.0;
  CHECK(measure_people("rimea.fundamental_diagram", trial, late).system("density") == Approx(0.25));
}

TEST_CASE("solidity finds overlaps and people in walls") {
  SyntheticTrial trial(0);
  trial.bounds({0.0, 0.0}, {10.0, 10.0}).box("wall", {4.0, 0.0}, {6.0, 5.0});
  trial.sample(0.0, {}).crowd({person(1, {1.0, 1.0}), person(2, {1.37, 1.0}), person(3, {3.85, 2.0})});
  trial.sample(1.0, {}).crowd({person(1, {1.0, 1.0}), person(2, {1.5, 1.0}), person(3, {3.0, 2.0})}).end(1.0);
  const Measurement before = measure_people("rimea.solidity", trial);
  CHECK(before.system("people_overlap") == Approx(0.03));
  CHECK(before.system("wall_overlap") == Approx(0.05));
  CHECK(before.system("outside_free_space") == 0.0);

  // one in the wall, one outside the world, each at two samples
  trial.sample(2.0, {}).crowd({person(1, {5.0, 4.9}), person(2, {-0.1, 1.0})});
  trial.sample(3.0, {}).crowd({person(1, {5.0, 4.8}), person(2, {-0.1, 1.0})}).end(3.0);
  const Measurement m = measure_people("rimea.solidity", trial);
  CHECK(m.system("outside_free_space") == 2.0);
  CHECK(m.system("wall_overlap") == Approx(0.4));  // 0.2 m behind the wall's face, and the radius
}

TEST_CASE("a bottleneck is measured while people arrive at it") {
  // ten people wait in a column before x = 5; one a second goes through, and walks on at 1 m/s
  SyntheticTrial trial(0);
  for (int t = 0; t <= 12; ++t) {
    std::vector<dmrp_person> people;
    for (int i = 0; i < 10; ++i) {
      const double x = i < t ? 5.5 + (t - i - 1) : 4.5;
      people.push_back(person(static_cast<std::uint64_t>(i), {x, 0.05 + 0.1 * i}));
    }
    trial.sample(t, {}).crowd(people);
  }
  trial.end(12.0);
  const Measurement m = measure_people("rimea.bottleneck", trial,
                                       {{"line_x_m", 5.0},
                                        {"width_m", 2.0},
                                        {"before_lower_m", std::vector<double>{4.0, 0.0}},
                                        {"before_upper_m", std::vector<double>{5.0, 1.0}},
                                        {"behind_lower_m", std::vector<double>{5.0, 0.0}},
                                        {"behind_upper_m", std::vector<double>{7.0, 1.0}},
                                        {"exit_lower_m", std::vector<double>{20.0, 0.0}},
                                        {"exit_upper_m", std::vector<double>{21.0, 1.0}}});
  // from t = 1 (one through) to t = 8 (eight through)
  CHECK(m.system("bottleneck_flow") == Approx(7.0 / (7.0 * 2.0)));
  CHECK(m.system("density_before") == Approx((9 + 8 + 7 + 6 + 5 + 4 + 3 + 2) / 8.0));
  CHECK(m.system("speed_before") == 0.0);
  CHECK(m.system("density_behind") == Approx((1 + 7 * 2) / 8.0 / 2.0));
  CHECK(m.system("speed_behind") == Approx(1.0));
  CHECK(m.system("density_at_exit") == 0.0);
  CHECK(std::isnan(m.system("speed_at_exit")));
}

TEST_CASE("a counter-flow has its speed over the desired one, and an order of lanes") {
  const auto walker = [](std::uint64_t id, dmrp_vec2 at, double direction, double speed) {
    dmrp_person made = person(id, at);
    made.target = {at.x + 10.0 * direction, at.y};
    made.velocity = {direction * speed, 0.0};
    made.desired_speed = 1.0;
    return made;
  };
  const auto measure_rows = [&](double one, double other) {
    SyntheticTrial trial(0);
    std::vector<dmrp_person> people;
    for (std::uint64_t i = 0; i < 4;
         ++i) {  // two rows of four, 1 m apart, the second half of each in its own direction
      const double x = 1.0 + static_cast<double>(i);
      people.push_back(walker(i, {x, 1.0}, i < 2 ? 1.0 : one, 0.5));
      people.push_back(walker(4 + i, {x, 2.0}, i < 2 ? -1.0 : other, 1.0));
    }
    people.push_back(walker(9, {20.0, 1.0}, -1.0, 1.0));  // outside
    trial.sample(0.0, {}).crowd(people);
    trial.sample(1.0, {}).crowd(people).end(1.0);
    return measure_people("rimea.counter_flow", trial, {{"upper_m", std::vector<double>{10.0, 3.0}}, {"from_s", 0.0}});
  };
  const Measurement lanes = measure_rows(1.0, -1.0);
  CHECK(lanes.system("relative_speed") == Approx(0.75));
  CHECK(lanes.system("lane_order") == Approx(1.0));
  CHECK(measure_rows(-1.0, 1.0).system("lane_order") == Approx((0.0 - 0.25) / 0.75));  // half and half in every row
  CHECK(measure_rows(1.0, 1.0).system("lane_order") == Approx((0.5 - 0.25) / 0.75));
}

TEST_CASE("an area without two corners in order is refused") {
  SyntheticTrial trial(0);
  trial.sample(0.0, {}).end(0.0);
  CHECK_THROWS_WITH(measure_people("rimea.fundamental_diagram", trial, {{"upper_m", std::vector<double>{-1.0, 2.0}}}),
                    Catch::Contains("two corners"));
}
