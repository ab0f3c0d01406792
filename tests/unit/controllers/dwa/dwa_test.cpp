// SPDX-License-Identifier: MIT
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <limits>
#include <queue>

#include "controllers/dwa/critics.hpp"
#include "tests/unit/controllers/fake_costmap.hpp"
#include "tests/unit/controllers/robot_body.hpp"

namespace dwa_test {

using namespace dmrp::controllers;
using namespace dmrp::controllers::dwa;
using dmrp::test::FakeCostmap;

const dmrp_footprint disc = dmrp::test::disc_footprint(0.25);
constexpr double infinity = std::numeric_limits<double>::infinity();

const dmrp_goal goal{};

dmrp_observation moving(const dmrp_limits& limits, double v, double omega) {
  dmrp_observation c{};
  c.struct_size = sizeof(c);
  c.dt_ns = 100'000'000;
  c.velocity = {v, 0.0, omega};
  c.goal = &goal;
  c.limits = &limits;
  c.footprint = &disc;
  c.agent_stride = sizeof(dmrp_agent);
  return c;
}

// The terrain and the fronts of one control period.
struct Bench {
  FakeCostmap fake{120};
  dmrp_costmap c{};
  Terrain terrain;
  WaveFront path, goal, front;
  OscillationGuard oscillation;
  Tuning tuning;

  void read() {
    c = fake.c();
    const CostmapView map(c);
    terrain.read(map, map.highest_cost_at(0.30));
  }
  std::int32_t index(double x, double y) const { return terrain.index_of(CostmapView(c), {x, y}); }

  void spread(const std::vector<dmrp_vec2>& path_points, dmrp_vec2 front_point) {
    path.begin(terrain), goal.begin(terrain), front.begin(terrain);
    for (const dmrp_vec2 p : path_points) path.seed(index(p.x, p.y));
    path.spread();
    goal.seed(index(path_points.back().x, path_points.back().y));
    goal.spread();
    front.seed(index(front_point.x, front_point.y));
    front.spread();
  }
};

// Shortest distances, by a priority queue.
std::vector<int> reference_distances(const Terrain& terrain, const std::vector<std::int32_t>& seeds) {
  std::vector<int> distances(terrain.marks().size(), std::numeric_limits<int>::max());
  std::priority_queue<std::pair<int, std::int32_t>, std::vector<std::pair<int, std::int32_t>>, std::greater<>> open;
  for (const std::int32_t seed : seeds) {
    if (!terrain.is_free(seed)) continue;
    distances[static_cast<std::size_t>(seed)] = 0;
    open.emplace(0, seed);
  }
  while (!open.empty()) {
    const auto [distance, from] = open.top();
    open.pop();
    if (distance > distances[static_cast<std::size_t>(from)]) continue;
    for (const std::int32_t offset : {1, -1, terrain.stride(), -terrain.stride()}) {
      const auto to = static_cast<std::size_t>(from + offset);
      if (!terrain.is_free(from + offset)) continue;
      if (distance + 1 >= distances[to]) continue;
      distances[to] = distance + 1;
      open.emplace(distances[to], from + offset);
    }
  }
  return distances;
}

TEST_CASE("Samples cover the range and include zero if it lies inside") {
  std::vector<double> values;
  sample_range(-0.1, 0.1, 4, values);
  REQUIRE(values.size() == 5);
  CHECK(values.front() == -0.1);
  CHECK(values[2] == 0.0);
  CHECK(values.back() == 0.1);
  CHECK(std::is_sorted(values.begin(), values.end()));
  sample_range(0.0, 0.1, 3, values);
  CHECK(values == std::vector<double>{0.0, 0.05, 0.1});
  sample_range(0.2, 0.2, 3, values);
  CHECK(values == std::vector<double>{0.2});
}

TEST_CASE("The window contains the velocities that the accelerations allow, within the limits") {
  const dmrp_limits limits = dmrp::test::differential_limits(0.0, 0.8, 1.0, 0.5, 2.0);
  VelocityWindow window;
  window.sample(dmrp::Observation(moving(limits, 0.4, 0.9)), 0.1, 0.8, {3, 2, 4});
  CHECK(window.v.front() == Approx(0.35));
  CHECK(window.v.back() == Approx(0.45));
  CHECK(window.omega.front() == Approx(0.7));
  CHECK(window.omega.back() == 1.0);
  window.sample(dmrp::Observation(moving(limits, 0.0, 0.0)), 0.1, 0.8, {3, 2, 4});
  CHECK(window.v.front() == 0.0);  // v_min
  CHECK(std::count(window.omega.begin(), window.omega.end(), 0.0) == 1);
  window.sample(dmrp::Observation(moving(limits, 0.9, -1.5)), 0.1, 0.8, {3, 2, 4});  // measured with noise
  CHECK(window.v == std::vector<double>{0.8});
  window.sample(dmrp::Observation(moving(limits, 0.4, 0.0)), 1.7, 0.6, {3, 2, 4});
  CHECK(window.v == std::vector<double>{0.0, 0.3, 0.6});
  CHECK(window.omega.front() == -1.0);
}

TEST_CASE("Turning back and forth on the spot is prevented until the robot has moved or turned") {
  OscillationGuard guard;
  const dmrp_pose here = {0.0, 0.0, 0.0};
  guard.record(here, {0.0, 0.3});
  CHECK(guard.allows({0.0, -0.3}));
  guard.record(here, {0.0, -0.1});  // reverses
  CHECK_FALSE(guard.allows({0.0, 0.1}));
  CHECK_FALSE(guard.allows({0.5, 0.1}));
  CHECK(guard.allows({0.5, 0.0}));
  for (int i = 0; i < 100; ++i) CHECK_FALSE(guard.allows({0.1, 0.1}));  // asking does not wear it off
  guard.release({0.04, 0.0, 0.1}, 0.05, 0.2);
  CHECK_FALSE(guard.allows({0.0, 0.1}));
  SECTION("moved") {
    guard.release({0.06, 0.0, 0.0}, 0.05, 0.2);
  }
  SECTION("turned") {
    guard.release({0.0, 0.0, -0.21}, 0.05, 0.2);
  }
  CHECK(guard.allows({0.0, 0.1}));
  // turning either way while driving is steering
  guard.reset();
  guard.record(here, {0.5, 0.3});
  guard.record(here, {0.5, -0.3});
  CHECK(guard.allows({0.5, 0.3}));
  // so is no going back and forth
  guard.record(here, {-0.1, 0.0});
  CHECK_FALSE(guard.allows({0.1, 0.0}));
  CHECK(guard.allows({-0.1, 0.0}));
}

TEST_CASE("Fronts give the shortest distances") {
  dmrp::toolkit::Stream random(7, "fronts");
  for (int round = 0; round < 20; ++round) {
    Bench bench;
    for (int i = 0; i < 25; ++i) bench.fake.mark(random.uniform(0.0, 5.99), random.uniform(0.0, 5.99));
    bench.read();
    std::vector<std::int32_t> seeds;
    for (int i = 0; i < 3; ++i) seeds.push_back(bench.index(random.uniform(0.0, 5.99), random.uniform(0.0, 5.99)));
    WaveFront front;
    front.begin(bench.terrain);
    for (const std::int32_t seed : seeds) front.seed(seed);
    front.spread();
    const std::vector<int> reference = reference_distances(bench.terrain, seeds);
    int differences = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
      const bool reached = front.reached(static_cast<std::int32_t>(i));
      differences += reached != (reference[i] < std::numeric_limits<int>::max()) ||
                     (reached && front.cells(static_cast<std::int32_t>(i)) != reference[i]);
    }
    REQUIRE(differences == 0);
  }
}

TEST_CASE("Fronts that end early agree with complete ones on the requested cells") {
  dmrp::toolkit::Stream random(13, "early fronts");
  int cells_saved = 0;
  for (int round = 0; round < 30; ++round) {
    Bench bench;
    for (int i = 0; i < 30; ++i) bench.fake.mark(random.uniform(0.0, 5.99), random.uniform(0.0, 5.99));
    bench.read();
    const std::int32_t seed = bench.index(random.uniform(0.0, 5.99), random.uniform(0.0, 5.99));
    Terrain narrowed = bench.terrain;
    std::int32_t column[2], row[2];  // of the requested rectangle; it may extend beyond the window
    for (int i = 0; i < 2; ++i) {
      column[i] = static_cast<std::int32_t>(random.uniform(-10.0, 100.0)) + 20 * i;
      row[i] = static_cast<std::int32_t>(random.uniform(-10.0, 100.0)) + 20 * i;
    }
    narrowed.request(column[0], column[1], row[0], row[1]);
    WaveFront whole, early, everywhere;
    whole.begin(bench.terrain), early.begin(narrowed), everywhere.begin(narrowed, true);
    for (WaveFront* front : {&whole, &early, &everywhere}) {
      front->seed(seed);
      front->spread();
    }
    int differences = 0;
    const std::int32_t stride = narrowed.stride();
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(narrowed.marks().size()); ++i) {
      const std::int32_t c = i % stride - 1;
      const std::int32_t r = i / stride - 1;
      const bool is_requested = column[0] <= c && c <= column[1] && row[0] <= r && r <= row[1];
      const auto differs = [&](const WaveFront& front) {
        return whole.reached(i) != front.reached(i) || (whole.reached(i) && whole.cells(i) != front.cells(i));
      };
      differences += differs(everywhere) || (is_requested && differs(early));
      cells_saved += whole.reached(i) && !early.reached(i);
    }
    REQUIRE(differences == 0);
  }
  CHECK(cells_saved > 5000);
}

TEST_CASE("An arc that begins with an acceleration phase") {
  Bench bench;
  bench.read();
  const CostmapView map(bench.c);
  const dmrp_pose pose = {1.0, 2.0, 0.0};
  Scene scene = {pose,        0.8, map,  bench.terrain, bench.path,       bench.goal,
                 bench.front, 0.3, true, true,          bench.oscillation};
  DirectedPoint end = directed(pose);
  Rollout constant({0.5, 0.0}, scene, 1.0, 10);
  for (int i = 0; i < 10; ++i) constant.step(end);
  CHECK(end.at.x == Approx(1.5));
  // from rest at 1 m/s^2 in steps of 0.1 s: 0.1, 0.2, 0.3, 0.4, then 0.5 m/s
  const Ramp ramp = {{0.0, 0.0}, 1.0, 1.0};
  scene.ramp = &ramp;
  end = directed(pose);
  Rollout ramped({0.5, 0.0}, scene, 1.0, 10);
  for (int i = 0; i < 10; ++i) ramped.step(end);
  CHECK(end.at.x == Approx(1.0 + 0.1 * (0.1 + 0.2 + 0.3 + 0.4 + 6 * 0.5)));
  // and a turn: 0.1 + 0.2 + ... + 0.5 rad/s, then 0.5, each for 0.1 s
  end = directed(pose);
  Rollout turned({0.0, 0.5}, scene, 1.0, 10);
  for (int i = 0; i < 10; ++i) turned.step(end);
  CHECK(pose_of(end).theta == Approx(0.1 * (0.1 + 0.2 + 0.3 + 0.4 + 6 * 0.5)));
  CHECK(end.at.x == 1.0);
}

TEST_CASE("The sum of the critics, by hand") {
  Bench bench;
  bench.read();
  const CostmapView map(bench.c);
  std::vector<dmrp_vec2> path;
  for (int i = 0; i <= 40; ++i) path.push_back({2.025 + 0.05 * i, 3.025});  // 2 m to the east, to x = 4.025
  bench.spread(path, {4.325, 3.025});
  bench.tuning.forward_point_distance = 0.3;
  const dmrp_pose pose = {2.025, 3.025, 0.0};
  Scene scene = {pose,        0.8, map,  bench.terrain, bench.path,       bench.goal,
                 bench.front, 0.3, true, true,          bench.oscillation};
  FootprintCheck footprint(map, disc, 0.05, pose);
  const Tuning& t = bench.tuning;

  // 1.7 s at 0.5 m/s end at x = 2.875: 23 cells before the goal, the nose 23 before the front; on the path
  CHECK(score({0.5, 0.0}, scene, t, footprint, infinity) == Approx(0.05 * 0.8 * (23 + 23)));
  // turning in place by 1.57 rad: the nose 6 cells off the path to the left, 40 + 6 + 6 from the
  // front
  const double turn = 1.5707963267948966 / t.sim_time;
  CHECK(score({0.0, turn}, scene, t, footprint, infinity) == Approx(0.05 * (0.8 * (40 + 52) + 0.6 * 6)));
  scene.align = false;
  CHECK(score({0.0, turn}, scene, t, footprint, infinity) == Approx(0.05 * 0.8 * (40 + 52)));
  scene.follow = false;
  CHECK(score({0.5, 0.0}, scene, t, footprint, infinity) == Approx(0.05 * 0.8 * (23 + 23)));
  // stops above the best cost so far and returns at least that
  CHECK(score({0.0, turn}, scene, t, footprint, 1.0) > 1.0);
}

TEST_CASE("An arc into an obstacle is rejected, and a fast arc keeps a larger clearance") {
  Bench bench;
  for (double x = 0.0; x < 6.0; x += 0.05) bench.fake.mark(x + 0.01, 3.36);  // lethal centres at y = 3.375
  bench.read();
  const CostmapView map(bench.c);
  bench.spread({{3.025, 3.025}, {4.025, 3.025}}, {4.325, 3.025});
  const dmrp_pose pose = {2.025, 3.025, 0.0};  // 0.35 m from the wall's cells
  const Scene scene = {pose,        0.8, map,  bench.terrain, bench.path,       bench.goal,
                       bench.front, 0.3, true, true,          bench.oscillation};
  FootprintCheck footprint(map, disc, 0.05, pose);
  CHECK(score({0.5, 0.5}, scene, bench.tuning, footprint, infinity) == rejected);
  const double beside = score({0.5, 0.0}, scene, bench.tuning, footprint, infinity);
  CHECK(beside > bench.tuning.occdist_scale * map.cost({2.5, 3.025}));
  bench.tuning.max_scaling_factor = 0.4;  // 0.25 * 1.4 + 0.05 = 0.40 at full speed
  CHECK(score({0.2, 0.0}, scene, bench.tuning, footprint, infinity) != rejected);
  CHECK(score({0.8, 0.0}, scene, bench.tuning, footprint, infinity) == rejected);
}

TEST_CASE("The choice equals that of an exhaustive search over the samples") {
  dmrp::toolkit::Stream random(11, "choices");
  const dmrp_limits limits = dmrp::test::differential_limits(0.0, 0.8, 1.0, 1.0, 1.0);
  int choices = 0;
  int refusals = 0;
  for (int round = 0; round < 200; ++round) {
    Bench bench;
    const double crowd = random.uniform(0.0, 40.0);
    for (int i = 0; i < crowd; ++i) bench.fake.mark(random.uniform(1.0, 5.0), random.uniform(1.0, 5.0));
    bench.read();
    const CostmapView map(bench.c);
    std::vector<dmrp_vec2> path;
    const double slope = random.uniform(-1.0, 1.0);
    for (int i = 0; i < 40; ++i) path.push_back({3.0 + 0.05 * i, 3.0 + 0.05 * slope * i});
    bench.spread(path, {5.3, 3.0 + 2.3 * slope});
    const dmrp_pose pose = {3.0, 3.0, random.uniform(-3.0, 3.0)};
    if (round % 3 == 0) {
      bench.oscillation.record(pose, {0.0, 0.5});
      bench.oscillation.record(pose, {0.0, -0.5});
    }
    const Scene scene = {pose,        0.8, map,  bench.terrain, bench.path,       bench.goal,
                         bench.front, 0.3, true, true,          bench.oscillation};
    FootprintCheck footprint(map, disc, 0.05, pose);
    VelocityWindow window;
    window.sample(dmrp::Observation(moving(limits, random.uniform(0.0, 0.8), random.uniform(-1.0, 1.0))), 0.1, 0.8,
                  {3, 2, 20});

    double best = infinity;
    std::optional<Sample> expected;
    for (const double v : window.v) {
      for (const double omega : window.omega) {
        const double cost = score({v, omega}, scene, bench.tuning, footprint, infinity);
        if (cost == rejected || cost >= best) continue;
        best = cost;
        expected = Sample{v, omega};
      }
    }
    const std::optional<Sample> choice = cheapest(window, scene, bench.tuning, footprint);
    REQUIRE(choice.has_value() == expected.has_value());
    if (choice) {
      REQUIRE(choice->v == expected->v);
      REQUIRE(choice->omega == expected->omega);
      ++choices;
    } else {
      ++refusals;
    }
  }
  CHECK(choices > 50);
  CHECK(refusals > 5);
}

TEST_CASE("A path that weighs more than twice the goal stops the robot before a right angle") {
  // upstream's critics: past the corner, the nose loses path_distance_bias per metre and both goal critics together
  // win at most twice goal_distance_bias
  const dmrp_limits limits = dmrp::test::differential_limits(0.0, 0.8, 1.0, 1.0, 1.0);
  Bench bench;
  bench.read();
  const CostmapView map(bench.c);
  std::vector<dmrp_vec2> path;
  for (int i = 0; i <= 40; ++i) path.push_back({2.025 + 0.05 * i, 2.025});
  for (int i = 1; i <= 40; ++i) path.push_back({4.025, 2.025 + 0.05 * i});
  bench.spread(path, {4.025, 4.325});
  const dmrp_pose pose = {4.025 - bench.tuning.forward_point_distance - 0.05, 2.025, 0.0};
  const Scene scene = {pose,        0.8, map,  bench.terrain, bench.path,       bench.goal,
                       bench.front, 0.3, true, true,          bench.oscillation};
  FootprintCheck footprint(map, disc, 0.01, pose);
  VelocityWindow window;
  window.sample(dmrp::Observation(moving(limits, 0.0, 0.0)), 0.1, 0.8, {3, 2, 20});
  const auto moves = [&](double path_distance_bias, double goal_distance_bias) {
    bench.tuning.path_distance_bias = path_distance_bias;
    bench.tuning.goal_distance_bias = goal_distance_bias;
    const double standing = score({0.0, 0.0}, scene, bench.tuning, footprint, infinity);
    const std::optional<Sample> best = cheapest(window, scene, bench.tuning, footprint);
    return score(*best, scene, bench.tuning, footprint, infinity) < standing;
  };
  CHECK(moves(0.6, 0.8));        // the defaults
  CHECK_FALSE(moves(5.0, 0.8));  // the paper
  CHECK_FALSE(moves(5.0, 1.0));  // its released code
}

}  // namespace dwa_test
