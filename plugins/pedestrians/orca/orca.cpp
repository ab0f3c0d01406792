// SPDX-License-Identifier: MIT
#include "orca/orca.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>

#include "orca/velocity_obstacle.hpp"

namespace dmrp::pedestrians {

namespace {

// Nobody walks faster than this times the desired speed.
constexpr double speed_cap_factor = 1.3;

// Walls are minded in time by who walks up to this fast and is this broad.
constexpr double fastest_m_s = 5.0;
constexpr double broadest_radius_m = 0.5;

// Two who avoid each other take half each.
constexpr double even_share = 0.5;

// Preferred velocities are turned by up to this much, rad: nothing that one could see, and yet no two people meet in
// perfect symmetry, in which neither would give way.
constexpr double widest_turn = 1e-3;

}  // namespace

Descriptor Orca::describe() {
  return Descriptor("dmrp.pedestrian.orca", "ORCA", "1.0.0")
      .vendor("dmrp")
      .license("MIT")
      .summary("people take the velocity nearest to their wish that is free of collisions if all do their share")
      .source(
          "van den Berg, Guy, Lin, Manocha: Reciprocal n-body collision avoidance, ISRR 2009 (Springer 2011), "
          "doi:10.1007/978-3-642-19457-3_1");
}

Status Orca::start(const World& world, std::uint64_t seed) {
  seed_ = seed;
  ways_.start(world.walking_grid());
  grid_.start(world->lower, world->upper, neighbor_distance);
  walls_.start(world.segments(), world->lower, world->upper, fastest_m_s * time_horizon_obst + broadest_radius_m);
  leanings_.clear();
  neighbors_.reserve(static_cast<std::size_t>(max_neighbors) + 1);
  return Status::ok;
}

Status Orca::step(const Crowd& crowd, Vec2* velocities) {
  gather(crowd);
  grid_.build(bodies_);

  const double step_s = seconds(crowd.dt_ns);
  for (std::uint32_t slot = 0; slot < crowd.people.size(); ++slot) {
    const Person& person = crowd.people[slot];
    const double max_speed = speed_cap_factor * person.desired_speed;
    planes_.clear();
    walls_.append_half_planes(person.position, person.velocity, person.radius_m, max_speed, time_horizon_obst, planes_);
    const std::size_t wall_planes = planes_.size();

    find_neighbors(slot, crowd.people);
    for (const Neighbor& neighbor : neighbors_) {
      const Body& other = *neighbor.body;
      const Encounter met = {other.position - person.position, person.velocity - other.velocity,
                             person.radius_m + other.radius_m};
      const double horizon_s = std::max(other.weight * time_horizon, step_s);
      planes_.push_back(give_way(escape(met, horizon_s, step_s), person.velocity, even_share * other.weight));
    }
    velocities[slot] = program_.solve(planes_, wall_planes, max_speed, preferred_velocity(slot, person, step_s));
  }
  return Status::ok;
}

void Orca::gather(const Crowd& crowd) {
  bodies_.clear();
  for (std::uint32_t slot = 0; slot < crowd.people.size(); ++slot) {
    const Person& person = crowd.people[slot];
    bodies_.push_back({person.position, person.velocity, person.radius_m, 1.0, slot});
  }
  if (robot_awareness > 0.0)
    for (const Agent& robot : crowd.robots)
      bodies_.push_back({toolkit::position(robot.pose), robot.velocity, robot.radius_m, robot_awareness, no_slot});

  for (std::size_t slot = leanings_.size(); slot < crowd.people.size(); ++slot)
    leanings_.push_back({~crowd.people[slot].id, 0.0});
}

void Orca::find_neighbors(std::uint32_t slot, const Span<Person>& people) {
  const auto most = static_cast<std::size_t>(max_neighbors);
  const auto id = [&](const Body& body) {
    return body.slot == no_slot ? std::numeric_limits<std::uint64_t>::max() : people[body.slot].id;
  };
  const auto comes_before = [&](const Neighbor& a, const Neighbor& b) {
    if (a.squared_distance != b.squared_distance) return a.squared_distance < b.squared_distance;
    return id(*a.body) < id(*b.body);
  };

  neighbors_.clear();
  grid_.for_each_near(people[slot].position, [&](const Body& other, double squared_distance) {
    if (other.slot == slot || !(squared_distance > 0.0)) return;
    const Neighbor found = {squared_distance, &other};
    if (neighbors_.size() == most) {
      if (!comes_before(found, neighbors_.back())) return;
      neighbors_.pop_back();
    }
    neighbors_.push_back(found);
    for (std::size_t i = neighbors_.size() - 1; i > 0 && comes_before(neighbors_[i], neighbors_[i - 1]); --i)
      std::swap(neighbors_[i], neighbors_[i - 1]);
  });
}

Vec2 Orca::preferred_velocity(std::uint32_t slot, const Person& person, double step_s) {
  Leaning& leaning = leanings_[slot];
  if (leaning.person_id != person.id)
    leaning = {person.id, toolkit::Stream(seed_, "pedestrian.leaning", person.id).uniform(-widest_turn, widest_turn)};

  const Vec2 direction = ways_.direction(slot, person);
  const double to_target_m = toolkit::distance(person.position, person.target);
  const double speed = std::min(person.desired_speed, to_target_m / step_s);  // not past the target
  return speed * (direction + leaning.turn * toolkit::perpendicular(direction));
}

}  // namespace dmrp::pedestrians
