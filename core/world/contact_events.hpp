// SPDX-License-Identifier: MIT
// contact_events.hpp: groups contacts into events, and says who is at fault and how fast the bodies met.
#pragma once

#include <dmrp/observation.h>
#include <dmrp/sample.h>

#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <vector>

namespace dmrp::core {

inline constexpr double contact_depth_m = 0.001;           // a deeper overlap is a contact
inline constexpr std::int64_t event_gap_ns = 500'000'000;  // contacts less apart belong to the same event
inline constexpr double rest_speed = 0.05;                 // m/s; a slower body is at rest

// The bodies at one time. Robots keep their index; people are identified by id.
struct ContactBodies {
  std::span<const dmrp_agent> robots;
  std::span<const dmrp_agent> people;
  std::span<const double> turning{};  // rad/s, by robot; the surface of a disc does not move, so 0. Empty: all discs
};

// Sets the flags and the impact speed of contacts. Fault is passive motion safety (Bouraine, Fraichard, Salhi 2012): a
// body is at fault unless it was at rest or moving away from the other when they touched, whatever the other did. What
// counts is the velocity of its surface at the contact one step before, which the contact has not yet stopped. All
// samples of an event have the fault of the first.
class ContactTracker {
 public:
  // Takes the contacts at t_ns. `normals`: unit, from b toward a, by contact. Call it at every step, also without contacts,
  // with increasing times.
  void update(std::int64_t t_ns, const ContactBodies& bodies, std::span<const dmrp_vec2> normals,
              std::span<dmrp_contact> contacts);

 private:
  struct Event {
    std::int64_t last_ns = 0;
    std::uint32_t fault = 0;
  };
  using Pair = std::tuple<std::uint32_t, std::uint32_t, std::uint64_t>;  // kind, a, b or the person's id

  dmrp_vec2 velocity_of_b(const dmrp_contact& contact, std::uint64_t id, const ContactBodies& bodies) const;
  dmrp_vec2 velocity_of_robot(std::uint32_t robot, dmrp_vec2 point, const ContactBodies& bodies) const;

  // One step before.
  std::vector<dmrp_agent> robots_;
  std::vector<dmrp_agent> people_;
  std::vector<double> turning_;
  std::map<Pair, Event> events_;
};

}  // namespace dmrp::core
