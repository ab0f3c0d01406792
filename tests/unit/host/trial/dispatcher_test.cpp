// SPDX-License-Identifier: MIT
// Dispatch by waypoint, replanning, ordered execution and local routes in whole trials. The plugins (dispatch_plugins.cpp) check their
// inputs; the planner of the crowded halls is a real one.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/cpp/path.hpp>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/trace/trace_reader.hpp"
#include "host/trial/run_trial.hpp"
#include "tests/support/draws.hpp"
#include "tests/unit/core/trace/trace_in_memory.hpp"

namespace dispatcher_test {

using namespace dmrp::host;
namespace core = dmrp::core;
namespace test = dmrp::test;
namespace toolkit = dmrp::toolkit;

constexpr double any_heading = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t second_ns = 1'000'000'000;

// Robots on separate lanes along x, from x = 1.5 to the given goals.
core::Scenario lanes(const std::vector<double>& goals) {
  core::Scenario scenario;
  scenario.name = "lanes";
  scenario.upper = {12.0, 2.0 + 2.0 * static_cast<double>(goals.size())};
  scenario.time_limit_s = 60.0;
  for (std::size_t i = 0; i < goals.size(); ++i) {
    const double y = 1.5 + 2.0 * static_cast<double>(i);
    scenario.robots.push_back({"r" + std::to_string(i), {1.5, y, 0.0}, {{goals[i], y, any_heading}}});
  }
  return scenario;
}

struct Stage {
  explicit Stage(const core::Scenario& scenario) {
    add_library(DMRP_DISPATCH_PLUGINS);
    experiment.global_planners = {use("test.planner.again")};
    experiment.local_controllers = {use("test.controller.follower")};
    experiment.scenarios = {{scenario, scenario.name, ""}};
    experiment.simulation.tracking = core::Tracking::none;
    experiment.annotations = true;
  }

  void add_library(const std::string& file) { experiment.libraries.push_back({file, file, Library(file).plugins()}); }

  PluginUse use(const std::string& id) const {
    for (std::uint32_t i = 0; i < experiment.libraries.size(); ++i)
      for (const PluginInfo& info : experiment.libraries[i].plugins) {
        if (info.id != id) continue;
        PluginUse made = {i, info, id, {}};
        for (const ParameterSpec& spec : info.parameters) made.parameters.push_back(spec.fallback);
        return made;
      }
    throw std::runtime_error("no plugin " + id);
  }

  static void set(PluginUse& use, const std::string& key) {
    for (ParameterValue& value : use.parameters)
      if (value.key == key) value.integer = 1;
  }

  bool run(std::uint64_t seed = 1) {
    CallNote note{};
    CallGuard guard{note};
    const VariantWorld variant(experiment, experiment.scenarios[0]);
    Guests guests = Guests::local(experiment.libraries, note, guard, [](auto, const auto&, const auto&) {});
    trace = std::make_unique<test::TraceInMemory>(variant.view.world());
    const TrialEnding ending = run_trial({experiment, {}, variant, seed}, guests, **trace);
    reader = std::make_unique<core::TraceReader>(trace->bytes());
    return ending.succeeded;
  }

  // The notes that controllers wrote about their paths.
  std::vector<std::string> notes() const {
    std::vector<std::string> texts;
    for (const core::TraceNote& note : reader->notes()) texts.emplace_back(note.text);
    return texts;
  }

  // The times of the calls of plan().
  std::vector<double> plan_times_s() const {
    std::vector<double> times;
    for (const core::TracePlan& made : reader->plans()) times.push_back(1e-9 * static_cast<double>(made.made_at_ns));
    return times;
  }

  Experiment experiment;
  std::unique_ptr<test::TraceInMemory> trace;
  std::unique_ptr<core::TraceReader> reader;
};

dmrp_robot_sample robot_of(const dmrp_sample& sample, std::size_t robot) {
  return *DMRP_AT(dmrp_robot_sample, sample.robots, sample.robot_stride, robot);
}

TEST_CASE("a controller gets a full path once") {
  Stage stage(lanes({4.8}));
  CHECK(stage.run());
  // three moves, two waits, and a leg from the last cell's centre to the goal
  CHECK(stage.notes() == std::vector<std::string>{"7 to 4.800000"});
}

TEST_CASE("a controller gets waypoints one at a time, without waits, and does not stop in between") {
  Stage stage(lanes({4.8}));
  stage.experiment.simulation.dispatch = core::Dispatch::waypoint;
  Stage::set(stage.experiment.local_controllers[0], "by_waypoint");
  CHECK(stage.run());
  CHECK(stage.notes() == std::vector<std::string>{"1 to 2.500000", "1 to 3.500000", "1 to 4.500000", "1 to 4.800000"});

  const auto& sent = stage.reader->notes();
  REQUIRE(sent.size() == 4);
  std::size_t next = 1;
  double progress_m = 0.0;
  while (const dmrp_sample* sample = stage.reader->next_sample()) {
    const dmrp_robot_sample robot = robot_of(*sample, 0);
    CHECK(robot.progress_m >= progress_m);  // along the whole path
    progress_m = robot.progress_m;
    if (next >= sent.size() || sample->t_ns != sent[next].t_ns) continue;
    const double waypoint_x = 1.5 + static_cast<double>(next);
    CHECK(robot.pose.x == Approx(waypoint_x - 0.2).margin(0.07));  // a control period late at most
    CHECK(robot.velocity.v_x > 0.1);
    ++next;
  }
  CHECK(next == 4);
  CHECK(progress_m == Approx(3.3).margin(0.2));
}

TEST_CASE("in lockstep robots get their next waypoints together, when all are at theirs") {
  Stage stage(lanes({4.5, 7.5, 3.5}));
  stage.experiment.simulation.dispatch = core::Dispatch::lockstep;
  Stage::set(stage.experiment.local_controllers[0], "by_waypoint");
  if (GENERATE(false, true)) Stage::set(stage.experiment.local_controllers[0], "dawdles");
  CHECK(stage.run());
  std::map<std::int64_t, std::vector<std::uint32_t>> sent;  // robots by time
  for (const core::TraceNote& note : stage.reader->notes()) sent[note.t_ns].push_back(note.source.robot);
  // three moves, six, and two; all wait for two steps at the beginning, which takes no time
  REQUIRE(sent.size() == 6);
  std::size_t step = 0;
  for (const auto& [t_ns, robots] : sent) {
    CHECK(robots.size() == (step < 2 ? 3u : step == 2 ? 2u : 1u));
    ++step;
  }
  while (const dmrp_sample* sample = stage.reader->next_sample()) {
    const auto next = sent.lower_bound(sample->t_ns);
    if (next == sent.end() || next->first != sample->t_ns || next == sent.begin()) continue;
    const auto moves = std::distance(sent.begin(), next);
    for (const std::uint32_t robot : next->second)
      CHECK(robot_of(*sample, robot).pose.x == Approx(1.5 + static_cast<double>(moves)).margin(0.2));
  }
}

TEST_CASE("on a tour a robot arrives at each goal before it gets the next waypoint") {
  Stage stage(lanes({4.8}));
  stage.experiment.scenarios[0].scenario.robots[0].goals.push_back({2.5, 1.5, any_heading});
  stage.add_library(DMRP_PLUGIN_DIR "/libdmrp_planners.so");
  stage.experiment.global_planners = {stage.use("dmrp.planner.cbs")};
  stage.experiment.simulation.dispatch = core::Dispatch::waypoint;
  stage.experiment.simulation.execution = GENERATE(core::Execution::free, core::Execution::ordered);
  Stage::set(stage.experiment.local_controllers[0], "by_waypoint");
  CHECK(stage.run());
  // out to the goal beside its cell's centre, back to the centre and on
  CHECK(stage.notes() == std::vector<std::string>{"1 to 2.500000", "1 to 3.500000", "1 to 4.500000", "1 to 4.800000",
                                                  "1 to 4.500000", "1 to 3.500000", "1 to 2.500000"});
  const auto& sent = stage.reader->notes();
  REQUIRE(sent.size() == 7);
  while (const dmrp_sample* sample = stage.reader->next_sample())
    if (sample->t_ns < sent[4].t_ns - second_ns / 10) CHECK(robot_of(*sample, 0).goal_index == 0);
}

TEST_CASE("a controller gets every new plan with the next revision, and robots arrive") {
  Stage stage(lanes({9.5, 2.5}));
  stage.experiment.simulation.replan.period_ns = 2 * second_ns;
  const auto dispatch = GENERATE(core::Dispatch::full_path, core::Dispatch::waypoint);
  stage.experiment.simulation.dispatch = dispatch;
  if (dispatch == core::Dispatch::waypoint) Stage::set(stage.experiment.local_controllers[0], "by_waypoint");
  CHECK(stage.run());
  const auto& plans = stage.reader->plans();
  REQUIRE(plans.size() > 5);
  for (std::size_t i = 0; i < plans.size(); ++i) {
    CHECK(plans[i].plan.revision == i + 1);
    CHECK(plans[i].made_at_ns == static_cast<std::int64_t>(i) * 2 * second_ns);
    CHECK(plans[i].plan.from_ns == plans[i].made_at_ns);
    CHECK(plans[i].plan.path_count == 2);
  }
  while (const dmrp_sample* sample = stage.reader->next_sample()) {
    // the state at the tick of a plan is recorded before the plan
    const auto asked = static_cast<std::uint64_t>(std::max<std::int64_t>(0, sample->t_ns - 1) / (2 * second_ns));
    CHECK(sample->plan->revision == asked + 1);
  }
  // the second robot has arrived by then: it rests in its cell
  const dmrp_path& rest = *DMRP_AT(dmrp_path, plans.back().plan.paths, plans.back().plan.path_stride, 1);
  CHECK(rest.count == 1);
  CHECK(rest.waypoints->x == 2.5);
  // the plan of the first robot starts in the cell that it drives to
  double x = 0.0;
  for (const core::TracePlan& made : plans) {
    CHECK(made.plan.paths->waypoints->x >= x);
    x = made.plan.paths->waypoints->x;
  }
}

TEST_CASE("a plan that is made on the way does not send a robot back to its cell's centre") {
  Stage stage(lanes({9.5}));
  stage.experiment.simulation.replan.period_ns = second_ns;
  stage.experiment.simulation.dispatch = core::Dispatch::waypoint;
  Stage::set(stage.experiment.local_controllers[0], "by_waypoint");
  CHECK(stage.run());
  CHECK(stage.reader->plans().size() > 5);
  const std::vector<std::string> notes = stage.notes();  // all of one length
  CHECK(std::is_sorted(notes.begin(), notes.end()));
}

TEST_CASE("plans avoid a failed robot") {
  Stage stage(lanes({11.5, 11.5}));
  stage.experiment.simulation.replan.period_ns = 2 * second_ns;
  Stage::set(stage.experiment.local_controllers[0], "gives_up");
  CHECK_FALSE(stage.run());
  std::vector<double> xs;  // of the only cell of the failed robot, by plan
  for (const core::TracePlan& made : stage.reader->plans()) {
    const dmrp_path& path = *DMRP_AT(dmrp_path, made.plan.paths, made.plan.path_stride, 1);
    if (path.count == 1) xs.push_back(path.waypoints->x);
  }
  REQUIRE(xs.size() > 2);
  CHECK(std::all_of(xs.begin(), xs.end(), [](double x) { return x == 3.5; }));
}

TEST_CASE("a plan that fails leaves the old one in force") {
  Stage stage(lanes({9.5}));
  stage.experiment.simulation.replan.period_ns = 3 * second_ns;
  Stage::set(stage.experiment.global_planners[0], "once");
  CHECK(stage.run());
  CHECK(stage.notes().size() == 1);
  const auto& plans = stage.reader->plans();
  REQUIRE(plans.size() > 3);
  for (std::size_t i = 1; i < plans.size(); ++i) {
    CHECK(plans[i].plan.path_count == 0);
    CHECK(plans[i].plan.status == DMRP_NO_SOLUTION);
    CHECK(plans[i].plan.revision == 2);
  }
  while (const dmrp_sample* sample = stage.reader->next_sample()) REQUIRE(sample->plan->revision == 1);
}

TEST_CASE("a plan takes effect after its latency: robots wait for the first, and keep the old one until the next") {
  Stage stage(lanes({9.5}));
  stage.experiment.simulation.replan.period_ns = 3 * second_ns;
  stage.experiment.simulation.planning_latency_ns = 1'500'000'000;
  CHECK(stage.run());
  const auto& plans = stage.reader->plans();
  REQUIRE(plans.size() > 3);
  for (std::size_t i = 0; i < plans.size(); ++i) {
    CHECK(plans[i].made_at_ns == static_cast<std::int64_t>(i) * 3 * second_ns);
    CHECK(plans[i].plan.from_ns == plans[i].made_at_ns + 1'500'000'000);
    CHECK(plans[i].plan.paths->waypoints->t_ns == plans[i].plan.from_ns);
    CHECK(plans[i].plan.revision == i + 1);
  }
  while (const dmrp_sample* sample = stage.reader->next_sample()) {
    // the state of a control tick is recorded before the plan takes effect
    const std::int64_t in_force = (sample->t_ns - 1 + 1'500'000'000) / (3 * second_ns);
    if (sample->t_ns <= 1'500'000'000) {
      CHECK(sample->plan == nullptr);
      CHECK(robot_of(*sample, 0).pose.x == 1.5);
    } else {
      REQUIRE(sample->plan != nullptr);
      CHECK(sample->plan->revision == static_cast<std::uint64_t>(in_force));
    }
  }
}

TEST_CASE("a plan that takes effect later begins where the robot will be, also behind a corner") {
  core::Scenario corridor = lanes({7.5});
  corridor.upper = {8.0, 8.0};
  corridor.time_limit_s = 90.0;
  corridor.shapes.push_back({"block", core::Shape::Kind::polygon, {}, 0.0, {{0, 1}, {7, 1}, {7, 8}, {0, 8}}, 2.0});
  corridor.robots[0] = {"r0", {0.5, 0.5, 0.0}, {{7.5, 7.5, any_heading}}};
  Stage stage(corridor);
  stage.add_library(DMRP_PLUGIN_DIR "/libdmrp_planners.so");
  stage.experiment.global_planners = {stage.use("dmrp.planner.cbs")};
  stage.experiment.simulation.replan.period_ns = 8 * second_ns;
  stage.experiment.simulation.planning_latency_ns = 6 * second_ns;
  CHECK(stage.run());
  const auto& plans = stage.reader->plans();
  REQUIRE(plans.size() >= 3);
  std::size_t next = 1;
  bool round_corner = false;
  dmrp_vec2 asked_at{};
  while (const dmrp_sample* sample = stage.reader->next_sample()) {
    if (next == plans.size()) break;
    const dmrp_vec2 position = toolkit::position(robot_of(*sample, 0).pose);
    if (sample->t_ns == plans[next].made_at_ns) asked_at = position;
    if (sample->t_ns < plans[next].plan.from_ns) continue;
    const dmrp_vec2 first = toolkit::position(plans[next].plan.paths->waypoints[0]);
    CHECK(toolkit::distance(first, position) < 1.5);
    if (asked_at.x < 6.5 && first.y > 1.0) round_corner = true;
    ++next;
  }
  CHECK(round_corner);
}

TEST_CASE("a robot that strays is planned anew from where it is") {
  Stage stage(lanes({10.5}));
  stage.experiment.scenarios[0].scenario.upper.y = 8.0;
  stage.experiment.simulation.replan.stray_m = 0.4;
  Stage::set(stage.experiment.local_controllers[0], "strays");
  stage.run();
  const std::vector<double> times = stage.plan_times_s();
  REQUIRE(times.size() >= 2);
  double off_lane_m = 0.0;
  while (const dmrp_sample* sample = stage.reader->next_sample()) {
    const dmrp_robot_sample robot = robot_of(*sample, 0);
    if (1e-9 * static_cast<double>(sample->t_ns) <= times[1] + 1e-6) off_lane_m = robot.pose.y - 1.5;
  }
  CHECK(times[1] > 3.0);
  CHECK(off_lane_m > 0.4);
  CHECK(off_lane_m < 0.5);
  CHECK(stage.notes().size() == times.size());
  for (std::size_t i = 1; i < times.size(); ++i) CHECK(times[i] - times[i - 1] > 1.99);
}

// A hall of 14 x 14 cells with pillars, and 20 robots from random cells to random cells.
core::Scenario crowded_hall(std::uint64_t seed) {
  toolkit::Stream random(seed, "crowded_hall");
  core::Scenario scenario;
  scenario.name = "crowded hall";
  scenario.upper = {14.0, 14.0};
  scenario.time_limit_s = 600.0;
  std::vector<dmrp_vec2> cells;
  for (int row = 0; row < 14; ++row)
    for (int column = 0; column < 14; ++column) {
      const dmrp_vec2 center = {column + 0.5, row + 0.5};
      if (column % 4 == 2 && row % 4 == 2) {
        scenario.shapes.push_back({"pillar", core::Shape::Kind::circle, center, 0.3, {}, 2.0});
      } else {
        cells.push_back(center);
      }
    }
  const auto draw = [&](std::vector<dmrp_vec2> from) {
    std::vector<dmrp_vec2> drawn;
    while (drawn.size() < 20) {
      const auto at = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(from.size())));
      drawn.push_back(from[at]);
      from.erase(from.begin() + static_cast<std::ptrdiff_t>(at));
    }
    return drawn;
  };
  const std::vector<dmrp_vec2> starts = draw(cells);
  const std::vector<dmrp_vec2> goals = draw(cells);
  for (std::size_t i = 0; i < starts.size(); ++i)
    scenario.robots.push_back(
        {"r" + std::to_string(i), {starts[i].x, starts[i].y, any_heading}, {{goals[i].x, goals[i].y, any_heading}}});
  return scenario;
}

// A robot's passage through a cell of its plan.
struct Passage {
  std::size_t robot;
  std::int64_t planned_ns;
  std::int64_t enters_ns;
  std::int64_t leaves_ns;
};

// The passages of all cells, in the plan's order; times of centres on the first plan's cells, as recorded.
std::vector<std::vector<Passage>> passages(core::TraceReader& trace) {
  const toolkit::GridView grid(*trace.world().planning_grid);
  const dmrp_plan& plan = *trace.first_plan();
  struct Course {
    std::vector<std::uint32_t> cells;
    std::vector<std::int64_t> planned_ns;
    std::size_t at = 0;
  };
  std::vector<Course> courses(plan.path_count);
  std::vector<std::vector<Passage>> of_cell(grid.size());
  for (std::size_t i = 0; i < courses.size(); ++i) {
    const dmrp_path& path = *DMRP_AT(dmrp_path, plan.paths, plan.path_stride, i);
    for (std::uint32_t k = 0; k < path.count; ++k) {
      const dmrp_waypoint& waypoint = *DMRP_AT(dmrp_waypoint, path.waypoints, path.stride, k);
      const std::uint32_t cell = grid.index_of(toolkit::position(waypoint));
      if (k > 0 && cell == courses[i].cells.back()) continue;
      courses[i].cells.push_back(cell);
      courses[i].planned_ns.push_back(waypoint.t_ns);
    }
    of_cell[courses[i].cells[0]].push_back({i, 0, 0, std::numeric_limits<std::int64_t>::max()});
  }
  trace.rewind();
  while (const dmrp_sample* sample = trace.next_sample())
    for (std::size_t i = 0; i < courses.size(); ++i) {
      Course& course = courses[i];
      if (course.at + 1 == course.cells.size()) continue;
      if (grid.index_of(toolkit::position(robot_of(*sample, i).pose)) != course.cells[course.at + 1]) continue;
      for (Passage& passage : of_cell[course.cells[course.at]])
        if (passage.robot == i && passage.planned_ns == course.planned_ns[course.at]) passage.leaves_ns = sample->t_ns;
      ++course.at;
      of_cell[course.cells[course.at]].push_back(
          {i, course.planned_ns[course.at], sample->t_ns, std::numeric_limits<std::int64_t>::max()});
    }
  for (auto& cell : of_cell)
    std::sort(cell.begin(), cell.end(), [](const Passage& a, const Passage& b) { return a.planned_ns < b.planned_ns; });
  return of_cell;
}

template <class Use>
void for_each_route(core::TraceReader& trace, Use&& use) {
  trace.rewind();
  while (const dmrp_sample* sample = trace.next_sample())
    for (std::uint32_t i = 0; i < sample->route_count; ++i)
      use(*DMRP_AT(dmrp_route, sample->routes, sample->route_stride, i), sample->t_ns);
}

std::uint32_t robot_contacts(core::TraceReader& trace) {
  std::uint32_t contacts = 0;
  trace.rewind();
  while (const dmrp_sample* sample = trace.next_sample())
    for (std::uint32_t i = 0; i < sample->contact_count; ++i)
      contacts += DMRP_AT(dmrp_contact, sample->contacts, sample->contact_stride, i)->kind == DMRP_CONTACT_ROBOT;
  return contacts;
}

bool ends_at_goal(const dmrp::Path& path, const core::TraceReader& trace, std::uint32_t robot) {
  const dmrp_robot& body = *DMRP_AT(dmrp_robot, trace.world().robots, trace.world().robot_stride, robot);
  const dmrp_goal& last = *DMRP_AT(dmrp_goal, body.goals, body.goal_stride, body.goal_count - 1);
  return toolkit::position(path[path.size() - 1]) == toolkit::position(last.pose);
}

// Whether every other robot that passes a cell of the path before this one has left it by then.
bool is_clear(const dmrp::Path& path, std::uint32_t robot, std::int64_t t_ns,
              const std::vector<std::vector<Passage>>& of_cell, const core::TraceReader& trace) {
  const toolkit::GridView grid(*trace.world().planning_grid);
  for (const dmrp::Waypoint& waypoint : path)
    for (const Passage& passage : of_cell[grid.index_of(toolkit::position(waypoint))])
      if (passage.robot != robot && passage.planned_ns < waypoint.t_ns && passage.leaves_ns > t_ns) return false;
  return true;
}

// The number of pairs of robots that visit a cell in another order than planned.
std::size_t out_of_order(core::TraceReader& trace, std::size_t& pairs) {
  std::size_t wrong = 0;
  for (const auto& cell : passages(trace))
    for (std::size_t k = 1; k < cell.size(); ++k) {
      if (cell[k].robot == cell[k - 1].robot) continue;
      ++pairs;
      if (cell[k].enters_ns < cell[k - 1].leaves_ns) ++wrong;
    }
  return wrong;
}

TEST_CASE("execution in order: robots that dawdle pass shared cells as planned, and none waits for ever") {
  const auto dispatch = GENERATE(core::Dispatch::full_path, core::Dispatch::waypoint);
  const std::uint64_t seeds = dispatch == core::Dispatch::full_path ? 100 : 10;
  std::size_t pairs = 0;
  std::size_t out_of_order_when_free = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    Stage stage(crowded_hall(seed));
    stage.add_library(DMRP_PLUGIN_DIR "/libdmrp_planners.so");
    stage.experiment.global_planners = {stage.use("dmrp.planner.ecbs")};
    stage.experiment.simulation.dispatch = dispatch;
    stage.experiment.simulation.execution = core::Execution::ordered;
    Stage::set(stage.experiment.local_controllers[0], "dawdles");
    INFO("seed " << seed);
    REQUIRE(stage.run(seed));
    CHECK(out_of_order(*stage.reader, pairs) == 0);
    if (seed >= 5) continue;
    std::size_t free_pairs = 0;
    stage.experiment.simulation.execution = core::Execution::free;
    stage.run(seed);
    out_of_order_when_free += out_of_order(*stage.reader, free_pairs);
  }
  CHECK(pairs > 20 * seeds);
  CHECK(out_of_order_when_free > 0);  // free execution does not keep the order
}

TEST_CASE("in order, paths end before cells that others have still to leave") {
  std::size_t partial = 0, whole = 0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    Stage stage(crowded_hall(seed));
    stage.add_library(DMRP_PLUGIN_DIR "/libdmrp_planners.so");
    stage.experiment.global_planners = {stage.use("dmrp.planner.ecbs")};
    stage.experiment.simulation.execution = core::Execution::ordered;
    Stage::set(stage.experiment.local_controllers[0], "dawdles");
    INFO("seed " << seed);
    REQUIRE(stage.run(seed));
    const auto of_cell = passages(*stage.reader);
    struct Handed {
      std::size_t waypoints = 0;
      bool is_whole = false;
    };
    std::vector<Handed> handed(20);
    for_each_route(*stage.reader, [&](const dmrp_route& route, std::int64_t t_ns) {
      const dmrp::Path path(*route.path, route.flags);
      Handed& before = handed[route.robot];
      CHECK(path.continues() == (before.waypoints > 0));
      CHECK((path.size() > before.waypoints && !before.is_whole));  // there was more to come
      before = {path.size(), !path.is_partial()};
      CHECK(is_clear(path, route.robot, t_ns, of_cell, *stage.reader));
      if (!path.is_partial()) CHECK(ends_at_goal(path, *stage.reader, route.robot));
      ++(path.is_partial() ? partial : whole);
    });
  }
  CHECK(partial > 100);
  CHECK(whole == 5 * 20);
}

TEST_CASE("on a tour paths end at each goal, and the next one continues") {
  Stage stage(lanes({4.5}));
  stage.experiment.scenarios[0].scenario.robots[0].goals.push_back({8.5, 1.5, any_heading});
  stage.experiment.scenarios[0].scenario.robots[0].goals.push_back({6.5, 1.5, any_heading});
  stage.add_library(DMRP_PLUGIN_DIR "/libdmrp_planners.so");
  stage.experiment.global_planners = {stage.use("dmrp.planner.cbs")};
  stage.experiment.simulation.execution = GENERATE(core::Execution::free, core::Execution::ordered);
  CHECK(stage.run());
  std::vector<double> ends;
  for_each_route(*stage.reader, [&](const dmrp_route& route, std::int64_t) {
    const dmrp::Path path(*route.path, route.flags);
    CHECK(path.continues() == !ends.empty());
    CHECK_FALSE(path.is_partial());
    CHECK(path[path.size() - 1].goal_index == ends.size());
    ends.push_back(path[path.size() - 1].x);
  });
  CHECK(ends == std::vector<double>{4.5, 8.5, 6.5});
}

TEST_CASE("in order, robots that know their paths and poses alone never touch") {
  const std::uint64_t seeds = test::draws(100);
  std::uint32_t contacts_when_free = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    Stage stage(crowded_hall(seed));
    stage.add_library(DMRP_PLUGIN_DIR "/libdmrp_planners.so");
    stage.experiment.global_planners = {stage.use("dmrp.planner.ecbs")};
    stage.experiment.local_controllers = {stage.use("test.controller.naive")};
    stage.experiment.simulation.execution = core::Execution::ordered;
    INFO("seed " << seed);
    CHECK(stage.run(seed));
    CHECK(robot_contacts(*stage.reader) == 0);
    if (seed >= 5) continue;
    stage.experiment.simulation.execution = core::Execution::free;
    stage.run(seed);
    contacts_when_free += robot_contacts(*stage.reader);
  }
  CHECK(contacts_when_free > 0);
}

TEST_CASE("in order, plans that push robots out of their cells and back are driven to their ends") {
  const std::string planner = GENERATE("dmrp.planner.pibt", "dmrp.planner.lacam");
  std::uint32_t visits = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Stage stage(crowded_hall(seed));
    stage.add_library(DMRP_PLUGIN_DIR "/libdmrp_planners.so");
    stage.experiment.global_planners = {stage.use(planner)};
    stage.experiment.simulation.execution = core::Execution::ordered;
    CAPTURE(planner, seed);
    CHECK(stage.run(seed));
    const dmrp_trial_end& end = *stage.reader->end();
    for (std::uint32_t i = 0; i < end.robot_count; ++i)
      visits += DMRP_AT(dmrp_robot_end, end.robots, end.robot_stride, i)->visits;
  }
  CHECK(visits > 20 * 20);  // some leave their goals to give way, and come back
}

TEST_CASE("a robot that gives way at its goal is not parked in another's way") {
  core::Scenario pocket = lanes({5.5});
  pocket.upper = {12.0, 3.0};
  pocket.time_limit_s = 120.0;
  for (const auto& [lower, upper] :
       {std::pair<dmrp_vec2, dmrp_vec2>{{0.0, 0.0}, {12.0, 1.0}}, {{0.0, 2.0}, {5.0, 3.0}}, {{6.0, 2.0}, {12.0, 3.0}}})
    pocket.shapes.push_back(
        {"wall", core::Shape::Kind::polygon, {}, 0.0, {lower, {upper.x, lower.y}, upper, {lower.x, upper.y}}, 2.0});
  pocket.robots[0].start.x = 2.5;
  pocket.robots.push_back({"r1", {10.5, 1.5, any_heading}, {{0.5, 1.5, any_heading}}});
  Stage stage(pocket);
  stage.add_library(DMRP_PLUGIN_DIR "/libdmrp_planners.so");
  stage.experiment.global_planners = {stage.use("dmrp.planner.cbs")};
  stage.experiment.simulation.execution = GENERATE(core::Execution::free, core::Execution::ordered);
  CHECK(stage.run());
  const dmrp_trial_end& end = *stage.reader->end();
  CHECK(end.ending == DMRP_ENDING_ARRIVED);
  CHECK(DMRP_AT(dmrp_robot_end, end.robots, end.robot_stride, 0)->visits == 2);
}

TEST_CASE("a path is led around a robot that stands on it") {
  core::Scenario scenario = lanes({10.5});
  scenario.upper.y = 4.0;
  scenario.robots.push_back({"stands", {6.0, 1.5, 0.0}, {{6.0, 1.5, any_heading}}});
  Stage stage(scenario);
  stage.add_library(DMRP_PLUGIN_DIR "/libdmrp_planners.so");
  stage.experiment.global_planners = {stage.use("dmrp.planner.individual")};
  CHECK_FALSE(stage.run());

  stage.experiment.simulation.navigation.route = core::LocalRoute::around;
  CHECK(stage.run());
  std::uint32_t contacts = 0, led = 0;
  double beside_m = 0.0;
  while (const dmrp_sample* sample = stage.reader->next_sample()) {
    contacts += sample->contact_count;
    for (std::uint32_t i = 0; i < sample->event_count; ++i) led += sample->events[i].kind == DMRP_ROBOT_EVENT_ROUTE;
    beside_m = std::max(beside_m, std::abs(robot_of(*sample, 0).pose.y - 1.5));
  }
  CHECK(contacts == 0);
  CHECK(led > 0);
  CHECK(led < 10);  // a way past something is kept
  CHECK(beside_m < 1.0);
}

TEST_CASE("two robots that come toward each other both keep right") {
  core::Scenario scenario = lanes({10.5});
  scenario.upper.y = 4.0;
  scenario.robots[0].start.y = scenario.robots[0].goals[0].y = 2.0;
  scenario.robots.push_back({"back", {10.5, 2.0, dmrp::toolkit::pi}, {{1.5, 2.0, any_heading}}});
  Stage stage(scenario);
  stage.add_library(DMRP_PLUGIN_DIR "/libdmrp_planners.so");
  stage.experiment.global_planners = {stage.use("dmrp.planner.individual")};
  stage.experiment.simulation.tracking = core::Tracking::visible;
  stage.experiment.simulation.navigation.route = core::LocalRoute::around;
  CHECK(stage.run());
  while (const dmrp_sample* sample = stage.reader->next_sample()) {
    CHECK(sample->contact_count == 0);
    const dmrp_pose a = robot_of(*sample, 0).pose, b = robot_of(*sample, 1).pose;
    if (std::abs(a.x - b.x) < 0.3) CHECK(b.y - a.y > 0.5);
  }
}

}  // namespace dispatcher_test
