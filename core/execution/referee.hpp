// SPDX-License-Identifier: MIT
// referee.hpp: progress, arrival, the end of a trial, and why a robot failed.
//
// Every other part that asks one of these questions reads the referee's answer: replanning, endings, metrics (through
// the changes of class in the trace).
#pragma once

#include <dmrp/robot_event.h>
#include <dmrp/sample.h>
#include <dmrp/trial_end.h>

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/execution/goal_distances.hpp"
#include "core/scene/planning_grids.hpp"
#include "core/world/world.hpp"

namespace dmrp::core {

inline constexpr std::int64_t progress_window_ns = 20'000'000'000;
inline constexpr double least_progress_m = 0.2;  // in a window
inline constexpr double detour_credit_m = 20.0;  // beyond the first course to a goal
inline constexpr double circling_travel_m = 1.0;
inline constexpr double circling_turn_rad = 4.0 * 3.14159265358979323846;
inline constexpr std::int64_t controller_silence_ns = 5'000'000'000;
inline constexpr std::int64_t fixed_point_ns = 30'000'000'000;
inline constexpr double continued_share = 0.05;  // of the fixed points: those trials run to their limit

// A robot on its course, as the dispatcher sees it. `path` is empty if no course concerns the robot.
struct CoursePlace {
  std::uint64_t revision = 0;  // of the course
  std::span<const dmrp_waypoint> path;
  double arc_m = 0.0;                   // of the place reached
  std::uint32_t passed = 0;             // waypoint
  bool returns = false;                 // it leaves the last goal and comes back to it, after the place reached
  std::optional<std::uint32_t> holder;  // the robot for which it waits at the last waypoint that it may pass
};

// The referee of one trial.
//
// Progress of a robot: what it comes nearer to its goal by the shortest way, whatever its plan; and what it gains along
// its course away from the goal, up to a credit of the first course's length plus detour_credit_m for each goal. No
// plan can fake the first or refill the second, so no robot gains for ever without arriving.
//
// Visit and park are two things. A robot visits a goal when it meets the goal's conditions for the settling time; if
// it has a next goal, that one becomes current. It parks (DMRP_ROBOT_FINISHED) at its last goal, unless its course
// leaves the goal to give way and comes back: then it follows its course first. A robot that waits there for a whole
// window without being held asks for a plan (wants_plan()) and is parked by it.
//
// Class (DMRP_CLASS_*) of an active robot at a control tick: the first that holds of settling, recovering, held, moving
// (gained least_progress_m in its window, or the window is younger), blocked by a person or a robot on the next metre of
// its course, stuck. Circling: not moving, but travels or turns. A window begins with the trial, with a goal, and
// when a spell of settling, recovering or being held ends.
//
// A trial ends when all robots are parked, when none is active, at its time limit, or as a deadlock: at a fixed point,
// in which for fixed_point_ns no active robot and nobody near one moves, no course changes and no recovery runs; or at
// once where every active robot is held behind one that failed and nothing can replan. continued_share of the fixed
// points, drawn by the seed, run to the limit all the same, so that what the rule costs can be counted.
class Referee {
 public:
  struct Settings {
    bool oscillation_fails = false;  // a robot that circled has failed even if it arrives (the paper's exclusion)
    bool replans = false;
  };

  // Both outlive it. Parks the robots that are at their goals already.
  Referee(World& world, const PlanningGrids& grids, Settings settings, std::uint64_t seed);

  void command_given(std::uint32_t robot) { robots_[robot].command_ns = world_.t_ns(); }
  void recovers(std::uint32_t robot, bool recovering) { robots_[robot].recovering = recovering; }

  // After every step, with the courses before it: robots visit goals and park.
  void judge_arrivals(std::span<const CoursePlace> courses);

  // Judges progress and class; call it at every control tick, before replanning. Robots whose controllers are silent fail.
  void judge_progress(std::span<const CoursePlace> courses);

  // DMRP_ENDING_*, 0 until the trial is over.
  std::uint32_t ending() const;

  // Whether a robot has waited at its last goal for a window, to be parked by a plan. Once a window.
  bool wants_plan();

  // What each robot has gained in the whole trial, in metres. It never decreases.
  std::span<const double> gained_m() const { return gained_m_; }
  std::uint32_t class_of(std::uint32_t robot) const { return robots_[robot].verdict.kind; }

  // Since when the robot has gained less than least_progress_m.
  std::int64_t waits_since_ns(std::uint32_t robot) const { return robots_[robot].gained_ns; }

  // What there is to tell since the last call, as events of the trace (dmrp/robot_event.h): changes of class, first the
  // class of every active robot; and that a standstill runs on.
  std::vector<dmrp_robot_event> take_changes() { return std::exchange(changes_, {}); }

  // The outcome of every robot at the end of the trial.
  std::vector<dmrp_robot_end> robot_ends(std::uint32_t ending) const;

 private:
  struct Verdict {
    std::uint32_t kind = DMRP_CLASS_MOVING;
    std::uint32_t other = DMRP_NOBODY;  // that holds or blocks it
    bool circles = false;
    bool operator==(const Verdict&) const = default;
  };
  struct Moment {
    std::int64_t t_ns;
    double gained_m;
    double travelled_m;
    double turned_rad;
  };
  struct Watched {
    std::shared_ptr<GoalDistances> distances;  // of an active robot
    double nearest_m = 0.0;                    // the least distance to the goal so far
    std::optional<double> credit_m;            // unset until a course leads to the goal
    std::uint64_t course = 0;                  // of arc_m
    double arc_m = 0.0;
    double counted_m = 0.0;      // of gained_m_, at gained_ns
    std::int64_t gained_ns = 0;  // when it had last gained least_progress_m more
    std::deque<Moment> window;   // up to the latest moment that is a whole window old
    double travelled_m = 0.0;
    double turned_rad = 0.0;
    dmrp_pose pose{};  // at the last control tick
    Verdict verdict;
    bool was_moving_freely = true;  // not in a spell that stops the window
    bool recovering = false;
    bool circled = false;  // at some time
    std::int64_t command_ns = 0;
    std::int64_t waits_since_ns = -1;  // at its last goal, to be parked
    std::uint32_t visits = 0;
    std::uint32_t failure = DMRP_FAILURE_NONE;
    dmrp_pose still_pose{};  // where it stands since the fixed point may have begun
  };

  bool is_active(std::uint32_t robot) const { return world_.robots()[robot].state == DMRP_ROBOT_ACTIVE; }
  void begin_goal(std::uint32_t robot);
  void restart_window(std::uint32_t robot);
  void gain(std::uint32_t robot, const CoursePlace& course);
  void remember(std::uint32_t robot);
  Verdict classify(std::uint32_t robot, const CoursePlace& course) const;
  bool is_moving(std::uint32_t robot) const;
  Verdict blocked_by(std::uint32_t robot, const CoursePlace& course) const;
  std::uint32_t root_of(std::uint32_t robot) const;
  void watch_standstill(std::span<const CoursePlace> courses);
  bool people_stir();
  bool all_held_behind_failed() const;

  World& world_;
  const PlanningGrids& grids_;
  Settings settings_;
  GoalDistancesCache distances_;
  std::vector<Watched> robots_;
  std::vector<double> gained_m_;
  std::vector<dmrp_robot_event> changes_;
  std::map<std::uint64_t, dmrp_vec2> people_;  // where each was when it last moved least_progress_m, by id
  std::int64_t still_since_ns_ = 0;
  bool continues_ = false;  // at a fixed point too
  bool runs_on_ = false;    // since a fixed point
};

}  // namespace dmrp::core
