// SPDX-License-Identifier: MIT
// contact_ends.hpp: which robots stand after a contact, and have failed by it.
#pragma once

#include <dmrp/robot_event.h>
#include <dmrp/trial_end.h>

#include <cstddef>
#include <cstdint>
#include <dmrp/plugin.hpp>
#include <string>
#include <vector>

#include "metrics/measure/contact_fault.hpp"

namespace dmrp::metrics {

class ContactEnds {
 public:
  void begin(std::size_t robot_count) { robots_.assign(robot_count, {}); }

  void observe(const Sample& sample) {
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      if (sample.robots[i].state != DMRP_ROBOT_ACTIVE) continue;
      robots_[i].touched_before = robots_[i].touches_at_end;
      robots_[i].touches_at_end = false;
    }
    for (const Contact& contact : sample.contacts) {
      if (!is_known(contact)) continue;
      touch(contact.a, contact, fault_of_a(contact), sample);
      if (between_robots(contact)) touch(contact.b, contact, fault_of_b(contact), sample);
    }
    for (const RobotEvent& event : sample.events) {
      if (event.kind != DMRP_ROBOT_EVENT_CLASS || event.robot >= robots_.size()) continue;
      State& robot = robots_[event.robot];
      const bool moves = (event.detail & DMRP_CLASS_MASK) == DMRP_CLASS_MOVING;
      if (moves)
        robot.stands_after_contact = false;
      else if (robot.moves)
        robot.stands_after_contact = robot.touched && event.t_ns - robot.touched_ns <= class_window_ns;
      robot.moves = moves;
    }
  }

  // Whether a robot that ended so has failed by a contact that began while it was MOVING: it touched until its end, or its
  // class was never MOVING again. One that others hold has failed by what these did.
  bool failed_by_contact(std::size_t robot, const RobotEnd& end) const {
    switch (end.failure) {
      case DMRP_FAILURE_TIMEOUT:
        return touches_since_it_moved(robot);
      case DMRP_FAILURE_CIRCLING:
      case DMRP_FAILURE_BLOCKED_PERSON:
      case DMRP_FAILURE_BLOCKED_ROBOT:
      case DMRP_FAILURE_STUCK:
        return touches_since_it_moved(robot) || robots_[robot].stands_after_contact;
      default:
        return false;
    }
  }

  // Of a robot that has failed by a contact: "stood after hitting another robot".
  std::string words(std::size_t robot, const RobotEnd& end) const {
    const State& it = robots_[robot];
    const std::string other = it.kind == DMRP_CONTACT_ROBOT    ? "another robot"
                              : it.kind == DMRP_CONTACT_PERSON ? "a person"
                                                               : "a wall or furniture";
    if (end.failure == DMRP_FAILURE_TIMEOUT) return "touched " + other + " at its end";
    return std::string(end.failure == DMRP_FAILURE_CIRCLING ? "circled" : "stood") + " after " +
           (it.at_fault || it.kind == DMRP_CONTACT_STATIC ? "hitting " + other : other + " hit it");
  }

 private:
  // A robot that is no longer MOVING has not come nearer to its goal for so long (docs/endings.md): it has not driven on
  // since a contact in this time.
  static constexpr std::int64_t class_window_ns = 20'000'000'000;

  struct State {
    bool moves = true;
    bool touched = false;
    bool touches_at_end = false;  // at the last sample in which it was active
    bool touched_before = false;  // at the sample before
    bool began_moving = false;    // it was MOVING when it began to touch
    bool at_fault = false;        // in its last contact
    bool stands_after_contact = false;
    std::uint32_t kind = 0;
    std::int64_t touched_ns = 0;
  };

  bool touches_since_it_moved(std::size_t robot) const {
    return robots_[robot].touches_at_end && robots_[robot].began_moving;
  }

  void touch(std::size_t robot, const Contact& contact, bool fault, const Sample& sample) {
    if (robot >= robots_.size() || sample.robots[robot].state != DMRP_ROBOT_ACTIVE) return;
    State& it = robots_[robot];
    if (!it.touched_before && !it.touches_at_end) it.began_moving = it.moves;
    if (begins(contact)) {
      it.began_moving = it.began_moving || it.moves;
      it.kind = contact.kind;
      it.at_fault = fault;
    }
    it.touched = it.touches_at_end = true;
    it.touched_ns = sample.t_ns;
  }

  std::vector<State> robots_;
};

}  // namespace dmrp::metrics
