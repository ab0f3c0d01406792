// SPDX-License-Identifier: MIT
// Homotopy classes: signatures, the roadmap, and the choice among bands.
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/segment.hpp>
#include <memory>
#include <set>

#include "controllers/teb/class_planner.hpp"
#include "tests/unit/controllers/robot_body.hpp"

namespace classes_test {

using namespace dmrp;
using namespace dmrp::controllers;
using namespace dmrp::controllers::teb;

// Owns shapes.
class Shapes {
 public:
  Shapes& add(const std::vector<Vec2>& vertices, double radius_m = 0.0, Vec2 velocity = {0.0, 0.0}) {
    kept_.push_back(std::make_unique<std::vector<Vec2>>(vertices));
    Obstacle obstacle;
    obstacle.vertices = kept_.back()->data();
    obstacle.vertex_count = static_cast<std::uint32_t>(vertices.size());
    obstacle.radius_m = radius_m;
    obstacle.velocity = velocity;
    Vec2 lower = vertices[0], upper = vertices[0];
    for (const Vec2 v : vertices) {
      lower = {std::min(lower.x, v.x), std::min(lower.y, v.y)};
      upper = {std::max(upper.x, v.x), std::max(upper.y, v.y)};
    }
    obstacle.center = 0.5 * (lower + upper);
    for (const Vec2 v : vertices) obstacle.reach_m = std::max(obstacle.reach_m, toolkit::distance(v, obstacle.center));
    obstacle.is_agent = radius_m > 0.0;
    obstacles_.push_back(obstacle);
    return *this;
  }
  const std::vector<Obstacle>& all() const { return obstacles_; }

 private:
  std::vector<std::unique_ptr<std::vector<Vec2>>> kept_;
  std::vector<Obstacle> obstacles_;
};

TimedElasticBand band_through(const std::vector<Vec2>& points, double dt_s = 0.5) {
  TimedElasticBand band;
  band.begin({points[0].x, points[0].y, 0.0});
  for (std::size_t i = 1; i < points.size(); ++i) band.append({points[i].x, points[i].y, 0.0}, dt_s);
  return band;
}

Signature signature_of(const std::vector<Vec2>& points, const Shapes& shapes, double dt_s = 0.5) {
  std::vector<Mark> marks;
  set_marks(shapes.all(), points.back() - points.front(), marks);
  return band_signature(band_through(points, dt_s), marks);
}

// The angle that a path sweeps as seen from a mark.
double swept_angle(const std::vector<Vec2>& points, Vec2 mark) {
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i)
    sum += toolkit::difference(toolkit::bearing(mark, points[i - 1]), toolkit::bearing(mark, points[i]));
  return sum;
}

struct Setting {
  dmrp_limits limits = dmrp::test::differential_limits(0.0, 0.8, 1.0, 1.0, 1.0);
  dmrp_footprint footprint = dmrp::test::disc_footprint(0.25);
  std::vector<Vec2> none;
  std::vector<Vec2> path;
  Parameters tuning;
  Setting() {
    tuning.min_obstacle_dist = 0.1;
    tuning.inflation_dist = 0.3;
    tuning.obstacle_association_cutoff_factor = 10.0;
    for (int i = 0; i <= 30; ++i) path.push_back({0.1 * i, 0.0});
  }
  Task task(const Shapes& shapes) {
    Task task;
    task.goal = {3.0, 0.0, 0.0};
    task.path = &path;
    task.scene = {&limits, &footprint, &shapes.all(), &none};
    return task;
  }
};

double lowest(const TimedElasticBand& band) {
  return *std::min_element(band.y.begin(), band.y.end());
}
double highest(const TimedElasticBand& band) {
  return *std::max_element(band.y.begin(), band.y.end());
}

TEST_CASE("TEB: a step crosses a ray from right to left, from left to right, or not") {
  const Vec2 ray = {1.0, 0.0};
  CHECK(ray_crossing({2.0, -1.0}, {2.0, 1.0}, ray) == 1);
  CHECK(ray_crossing({2.0, 1.0}, {2.0, -1.0}, ray) == -1);
  CHECK(ray_crossing({-2.0, -1.0}, {-2.0, 1.0}, ray) == 0);  // behind it
  CHECK(ray_crossing({1.0, 1.0}, {2.0, 3.0}, ray) == 0);
  CHECK(ray_crossing({-3.0, 1.0}, {1.0, -1.0}, ray) == 0);  // through the line at -1
  CHECK(ray_crossing({-1.0, 1.0}, {3.0, -1.0}, ray) == -1);
  // a point on the ray's line belongs to one side: a step to it and one beyond it are one crossing
  CHECK(ray_crossing({2.0, -1.0}, {2.0, 0.0}, ray) + ray_crossing({2.0, 0.0}, {2.0, 1.0}, ray) == 1);
}

TEST_CASE("TEB: paths that pass all obstacles on the same sides have the same signature") {
  Shapes post;
  post.add({{2.0, 0.1}});
  const Signature above = signature_of({{0.0, 0.0}, {2.0, 0.6}, {4.0, 0.0}}, post);
  const Signature far_above = signature_of({{0.0, 0.0}, {0.5, 2.0}, {1.7, 3.0}, {3.0, 2.0}, {4.0, 0.0}}, post);
  const Signature below = signature_of({{0.0, 0.0}, {2.0, -0.6}, {4.0, 0.0}}, post);
  CHECK(above == far_above);
  CHECK(above != below);

  Shapes wall;
  wall.add({{2.0, -1.0}, {2.0, 1.0}});
  const Signature left = signature_of({{0.0, 0.0}, {2.0, 1.5}, {4.0, 0.0}}, wall);
  const Signature right = signature_of({{0.0, 0.0}, {2.0, -1.5}, {4.0, 0.0}}, wall);
  const Signature through = signature_of({{0.0, 0.0}, {4.0, 0.0}}, wall);
  CHECK(left != right);
  CHECK(through != left);
  CHECK(through != right);
}

TEST_CASE("TEB: passing in front of a crossing person is another class than passing behind") {
  Shapes walker;
  walker.add({{2.0, -2.0}}, 0.3, {0.0, 1.0});
  // crosses y = 0 after 2 s
  const std::vector<Vec2> way = {{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}, {3.0, 0.0}, {4.0, 0.0}};
  const Signature quick = signature_of(way, walker, 0.4);  // there after 0.8 s
  const Signature quicker = signature_of(way, walker, 0.3);
  const Signature slow = signature_of(way, walker, 1.8);  // after 3.6 s
  CHECK(quick == quicker);
  CHECK(quick != slow);
}

TEST_CASE("TEB: signatures agree with winding angles on random paths") {
  toolkit::Stream random(5, "teb.signature");
  int same = 0;
  for (int round = 0; round < 400; ++round) {
    Shapes shapes;
    const int posts = 1 + static_cast<int>(random.below(3));
    std::vector<Vec2> at;
    for (int i = 0; i < posts; ++i) {
      at.push_back({random.uniform(0.5, 3.5), random.uniform(-1.0, 1.0)});
      shapes.add({at.back()});
    }
    const auto draw = [&] {
      std::vector<Vec2> points = {{0.0, 0.0}};
      for (int i = 0; i < 5; ++i) points.push_back({random.uniform(-1.0, 5.0), random.uniform(-1.5, 1.5)});
      points.push_back({4.0, 0.0});
      return points;
    };
    const std::vector<Vec2> a = draw();
    const std::vector<Vec2> b = draw();
    bool winds = false;
    for (const Vec2 post : at) winds = winds || std::abs(swept_angle(a, post) - swept_angle(b, post)) > 1.0;
    CHECK((signature_of(a, shapes) == signature_of(b, shapes)) == !winds);
    same += winds ? 0 : 1;
  }
  CHECK(same > 20);
  CHECK(same < 380);
}

TEST_CASE("TEB: the roadmap finds the shortest path of each class, the same for the same seed") {
  Shapes shapes;
  shapes.add({{2.0, 0.1}}, 0.3);
  std::vector<Mark> marks;
  set_marks(shapes.all(), {4.0, 0.0}, marks);
  const RoadmapQuery query = {{0.0, 0.0}, {4.0, 0.0}, 0.8, 0.2, &shapes.all(), &marks};
  const Parameters tuning;
  Roadmap roadmap;
  roadmap.reserve(tuning);
  std::vector<std::vector<Vec2>> first;
  for (int run = 0; run < 2; ++run) {
    toolkit::Stream random(7, "teb.roadmap");
    roadmap.search(query, tuning, random);
    REQUIRE(roadmap.size() >= 2);
    CHECK(roadmap.size() <= tuning.max_number_classes + 1);
    std::vector<std::vector<Vec2>> ways(roadmap.size());
    std::set<Signature> classes;
    double last_m = 0.0;
    for (std::size_t i = 0; i < roadmap.size(); ++i) {
      roadmap.path(i, ways[i]);
      std::vector<Vec2> whole = ways[i];
      whole.insert(whole.begin(), query.start);
      whole.push_back(query.goal);
      double length_m = 0.0;
      for (std::size_t k = 1; k < whole.size(); ++k) {
        length_m += toolkit::distance(whole[k - 1], whole[k]);
        CHECK(toolkit::distance(Segment{whole[k - 1], whole[k]}, Vec2{2.0, 0.1}) >= 0.5);
      }
      CHECK(length_m >= last_m);
      last_m = length_m;
      classes.insert(signature_of(whole, shapes));
    }
    CHECK(classes.size() == roadmap.size());
    if (run == 0) first = ways;
    for (std::size_t i = 0; i < ways.size(); ++i) CHECK(std::equal(ways[i].begin(), ways[i].end(), first[i].begin()));
  }
}

TEST_CASE("TEB: the roadmap finds a gap a little wider than the robot with any seed") {
  // a wall across a corridor of 3 m, a gap of 0.7 m at its left end
  Shapes shapes;
  shapes.add({{-1.0, 1.5}, {5.0, 1.5}}).add({{-1.0, -1.5}, {5.0, -1.5}}).add({{2.0, -1.5}, {2.0, 0.8}});
  std::vector<Mark> marks;
  set_marks(shapes.all(), {3.0, 0.0}, marks);
  const RoadmapQuery query = {{0.0, 0.0}, {3.2, 0.0}, 0.8, 0.2, &shapes.all(), &marks};
  const Parameters tuning;
  Roadmap roadmap;
  roadmap.reserve(tuning);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    toolkit::Stream random(seed, "teb.roadmap");
    roadmap.search(query, tuning, random);
    CAPTURE(seed);
    CHECK(roadmap.size() >= 1);
  }
}

TEST_CASE("TEB: a band for each side of an obstacle; the cheaper one is chosen, the other is kept") {
  Shapes shapes;
  shapes.add({{1.5, 0.15}}, 0.3);  // more room below
  Setting setting;
  ClassPlanner planner;
  planner.start(setting.tuning, 1);
  for (int cycle = 0; cycle < 5; ++cycle) planner.plan(setting.task(shapes));
  REQUIRE(planner.best());
  CHECK(lowest(*planner.best()) < -0.3);
  CHECK(highest(*planner.best()) < 0.1);
  REQUIRE(planner.size() >= 2);
  CHECK(planner.size() <= 5);
  planner.drop_best();
  REQUIRE(planner.best());
  CHECK(highest(*planner.best()) > 0.6);
  for (int i = 0; i < 5; ++i) planner.drop_best();
  CHECK_FALSE(planner.best());
  planner.plan(setting.task(shapes));
  CHECK(planner.best());
}

TEST_CASE("TEB: without homotopy classes there is one band") {
  Shapes shapes;
  shapes.add({{1.5, 0.15}}, 0.3);
  Setting setting;
  Parameters parameters = setting.tuning;
  parameters.enable_homotopy_class_planning = false;
  ClassPlanner planner;
  planner.start(parameters, 1);
  for (int cycle = 0; cycle < 3; ++cycle) planner.plan(setting.task(shapes));
  CHECK(planner.size() == 1);
  CHECK(lowest(*planner.best()) < -0.3);
}

TEST_CASE("TEB: hysteresis and the blocking period keep the last choice") {
  Setting setting;
  Shapes higher;  // more room below
  higher.add({{1.5, 0.05}}, 0.3);
  Shapes lower;  // more room above
  lower.add({{1.5, -0.05}}, 0.3);
  // whether the chosen band passes below, after each of: higher, lower, higher
  const auto sides = [&](double hysteresis, double blocking_s) {
    Parameters parameters = setting.tuning;
    parameters.selection_cost_hysteresis = hysteresis;
    parameters.selection_prefer_initial_plan = 1.0;
    parameters.switching_blocking_period = blocking_s;
    ClassPlanner planner;
    planner.start(parameters, 1);
    std::vector<bool> below;
    std::int64_t t_ns = 0;
    for (const Shapes* shapes : {&higher, &lower, &higher}) {
      for (int cycle = 0; cycle < 5; ++cycle, t_ns += 100'000'000) {
        Task task = setting.task(*shapes);
        task.t_ns = t_ns;
        planner.plan(task);
      }
      below.push_back(lowest(*planner.best()) < -0.3);
    }
    return below;
  };
  CHECK(sides(1.0, 0.0) == std::vector<bool>{true, false, true});
  const std::vector<bool> kept = sides(0.5, 0.0);
  CHECK(kept == std::vector<bool>(3, kept[0]));
  const std::vector<bool> blocked = sides(1.0, 60.0);
  CHECK(blocked[1] == blocked[2]);
}

TEST_CASE("TEB: a goal that jumps restarts the bands, a goal that moves slowly keeps them") {
  Shapes shapes;
  shapes.add({{1.5, 0.15}}, 0.3);
  Setting setting;
  Parameters parameters = setting.tuning;
  parameters.enable_homotopy_class_planning = false;
  ClassPlanner planner;
  planner.start(parameters, 1);
  Task task = setting.task(shapes);
  for (int cycle = 0; cycle < 3; ++cycle) planner.plan(task);
  const double kept = lowest(*planner.best());
  task.goal.x += 0.1;
  planner.plan(task);
  CHECK(lowest(*planner.best()) == Approx(kept).margin(0.1));
  task.goal = {0.0, 3.0, 0.5 * toolkit::pi};
  const std::vector<Vec2> path = {{0.0, 0.0}, {0.0, 1.0}, {0.0, 2.0}, {0.0, 3.0}};
  task.path = &path;
  planner.plan(task);
  CHECK(highest(*planner.best()) == 3.0);
  CHECK(std::abs(*std::max_element(planner.best()->x.begin(), planner.best()->x.end())) < 0.5);
}

TEST_CASE("TEB: in recovery a robot that faces away turns in the preferred direction") {
  Shapes shapes;
  Setting setting;
  ClassPlanner planner;
  for (const Turn turn : {Turn::left, Turn::right}) {
    planner.start(setting.tuning, 1);
    Task task = setting.task(shapes);
    task.start.theta = turn == Turn::left ? -3.0 : 3.0;  // the other way would be shorter
    task.scene.preferred_turn = turn;
    planner.plan(task);
    REQUIRE(planner.best());
    const double turned = toolkit::difference(planner.best()->theta[0], planner.best()->theta[1]);
    CHECK((turn == Turn::left ? turned : -turned) > 0.0);
  }
}

}  // namespace classes_test
