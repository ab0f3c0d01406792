// SPDX-License-Identifier: MIT
#include "pedestrians/collision_free_speed/collision_free_speed.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "pedestrians/collision_free_speed/speed_function.hpp"
#include "pedestrians/crowd/wall_push.hpp"

namespace dmrp::pedestrians {

namespace {

// Repulsions below this are ignored; the desired direction has 1.
constexpr double negligible_influence = 1e-4;

// The largest radius and the longest way within a step for which the searches reach far enough, m.
constexpr double largest_radius_m = 0.5;
constexpr double longest_step_m = 0.1;

// A blocked person walks on at up to this speed where only people with lower priority are in the way, m/s. The world
// lets people push each other, which opens an arch around a door.
constexpr double shuffling_speed = 0.3;

// The cells of the grid, m.
constexpr double neighbor_cell_m = 1.0;

// The gap at which the repulsion becomes negligible.
double fading_gap(double strength, double range_m) {
  return range_m * std::log(std::max(strength / negligible_influence, 1.0));
}

}  // namespace

Descriptor CollisionFreeSpeed::describe() {
  return describe_model("dmrp.pedestrian.collision_free_speed", "Collision-free speed")
      .summary("people turn away from their neighbours and walk as fast as the gap ahead permits")
      .source(
          "Tordeux, Chraibi, Seyfried: Collision-free speed model for pedestrian dynamics, Traffic and Granular Flow "
          "'15 (Springer 2016), doi:10.1007/978-3-319-33482-0_29");
}

Status CollisionFreeSpeed::start(const Start& start) {
  const World& world = start.world;
  neighbor_reach_m_ = fading_gap(neighbor_strength, neighbor_range);
  side_preference_.start(start.seed);
  start_people(start, to_robots, neighbor_cell_m);
  const double wall_reach_m = largest_radius_m + std::max(fading_gap(wall_strength, wall_range), longest_step_m);
  walls_.start(world.segments(), world->lower, world->upper, wall_reach_m);
  return Status::ok;
}

Status CollisionFreeSpeed::step(const Crowd& crowd, Motions& motions) {
  gather(crowd, [&](std::uint32_t slot, const Person& person) {
    return side_preference_.apply(slot, person, ways_.direction(slot, person));
  });

  const double step_s = seconds(crowd.dt_ns);
  for (const Walker& walker : walkers_.by_place()) {
    find_neighbors(walker);
    const Vec2 here = wish(walker, {0.0, 0.0});
    const Vec2 along = toolkit::normalized(here);
    const double speed = short_of_turning(speed_along(along, walker, step_s), here, walker, step_s);
    motions[walker.slot].velocity = without_wall_contact(speed * along, walker.person, step_s);
  }
  return Status::ok;
}

// All bodies whose repulsion counts or that can be in the way, and the walls.
void CollisionFreeSpeed::find_neighbors(const Walker& walker) {
  const Person& person = walker.person;
  near_.clear();
  const double largest_gap_m = std::max(neighbor_reach_m_, person.desired_speed * time_gap);
  const double reach_m = person.radius_m + largest_radius_m + largest_gap_m;
  walkers_.visit_neighbors(walker, reach_m, [&](const Neighbor& other) {
    const double sum_of_radii_m = person.radius_m + other.body->radius_m;
    near_.push_back({other.body->position - person.position, std::sqrt(other.squared_distance) - sum_of_radii_m,
                     sum_of_radii_m, other.weight, other.is_ignored});
  });
  walls_.nearest_points(person.position, wall_points_);
}

// The desired direction plus the repulsion of bodies and walls (equation 4), once the person has moved. The person
// walks along it.
Vec2 CollisionFreeSpeed::wish(const Walker& walker, Vec2 moved) {
  Vec2 sum = walker.way;
  for (const Near& other : near_) {
    if (other.gap_m > neighbor_reach_m_) continue;
    const Vec2 apart = other.apart - moved;
    const double distance_m = toolkit::norm(apart);
    const double gap_m = distance_m - other.reach_m;
    // ignored people turn the person the less the straighter ahead they are, so that nothing jumps at their sides
    const double kept = other.is_ignored ? 1.0 - std::max(toolkit::dot(walker.way, apart) / distance_m, 0.0) : 1.0;
    sum -= apart * (kept * other.weight * repulsion(neighbor_strength, neighbor_range, gap_m) / distance_m);
  }
  walls_there_ = wall_points_;
  for (WallPoint& wall : walls_there_) wall.distance_m += toolkit::dot(wall.away, moved);
  return sum + push_of_walls(walls_there_, wall_range, [&](double distance_m) {
           return repulsion(wall_strength, wall_range, distance_m - walker.person.radius_m);
         });
}

double CollisionFreeSpeed::speed_along(Vec2 direction, const Walker& walker, double step_s) const {
  const Person& person = walker.person;
  const bool is_forward = toolkit::dot(direction, walker.way) > 0.0;
  const double to_target_m = toolkit::distance(person.position, person.target);
  double speed = std::min(person.desired_speed, to_target_m / step_s);  // does not pass the target
  for (const Near& other : near_) {
    if (!is_in_the_way(direction, other.apart, other.reach_m)) continue;
    const double permitted = permitted_speed(speed, other.gap_m, std::max(other.weight * time_gap, step_s));
    speed = other.is_ignored && is_forward ? std::max(permitted, std::min(speed, shuffling_speed)) : permitted;
  }
  return speed;
}

// Where repulsion and desired direction cancel, the direction jumps to its opposite. Whoever steps over such a place
// turns back in the next step, and so on; in the limit of short steps they stay there. So nobody steps over it: each
// makes half of the way to it, because the neighbours move too. `here`: wish() before the step.
double CollisionFreeSpeed::short_of_turning(double speed, Vec2 here, const Walker& walker, double step_s) {
  const Vec2 along = toolkit::normalized(here);
  const double strength = toolkit::norm(here);
  const double strength_there = toolkit::dot(wish(walker, speed * step_s * along), along);
  return strength_there < 0.0 ? speed * 0.5 * strength / (strength - strength_there) : speed;
}

// Removes the part of the velocity that would lead into a wall within the step. The repulsion alone cannot prevent
// this, because its range is shorter than the way of a step.
Vec2 CollisionFreeSpeed::without_wall_contact(Vec2 velocity, const Person& person, double step_s) const {
  const auto excess = [&](const WallPoint& wall, Vec2 v) {
    const double gap_m = std::max(wall.distance_m - person.radius_m, 0.0);
    return -toolkit::dot(v, wall.away) - gap_m / step_s;
  };
  Vec2 kept = velocity;
  for (const WallPoint& wall : wall_points_) kept += wall.away * std::max(excess(wall, kept), 0.0);
  // in a corner, the correction for one wall may lead into another
  constexpr double rounding_m_s = 1e-9;
  for (const WallPoint& wall : wall_points_)
    if (excess(wall, kept) > rounding_m_s) return {0.0, 0.0};
  return kept;
}

}  // namespace dmrp::pedestrians
