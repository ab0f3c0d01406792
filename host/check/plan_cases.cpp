// SPDX-License-Identifier: MIT
// Cases about plans: what planners are asked for, and the paths that controllers are handed.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "host/check/check_case.hpp"
#include "host/check/examination.hpp"
#include "host/check/rehearsal/rehearsal.hpp"

namespace dmrp::host::plan_cases {

void windows(Examination& it) {
  if (!it.plugin().has_flag(DMRP_FLAG_WINDOWED)) throw Skipped{"it has no DMRP_FLAG_WINDOWED"};
  for (const std::uint32_t steps : {3u, 10u}) {
    it.at(fmt::format("windows of {} steps", steps));
    rehearse_on(it, {.window_steps = steps, .goals_grow = true});
  }
}

void goals(Examination& it) {
  for (const std::uint32_t first : {0u, 5u}) {
    it.at(fmt::format("two goals, the first of them with the index {}", first));
    rehearse_on(it, {.first_goal = first, .goals_grow = true});
  }
}

void resting(Examination& it) {
  rehearse_on(it, {.one_fails = true});
}

namespace {

constexpr double most_past_end_m = 0.25;  // as much as the usual tolerance of a goal

// One robot along a straight path of metres through an empty hall.
class Drive {
 public:
  explicit Drive(Examination& it, std::uint32_t quarter_turns = 0)
      : it_(it),
        instance_(it.create()),
        rehearsal_(*instance_, it.plugin(), {.robots = 1, .people = 0, .quarter_turns = quarter_turns, .ticks = 1000},
                   it.seed()) {}

  // Its path ends at this waypoint from now on.
  void hand(std::uint32_t end) { rehearsal_.stage().path_end = end; }

  // Drives for so long, or until it has come so far. Returns how far it has been, along the path's line.
  double drive(std::uint32_t ticks, double until_m = 1e9) {
    for (std::uint32_t i = 0; i < most_ticks(ticks) && reached_m_ < until_m && rehearsal_.advance(); ++i)
      reached_m_ = std::max(reached_m_, along_m());
    return reached_m_;
  }

  const Outputs& outputs() const { return rehearsal_.outputs(); }

  // Drives on a path that ends at this waypoint, and fails a robot that does not stop there.
  double drive_to(std::uint32_t end, std::uint32_t ticks) {
    hand(end);
    const double reached_m = drive(ticks);
    if (reached_m > end + most_past_end_m)
      it_.fail(fmt::format("drives {:.2f} m beyond the end of a path of {} m that is partial", reached_m - end, end));
    return reached_m;
  }

 private:
  double along_m() const {
    const core::World& world = rehearsal_.stage().world;
    const dmrp_pose& here = world.robots()[0].pose;
    const dmrp_pose& goal = world.goals(0).front().pose;
    const dmrp_pose& start = rehearsal_.stage().variant.scenario.robots[0].start;
    const dmrp_vec2 way = {goal.x - start.x, goal.y - start.y};
    return ((here.x - start.x) * way.x + (here.y - start.y) * way.y) / std::hypot(way.x, way.y);
  }

  Examination& it_;
  std::unique_ptr<Instance> instance_;
  mutable Rehearsal rehearsal_;
  double reached_m_ = 0.0;
};

void skip_if_slow() {
  if (most_ticks(1000) < 1000) throw Skipped{"its calls take too long for a whole drive"};
}

}  // namespace

void path_ends(Examination& it) {
  skip_if_slow();
  Drive held(it);
  it.at("a partial path");
  if (held.drive_to(3, 160) < 1.0) throw Skipped{"it does not drive alone in an empty hall"};
  Drive robot(it);
  robot.drive_to(3, 100);
  it.at("a path that continues it");
  robot.hand(6);
  robot.drive(60);
  if (robot.outputs() == held.outputs()) it.fail("drives as if it had not been handed over");
  it.at("a continued path that is cut again");
  robot.hand(9);
  robot.drive(60, 5.5);
  robot.drive_to(7, 120);
}

void directions(Examination& it) {
  skip_if_slow();
  constexpr std::array names = {"+x", "+y", "-x", "-y"};
  double first_m = 0.0;
  for (std::uint32_t turns = 0; turns < names.size(); ++turns) {
    it.at(fmt::format("a straight path in the direction {}", names[turns]));
    const double reached_m = Drive(it, turns).drive(80);
    if (turns == 0) first_m = reached_m;
    if (first_m < 1.0) throw Skipped{"it does not drive alone in an empty hall"};
    if (reached_m < 0.5 * first_m)
      it.fail(fmt::format("comes {:.1f} m far in 8 s, but {:.1f} m in the direction {}", reached_m, first_m, names[0]));
  }
}

}  // namespace dmrp::host::plan_cases

namespace dmrp::host {

std::span<const CheckCase> plan_check_cases() {
  static constexpr CheckCase cases[] = {
      {"plans/windows", for_planners, plan_cases::windows,
       "global_planner.h: paths are free of conflicts until the window's end, and partial where they end before the "
       "last "
       "goal; their last places differ",
       "count the window from effective_from_ns, and let each path move on from where `start` says"},
      {"plans/goals", for_planners, plan_cases::goals,
       "global_planner.h: goals that were visited are gone, and others are added; goals[0] has the index "
       "first_goal_index, which world.goals need not have",
       "take goals and their indices from the problem, at every call"},
      {"plans/resting", for_planners, plan_cases::resting,
       "global_planner.h: an inactive robot rests at its start: its path is that one waypoint, and others lead around "
       "it",
       "test the state of every robot, at every call"},
      {"paths/ends", for_controllers, plan_cases::path_ends,
       "local_controller.h: a path ends where the robot must stop; a path that continues another one leads on, and may "
       "be cut again",
       "stop at the last waypoint of the newest path, whatever its flags, and drive on when a longer one comes"},
      {"paths/directions", for_controllers, plan_cases::directions, "values.h: angles are in radians, from -pi to pi",
       "compute differences of angles in radians, and bring them back into -pi to pi"},
  };
  return cases;
}

}  // namespace dmrp::host
