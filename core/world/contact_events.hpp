// SPDX-License-Identifier: MIT
// contact_events.hpp: groups contacts into events and attributes their fault.
#pragma once

#include <dmrp/observation.h>
#include <dmrp/sample.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace dmrp::core {

inline constexpr double contact_depth_m = 0.001;           // a deeper overlap is a contact
inline constexpr std::int64_t event_gap_ns = 500'000'000;  // contacts less apart belong to the same event
inline constexpr std::int64_t fault_window_ns = 500'000'000;
inline constexpr double fault_speed = 0.05;   // m/s toward the other
inline constexpr double full_braking = 0.95;  // of a_max
inline constexpr double standing_m_s = 1e-3;

// Sets the flags of contacts from the bodies' motion before:
// - static: the robot is at fault.
// - with a person: the robot is at fault if its velocity toward the person exceeded fault_speed at any time in the
//   fault window, unless it has braked as hard as it can since it first saw the person: since the first control tick at
//   which the person was in sight until the contact, plus the latency, its speed fell by at least full_braking times
//   a_max in every step until it stood. Otherwise the person is at fault. The contact is also unavoidable if robot and
//   person would have missed each other at the constant velocities of one braking time earlier: the robot's greatest speed in the fault window divided by
//   a_max, plus the latency of its commands.
// - between robots: every robot whose velocity toward the other exceeded fault_speed in the fault window is at fault.
// All samples of an event have the same fault.
class ContactTracker {
 public:
  // What bounds a robot's braking time.
  struct Braking {
    double a_max = 1.0;
    double v_max = 1.0;           // its greatest speed
    std::int64_t latency_ns = 0;  // from an observation to the reaction
  };

  // When robots could see people, whatever their controllers observe.
  struct Sight {
    std::int64_t control_period_ns = 0;  // robots look at its multiples; 0: at every step
    std::function<bool(std::uint32_t robot, dmrp_vec2 from, dmrp_vec2 person)> sees = {};  // empty: always
  };

  explicit ContactTracker(std::vector<Braking> robots) : ContactTracker(std::move(robots), Sight()) {}
  ContactTracker(std::vector<Braking> robots, Sight sight);

  // Sets `flags` of the contacts at t_ns, given the bodies at this time. Call it at every step, also without contacts,
  // with increasing times. Robots keep their index; people are identified by id.
  void update(std::int64_t t_ns, std::span<const dmrp_agent> robots, std::span<const dmrp_agent> people,
              std::span<dmrp_contact> contacts);

 private:
  struct Moment {
    std::int64_t t_ns = 0;
    std::vector<dmrp_agent> robots;
    std::vector<dmrp_agent> people;
  };
  struct Event {
    std::int64_t last_ns = 0;
    std::uint32_t fault = 0;
  };
  using Pair = std::tuple<std::uint32_t, std::uint32_t, std::uint64_t>;  // kind, a, b or the person's id

  // The motion in the fault window.
  struct Motion {
    bool a_moved = false;  // toward the other
    bool b_moved = false;
    double a_speed = 0.0;  // the greatest
  };

  // `b`: the other robot's index or the person's id.
  std::uint32_t fault_of(const dmrp_contact& contact, std::uint64_t b, std::int64_t t_ns) const;
  Motion motion_before(const dmrp_contact& contact, std::uint64_t b, std::int64_t t_ns) const;
  bool braked_at_once(const dmrp_contact& contact, std::uint64_t b) const;
  bool was_unavoidable(const dmrp_contact& contact, std::uint64_t b, std::int64_t t_ns, double speed) const;
  static const dmrp_agent* body_b(const Moment& moment, const dmrp_contact& contact, std::uint64_t b);

  std::vector<Braking> robots_;
  Sight sight_;
  std::int64_t memory_ns_ = fault_window_ns;
  std::deque<Moment> history_;  // before the current step, oldest first
  std::map<Pair, Event> events_;
};

}  // namespace dmrp::core
