// SPDX-License-Identifier: MIT
// contact_events.hpp: contacts as events with somebody at fault.
#pragma once

#include <dmrp/metric.h>
#include <dmrp/observation.h>

#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <tuple>
#include <vector>

namespace dmrp::core {

inline constexpr double contact_depth_m = 0.001;           // a deeper overlap is a contact
inline constexpr std::int64_t event_gap_ns = 500'000'000;  // less apart: the same event
inline constexpr std::int64_t fault_window_ns = 500'000'000;
inline constexpr double fault_speed = 0.05;  // m/s toward the other

// Sets the flags of contacts from how the bodies moved before:
// - static: the robot is at fault.
// - with a person: the robot, if its velocity toward the person exceeded fault_speed at any time in the fault window
//   before; otherwise the person. Unavoidable, in addition, if one braking time earlier (the robot's largest speed in
//   the fault window by a_max, and the latency of its commands) robot and person, both going straight on, would have missed each other.
// - between robots: each that moved toward the other, in the same sense.
// The fault of an event stays on every sample of it.
class ContactTracker {
 public:
  // `latency_ns`: from what a robot sees to what it does.
  ContactTracker(double a_max, double v_max, std::int64_t latency_ns = 0);

  // Sets `flags` of the contacts at t_ns, given the bodies as they are then. Every step, contacts or not; times grow.
  // Robots keep their index; people are told apart by id.
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

  // In the fault window.
  struct Motion {
    bool a_moved = false;  // toward the other
    bool b_moved = false;
    double a_speed = 0.0;  // the largest
  };

  // `b`: the other robot's index or the person's id.
  std::uint32_t fault_of(const dmrp_contact& contact, std::uint64_t b, std::int64_t t_ns) const;
  Motion motion_before(const dmrp_contact& contact, std::uint64_t b, std::int64_t t_ns) const;
  bool was_unavoidable(const dmrp_contact& contact, std::uint64_t b, std::int64_t t_ns, double speed) const;
  static const dmrp_agent* body_b(const Moment& moment, const dmrp_contact& contact, std::uint64_t b);

  double a_max_;
  std::int64_t latency_ns_;
  std::int64_t memory_ns_;
  std::deque<Moment> history_;  // before the present step, oldest first
  std::map<Pair, Event> events_;
};

}  // namespace dmrp::core
