// SPDX-License-Identifier: MIT
#include "core/world/contact_events.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

namespace contact_events_test {

using namespace dmrp;
using namespace dmrp::core;

constexpr std::int64_t step_ns = 20'000'000;
constexpr std::int64_t second_ns = 1'000'000'000;
constexpr std::uint32_t begins = DMRP_CONTACT_BEGINS;
constexpr std::uint32_t fault_a = DMRP_CONTACT_FAULT_A;
constexpr std::uint32_t fault_b = DMRP_CONTACT_FAULT_B;
constexpr dmrp_vec2 from_b_to_a = {-1.0, 0.0};  // b stands east of a

dmrp_agent agent(std::uint64_t id, dmrp_vec2 position, dmrp_vec2 velocity) {
  dmrp_agent made{};
  made.id = id;
  made.pose = {position.x, position.y, 0.0};
  made.velocity = velocity;
  made.radius_m = 0.25;
  return made;
}

dmrp_contact contact_of(std::uint32_t kind) {
  dmrp_contact contact{};
  contact.kind = kind;
  contact.b = kind == DMRP_CONTACT_ROBOT ? 1 : 0;
  contact.point = {0.25, 0.0};
  return contact;
}

// Robot 0 touches what is east of it; the velocities are those of the step before, then the contact stops both.
dmrp_contact meeting(std::uint32_t kind, dmrp_vec2 robot, dmrp_vec2 other, double turning = 0.0) {
  ContactTracker tracker;
  const std::vector<double> turns = {turning, 0.0};
  const std::vector<dmrp_agent> moving = {agent(0, {}, robot), agent(1, {0.5, 0.0}, other)};
  const std::vector<dmrp_agent> walking = {agent(77, {0.5, 0.0}, other)};
  tracker.update(0, {moving, walking, turns}, {}, {});
  const std::vector<dmrp_agent> stopped = {agent(0, {}, {}), agent(1, {0.5, 0.0}, {})};
  const std::vector<dmrp_agent> standing = {agent(77, {0.5, 0.0}, {})};
  dmrp_contact contact = contact_of(kind);
  tracker.update(step_ns, {stopped, standing, {}}, {&from_b_to_a, 1}, {&contact, 1});
  return contact;
}

TEST_CASE("a body is at fault unless it was at rest or moved away when they touched") {
  const auto flags = [](std::uint32_t kind, dmrp_vec2 robot, dmrp_vec2 other) {
    return meeting(kind, robot, other).flags;
  };
  for (const std::uint32_t kind : {DMRP_CONTACT_PERSON, DMRP_CONTACT_ROBOT}) {
    CHECK(flags(kind, {0.5, 0.0}, {}) == (begins | fault_a));
    CHECK(flags(kind, {}, {-1.0, 0.0}) == (begins | fault_b));
    CHECK(flags(kind, {0.5, 0.0}, {-1.0, 0.0}) == (begins | fault_a | fault_b));
    CHECK(flags(kind, {-0.6, 0.0}, {-1.0, 0.0}) == (begins | fault_b));  // caught up with
    CHECK(flags(kind, {0.8, 0.0}, {0.4, 0.0}) == (begins | fault_a));    // catches up
    CHECK(flags(kind, {0.04, 0.0}, {-1.0, 0.0}) == (begins | fault_b));  // slow enough to be at rest
    CHECK(flags(kind, {0.06, 0.0}, {-1.0, 0.0}) == (begins | fault_a | fault_b));
    CHECK(flags(kind, {0.0, 0.5}, {-1.0, 0.0}) == (begins | fault_a | fault_b));  // past it is not away from it
    CHECK(flags(kind, {}, {}) == begins);                                         // pushed together by somebody else
  }
}

TEST_CASE("a wall is at rest") {
  CHECK(meeting(DMRP_CONTACT_STATIC, {0.5, 0.0}, {}).flags == (begins | fault_a));
  CHECK(meeting(DMRP_CONTACT_STATIC, {0.04, 0.0}, {}).flags == begins);
  CHECK(meeting(DMRP_CONTACT_STATIC, {-0.5, 0.0}, {}).flags == begins);
}

TEST_CASE("the surface of a body that turns moves, unless it is a disc") {
  // its point at (0.25, 0) moves north, aslant to a normal that points south-west
  const dmrp_vec2 normal = {-std::sqrt(0.5), -std::sqrt(0.5)};
  for (const double turning : {0.4, 0.1, -0.4}) {
    dmrp_contact contact = contact_of(DMRP_CONTACT_STATIC);
    ContactTracker tracker;
    const std::vector<dmrp_agent> robots = {agent(0, {}, {})};
    const std::vector<double> turns = {turning};
    tracker.update(0, {robots, {}, turns}, {}, {});
    tracker.update(step_ns, {robots, {}, turns}, {&normal, 1}, {&contact, 1});
    CHECK(contact.flags == (turning == 0.4 ? begins | fault_a : begins));  // 0.1 m/s; 0.025 m/s; away
    CHECK(contact.impact_speed == Approx(std::max(0.0, 0.25 * turning * std::sqrt(0.5))));
  }
}

TEST_CASE("the impact speed is the relative speed along the normal before the contact stops the bodies") {
  const auto impact = [](std::uint32_t kind, dmrp_vec2 robot, dmrp_vec2 other) {
    return meeting(kind, robot, other).impact_speed;
  };
  CHECK(impact(DMRP_CONTACT_PERSON, {0.5, 0.0}, {-1.0, 0.0}) == Approx(1.5));
  CHECK(impact(DMRP_CONTACT_ROBOT, {0.8, 0.0}, {0.5, 0.0}) == Approx(0.3));
  CHECK(impact(DMRP_CONTACT_STATIC, {0.3, 0.4}, {}) == Approx(0.3));  // what slides along does not count
  CHECK(impact(DMRP_CONTACT_PERSON, {-0.5, 0.0}, {}) == 0.0);
}

TEST_CASE("a contact that pauses for less than half a second is the same event, with the same fault") {
  ContactTracker tracker;
  std::vector<std::int64_t> begins_ns;
  std::uint32_t last_fault = 0;
  for (std::int64_t t_ns = 0; t_ns <= 4 * second_ns; t_ns += step_ns) {
    // the robot drives at the person first and stands later; contact at 1.0 to 1.2, at 1.68, and at 2.18 s
    const bool touching =
        (t_ns >= second_ns && t_ns <= 1'200'000'000) || t_ns == 1'680'000'000 || t_ns == 2'180'000'000;
    const dmrp_vec2 velocity = t_ns < second_ns ? dmrp_vec2{0.5, 0.0} : dmrp_vec2{};
    const std::vector<dmrp_agent> robots = {agent(0, {}, velocity)};
    const std::vector<dmrp_agent> people = {agent(5, {0.5, 0.0}, {})};
    dmrp_contact contact = contact_of(DMRP_CONTACT_PERSON);
    const std::size_t count = touching ? 1 : 0;
    tracker.update(t_ns, {robots, people}, {&from_b_to_a, count}, {&contact, count});
    if (!touching) continue;
    const bool is_first = (contact.flags & begins) != 0;
    CHECK(std::isnan(contact.impact_speed) != is_first);
    last_fault = contact.flags & ~begins;
    if (t_ns < 2 * second_ns) CHECK(last_fault == fault_a);
    if (is_first) begins_ns.push_back(t_ns);
  }
  CHECK(begins_ns == std::vector<std::int64_t>{second_ns, 2'180'000'000});
  CHECK(last_fault == 0);
}

TEST_CASE("a new person in the same slot is another person") {
  ContactTracker tracker;
  const std::vector<dmrp_agent> robots = {agent(0, {}, {})};
  dmrp_contact contact = contact_of(DMRP_CONTACT_PERSON);
  const auto flags = [&](std::int64_t t_ns, std::uint64_t id, dmrp_vec2 velocity) {
    const std::vector<dmrp_agent> people = {agent(id, {0.5, 0.0}, velocity)};
    tracker.update(t_ns, {robots, people}, {&from_b_to_a, 1}, {&contact, 1});
    return contact.flags;
  };
  CHECK(flags(0, 1, {}) == begins);
  CHECK(flags(step_ns, 1, {}) == 0);
  CHECK(flags(2 * step_ns, 9, {-1.0, 0.0}) == (begins | fault_b));  // by the present velocity: there is no other
}

}  // namespace contact_events_test
