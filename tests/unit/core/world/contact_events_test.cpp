// SPDX-License-Identifier: MIT
#include "core/world/contact_events.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

using namespace dmrp;
using namespace dmrp::core;

namespace {

constexpr std::int64_t step_ns = 20'000'000;
constexpr std::int64_t second_ns = 1'000'000'000;

dmrp_agent agent(std::uint64_t id, dmrp_vec2 position, dmrp_vec2 velocity, double radius_m = 0.25) {
  dmrp_agent made{};
  made.id = id;
  made.pose = {position.x, position.y, 0.0};
  made.velocity = velocity;
  made.radius_m = radius_m;
  return made;
}

// A robot and another body that move straight until they touch at t = 2 s, then stand.
struct Meeting {
  dmrp_vec2 robot_velocity{};
  dmrp_vec2 other_velocity{};
  std::int64_t robot_stops_ns = 2 * second_ns;  // before the contact, if it does
  dmrp_vec2 other_velocity_early{};             // until other_turns_ns
  std::int64_t other_turns_ns = 0;

  std::uint32_t flags(std::uint32_t kind) const {
    ContactTracker tracker({{1.0, 0.8}, {1.0, 0.8}});
    const double apart_m = kind == DMRP_CONTACT_PERSON ? 0.55 : 0.5;
    dmrp_contact contact{};
    contact.kind = kind;
    contact.b = kind == DMRP_CONTACT_ROBOT ? 1 : 0;
    for (std::int64_t t_ns = 0; t_ns <= 2 * second_ns; t_ns += step_ns) {
      const double left_s = 1e-9 * static_cast<double>(2 * second_ns - t_ns);
      const bool moves = t_ns < robot_stops_ns;
      const double robot_left_s = std::max(0.0, left_s - 1e-9 * static_cast<double>(2 * second_ns - robot_stops_ns));
      const dmrp_vec2 early = t_ns < other_turns_ns ? other_velocity_early : other_velocity;
      const std::vector<dmrp_agent> robots = {
          agent(0, -robot_left_s * robot_velocity, moves ? robot_velocity : dmrp_vec2{}),
          agent(1, dmrp_vec2{apart_m, 0.0} - left_s * other_velocity, other_velocity)};
      const std::vector<dmrp_agent> people = {agent(77, dmrp_vec2{apart_m, 0.0} - left_s * other_velocity, early, 0.3)};
      if (t_ns < 2 * second_ns) {
        tracker.update(t_ns, robots, people, {});
      } else {
        tracker.update(t_ns, robots, people, {&contact, 1});
      }
    }
    return contact.flags;
  }
};

}  // namespace

TEST_CASE("a contact with something static is the robot's fault") {
  CHECK(Meeting{}.flags(DMRP_CONTACT_STATIC) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_A));
}

TEST_CASE("a contact with a person is the robot's fault if it moved toward the person in the half second before") {
  const Meeting driving{{0.5, 0.0}, {}};
  CHECK(driving.flags(DMRP_CONTACT_PERSON) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_A));
  // too slow to count: 0.04 m/s
  const Meeting creeping{{0.04, 0.0}, {-1.0, 0.0}};
  CHECK(creeping.flags(DMRP_CONTACT_PERSON) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_B));
  // fast, but away: the person catches up
  const Meeting fleeing{{-0.6, 0.0}, {-1.0, 0.0}};
  CHECK(fleeing.flags(DMRP_CONTACT_PERSON) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_B));
  // stood for 0.6 s already; for 0.4 s only
  const Meeting stopped{{0.5, 0.0}, {-1.0, 0.0}, 1'400'000'000};
  CHECK(stopped.flags(DMRP_CONTACT_PERSON) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_B));
  const Meeting just_stopped{{0.5, 0.0}, {-1.0, 0.0}, 1'600'000'000};
  CHECK(just_stopped.flags(DMRP_CONTACT_PERSON) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_A));
}

TEST_CASE("a robot that brakes as hard as it can from first sight on is not at fault") {
  // a wall hides the person until 1.0 s; the robot drives at 0.8 m/s and brakes at 1 m/s2; contact at 1.9 s
  constexpr std::int64_t seen_ns = second_ns;
  constexpr std::int64_t contact_ns = 1'900'000'000;
  const auto flags = [](std::int64_t brakes_ns, double deceleration, std::int64_t latency_ns) {
    ContactTracker tracker({{1.0, 0.8, latency_ns}},
                           {100'000'000, [](std::uint32_t, dmrp_vec2, dmrp_vec2 person) { return person.y < 0.5; }});
    dmrp_contact contact{DMRP_CONTACT_PERSON, 0, 0, 0, 0.0015, {}};
    double x = 0.0;
    for (std::int64_t t_ns = 0; t_ns <= contact_ns; t_ns += step_ns) {
      const double braking_s = std::max(0.0, 1e-9 * static_cast<double>(t_ns - brakes_ns));
      const double v = std::max(0.0, 0.8 - deceleration * braking_s);
      x += 0.02 * v;
      const std::vector<dmrp_agent> robots = {agent(0, {x, 0.0}, {v, 0.0})};
      const std::vector<dmrp_agent> people = {agent(5, {x + 0.54, t_ns < seen_ns ? 1.0 : 0.0}, {}, 0.3)};
      tracker.update(t_ns, robots, people, std::span(&contact, t_ns == contact_ns ? 1 : 0));
    }
    return contact.flags & (DMRP_CONTACT_FAULT_A | DMRP_CONTACT_FAULT_B);
  };
  CHECK(flags(seen_ns, 1.0, 0) == DMRP_CONTACT_FAULT_B);
  CHECK(flags(seen_ns, 0.96, 0) == DMRP_CONTACT_FAULT_B);
  CHECK(flags(seen_ns, 0.8, 0) == DMRP_CONTACT_FAULT_A);                          // not as hard as it could
  CHECK(flags(seen_ns + 100'000'000, 1.0, 0) == DMRP_CONTACT_FAULT_A);            // a period late
  CHECK(flags(seen_ns + 100'000'000, 1.0, 100'000'000) == DMRP_CONTACT_FAULT_B);  // its latency
  CHECK(flags(seen_ns - 200'000'000, 1.0, 0) == DMRP_CONTACT_FAULT_B);            // for another reason, and no later
  CHECK(flags(10 * second_ns, 1.0, 0) == DMRP_CONTACT_FAULT_A);                   // never
}

TEST_CASE("a contact is unavoidable if the person was on no collision course one braking time before") {
  // the robot brakes from 0.8 m/s in 0.8 s; the person walked away from it until 0.5 s before the contact
  Meeting sudden{{0.8, 0.0}, {-1.0, 0.0}};
  sudden.other_velocity_early = {1.5, 0.0};
  sudden.other_turns_ns = 1'500'000'000;
  CHECK(sudden.flags(DMRP_CONTACT_PERSON) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_A | DMRP_CONTACT_UNAVOIDABLE));
  // turned 0.9 s before: there was time to brake
  Meeting seen = sudden;
  seen.other_turns_ns = 1'100'000'000;
  CHECK(seen.flags(DMRP_CONTACT_PERSON) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_A));
}

TEST_CASE("in a contact of robots each that moved toward the other is at fault") {
  CHECK(Meeting{{0.5, 0.0}, {}}.flags(DMRP_CONTACT_ROBOT) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_A));
  CHECK(Meeting{{}, {-0.5, 0.0}}.flags(DMRP_CONTACT_ROBOT) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_B));
  CHECK(Meeting{{0.5, 0.0}, {-0.5, 0.0}}.flags(DMRP_CONTACT_ROBOT) ==
        (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_A | DMRP_CONTACT_FAULT_B));
  // overtaken from behind: the slower one moves away
  CHECK(Meeting{{0.8, 0.0}, {0.4, 0.0}}.flags(DMRP_CONTACT_ROBOT) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_A));
}

TEST_CASE("a contact that pauses for less than half a second is the same event, with the same fault") {
  ContactTracker tracker(std::vector{ContactTracker::Braking{1.0, 0.8}});
  std::vector<std::int64_t> begins_ns;
  std::uint32_t last_fault = 0;
  for (std::int64_t t_ns = 0; t_ns <= 4 * second_ns; t_ns += step_ns) {
    // the robot drives at the person first and stands later; contact at 1.0 to 1.2, at 1.68, and at 2.18 s
    const bool touching =
        (t_ns >= second_ns && t_ns <= 1'200'000'000) || t_ns == 1'680'000'000 || t_ns == 2'180'000'000;
    const dmrp_vec2 velocity = t_ns < second_ns ? dmrp_vec2{0.5, 0.0} : dmrp_vec2{};
    const std::vector<dmrp_agent> robots = {agent(0, {}, velocity)};
    const std::vector<dmrp_agent> people = {agent(5, {0.54, 0.0}, {}, 0.3)};
    dmrp_contact contact{DMRP_CONTACT_PERSON, 0, 0, 0, 0.0015, {}};
    tracker.update(t_ns, robots, people, std::span(&contact, touching ? 1 : 0));
    if (!touching) continue;
    last_fault = contact.flags & ~DMRP_CONTACT_BEGINS;
    if (t_ns < 2 * second_ns) CHECK(last_fault == DMRP_CONTACT_FAULT_A);
    if ((contact.flags & DMRP_CONTACT_BEGINS) != 0) begins_ns.push_back(t_ns);
  }
  CHECK(begins_ns == std::vector<std::int64_t>{second_ns, 2'180'000'000});
  CHECK(last_fault == DMRP_CONTACT_FAULT_B);
}

TEST_CASE("a new person in the same slot is another person") {
  ContactTracker tracker(std::vector{ContactTracker::Braking{1.0, 0.8}});
  const std::vector<dmrp_agent> robots = {agent(0, {}, {})};
  dmrp_contact contact{DMRP_CONTACT_PERSON, 0, 0, 0, 0.0015, {}};
  tracker.update(0, robots, std::vector<dmrp_agent>{agent(1, {0.5, 0.0}, {})}, {&contact, 1});
  CHECK((contact.flags & DMRP_CONTACT_BEGINS) != 0);
  tracker.update(step_ns, robots, std::vector<dmrp_agent>{agent(1, {0.5, 0.0}, {})}, {&contact, 1});
  CHECK((contact.flags & DMRP_CONTACT_BEGINS) == 0);
  tracker.update(2 * step_ns, robots, std::vector<dmrp_agent>{agent(9, {0.5, 0.0}, {})}, {&contact, 1});
  CHECK((contact.flags & DMRP_CONTACT_BEGINS) != 0);
}
