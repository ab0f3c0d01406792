// SPDX-License-Identifier: MIT
#include "pedestrians/orca/orca.hpp"

#include <algorithm>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>

#include "reciprocal/velocity_obstacle.hpp"

namespace dmrp::pedestrians {

using reciprocal::HalfPlane;

namespace {

// The highest speed, relative to the desired speed.
constexpr double speed_cap_factor = 1.3;

// The largest speed and radius for which the search for walls reaches far enough.
constexpr double largest_speed_m_s = 5.0;
constexpr double largest_radius_m = 0.5;

// The size of the grid's cells relative to the search radius that makes the search fastest.
constexpr double cell_per_reach = 0.4;

// Two people each make half of the change.
constexpr double even_share = 0.5;

}  // namespace

Descriptor Orca::describe() {
  return describe_model("dmrp.pedestrian.orca", "ORCA")
      .summary(
          "people choose the collision-free velocity nearest to their preferred one, provided that all do their share")
      .source(
          "van den Berg, Guy, Lin, Manocha: Reciprocal n-body collision avoidance, ISRR 2009 (Springer 2011), "
          "doi:10.1007/978-3-642-19457-3_1");
}

Status Orca::start(const Start& start) {
  const World& world = start.world;
  side_preference_.start(start.seed);
  start_people(start, to_robots, cell_per_reach * neighbor_distance);
  walls_.start(world.segments(), world->lower, world->upper, largest_speed_m_s * time_horizon_obst + largest_radius_m);
  neighbors_.resize(static_cast<std::size_t>(max_neighbors));
  return Status::ok;
}

Status Orca::step(const Crowd& crowd, Motions& motions) {
  gather(crowd, [&](std::uint32_t slot, const Person& person) {
    return side_preference_.apply(slot, person, ways_.direction(slot, person));
  });

  const double step_s = seconds(crowd.dt_ns);
  for (const Walker& walker : walkers_.by_place()) {
    const auto& [person, way, slot, robot_weight] = walker;
    const double max_speed = speed_cap_factor * person.desired_speed;
    planes_.clear();
    walls_.append_half_planes(person.position, person.velocity, person.radius_m, max_speed, time_horizon_obst, planes_);
    const std::size_t wall_planes = planes_.size();

    const std::size_t neighbor_count = find_neighbors(walker, crowd.people);
    for (std::size_t i = 0; i < neighbor_count; ++i) {
      if (neighbors_[i].is_ignored) continue;
      const HalfPlane plane = permitted_by(neighbors_[i], person, step_s);
      // most planes contain every velocity up to the cap
      if (violation(plane, {0.0, 0.0}) > -max_speed) planes_.push_back(plane);
    }
    motions[slot].velocity = program_.solve(planes_, wall_planes, max_speed, preferred_velocity(way, person, step_s));
  }
  return Status::ok;
}

HalfPlane Orca::permitted_by(const Neighbor& other, const Person& person, double step_s) const {
  const Body& body = *other.body;
  const reciprocal::Encounter encounter = {body.position - person.position, person.velocity - body.velocity,
                                           person.radius_m + body.radius_m};
  const double horizon_s = std::max(other.weight * time_horizon, step_s);
  return give_way(reciprocal::escape(encounter, horizon_s, step_s), person.velocity, even_share * other.weight);
}

std::size_t Orca::find_neighbors(const Walker& walker, const Span<Person>& people) {
  const auto most = static_cast<std::size_t>(max_neighbors);
  const auto id = [&](const Body* body) {
    return body->slot == no_slot ? std::numeric_limits<std::uint64_t>::max() : people[body->slot].id;
  };
  const auto comes_before = [&](const Neighbor& a, const Neighbor& b) {
    return a.squared_distance < b.squared_distance ||
           (a.squared_distance == b.squared_distance && id(a.body) < id(b.body));
  };

  std::size_t count = 0;
  walkers_.visit_neighbors(walker, neighbor_distance, [&](const Neighbor& found) {
    if (count < most) {
      ++count;
    } else if (!comes_before(found, neighbors_[most - 1])) {
      return;
    }
    std::size_t place = count - 1;
    for (; place > 0 && comes_before(found, neighbors_[place - 1]); --place) neighbors_[place] = neighbors_[place - 1];
    neighbors_[place] = found;
  });
  return count;
}

Vec2 Orca::preferred_velocity(Vec2 way, const Person& person, double step_s) {
  const double to_target_m = toolkit::distance(person.position, person.target);
  const double speed = std::min(person.desired_speed, to_target_m / step_s);  // does not pass the target
  return speed * way;
}

}  // namespace dmrp::pedestrians
