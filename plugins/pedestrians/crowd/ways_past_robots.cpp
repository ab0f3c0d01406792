// SPDX-License-Identifier: MIT
#include "pedestrians/crowd/ways_past_robots.hpp"

#include <algorithm>
#include <dmrp/toolkit/grid_line.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::pedestrians {

namespace {

// A robot ahead holds a person up if the gap is smaller than this and the person's mean speed over this time smaller
// than this share of the desired speed.
constexpr double near_m = 0.8;
constexpr double trail_time_s = 1.0;
constexpr double slow_share = 0.2;

// The time after which people do something about it, drawn anew for each attempt.
constexpr double least_patience_s = 0.5;
constexpr double most_patience_s = 2.0;

// They pass a robot at this gap. They give it up after this time, and where they get stuck.
constexpr double passing_gap_m = 0.05;
constexpr double passing_s = 5.0;

// They walk back for this time, drawn; for as much again in every later attempt, up to `most_attempts`.
constexpr double least_back_s = 2.0;
constexpr double most_back_s = 4.0;
constexpr std::uint32_t most_attempts = 4;

// The encounter is over once the gap is larger than this.
constexpr double past_m = 4.0;

double gap(const Person& person, const Agent& robot) {
  return toolkit::distance(person.position, toolkit::position(robot.pose)) - person.radius_m - robot.radius_m;
}

// Beside the robot, as seen by the person.
Vec2 beside(const Person& person, const Agent& robot, double side) {
  const Vec2 at = toolkit::position(robot.pose);
  const Vec2 aside = toolkit::perpendicular(toolkit::normalized(at - person.position));
  return at + side * (person.radius_m + robot.radius_m + passing_gap_m) * aside;
}

}  // namespace

void WaysPastRobots::start(std::uint64_t seed, const toolkit::GridView& grid) {
  seed_ = seed;
  grid_ = grid;
  encounters_.clear();
}

Vec2 WaysPastRobots::direction(const Person& person, Vec2 way, const Span<Agent>& robots, double step_s) {
  const bool is_new = encounters_.count(person.id) == 0;
  const bool is_slow = toolkit::dot(person.velocity, way) < slow_share * person.desired_speed;
  if (is_new && !is_slow) return way;  // most people
  const Agent* const robot = nearest(robots, [&](const Agent& each) { return gap(person, each); });
  if (robot == nullptr || gap(person, *robot) > (is_new ? near_m : past_m)) return way;

  Encounter& encounter = encounters_[person.id];
  if (is_new) begin(encounter, Does::walk, person, way);
  encounter.is_seen = true;
  encounter.trail += (person.position - encounter.trail) * std::min(step_s / trail_time_s, 1.0);
  // somebody who walks on is the way of one time constant ahead of the trail; somebody who shuffles to and fro is not
  const bool is_stuck =
      toolkit::distance(person.position, encounter.trail) < slow_share * person.desired_speed * trail_time_s;
  const Vec2 apart = toolkit::position(robot->pose) - person.position;
  const bool is_ahead = toolkit::dot(way, apart) > 0.0;
  encounter.remaining_s -= step_s;
  if (encounter.does == Does::walk) {
    encounter.held_up_s = is_stuck && is_ahead && gap(person, *robot) < near_m ? encounter.held_up_s + step_s : 0.0;
    if (encounter.held_up_s > encounter.patience_s) give_way(encounter, person, way, *robot);
  } else if (encounter.remaining_s < 0.0 || is_stuck || (encounter.does == Does::pass && !is_ahead)) {
    begin(encounter, Does::walk, person, way);
  }
  if (encounter.does == Does::pass)
    return toolkit::normalized(beside(person, *robot, encounter.side) - person.position);
  return encounter.does == Does::step_back ? -toolkit::normalized(apart) : way;
}

// The trail begins where it would be if the person had walked this way at the desired speed.
void WaysPastRobots::begin(Encounter& encounter, Does does, const Person& person, Vec2 way) const {
  encounter.does = does;
  encounter.trail = person.position - (person.desired_speed * trail_time_s) * way;
  encounter.held_up_s = 0.0;
  toolkit::Stream random(seed_, "pedestrian.patience", person.id, encounter.attempts);
  encounter.patience_s = random.uniform(least_patience_s, most_patience_s);
}

// Of every two attempts, the second one steps back.
void WaysPastRobots::give_way(Encounter& encounter, const Person& person, Vec2 way, const Agent& robot) const {
  const bool may_pass = encounter.attempts % 2 == 0;
  ++encounter.attempts;
  // the side of the way first
  const Vec2 apart = toolkit::position(robot.pose) - person.position;
  const double nearer_side = toolkit::cross(apart, way) >= 0.0 ? 1.0 : -1.0;
  for (const double side : {nearer_side, -nearer_side}) {
    if (!may_pass || !has_room(person, robot, side)) continue;
    begin(encounter, Does::pass, person, toolkit::normalized(beside(person, robot, side) - person.position));
    encounter.side = side;
    encounter.remaining_s = passing_s;
    return;
  }
  begin(encounter, Does::step_back, person, -toolkit::normalized(apart));
  toolkit::Stream random(seed_, "pedestrian.stepping_back", person.id, encounter.attempts);
  encounter.remaining_s = random.uniform(least_back_s, most_back_s) * std::min(encounter.attempts, most_attempts);
}

// Whether the straight lines to the place beside the robot and on past it are free of walls.
bool WaysPastRobots::has_room(const Person& person, const Agent& robot, double side) const {
  const Vec2 place = beside(person, robot, side);
  const Vec2 onward = toolkit::normalized(toolkit::position(robot.pose) - person.position);
  return toolkit::line_is_free(grid_, person.position, place) &&
         toolkit::line_is_free(grid_, place, place + (person.radius_m + robot.radius_m) * onward);
}

}  // namespace dmrp::pedestrians
