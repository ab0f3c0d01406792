// SPDX-License-Identifier: MIT
#include "pedestrians/social_force/social_force.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "pedestrians/crowd/wall_push.hpp"
#include "pedestrians/social_force/headway.hpp"

namespace dmrp::pedestrians {

namespace {

// People ignore neighbours farther away than this, m.
constexpr double neighbor_reach_m = 5.0;

// The cells of the grid, m.
constexpr double neighbor_cell_m = 2.0;

// People ignore walls farther from their centre than this, m.
constexpr double wall_reach_m = 1.5;

// The model defines distances for bodies of this radius, m. For other radii, the gap between the bodies counts.
constexpr double reference_radius_m = 0.3;

// Members of a group keep this gap between their bodies, m: 0.8 m between centres of the default radius, Moussaid's d0.
constexpr double group_gap_m = 0.4;

// The cohesion force rises from zero to its full value over this distance, m.
constexpr double cohesion_ramp_m = 0.5;

// The highest speed, relative to the desired speed.
constexpr double speed_cap_factor = 1.3;

// Forces below exp(-negligible_exponent) of the full weight are ignored.
constexpr double negligible_exponent = 5.0;

// The speed of a group over that of people who walk alone: n people walk at 1.26 - 0.04 n m/s at low density (Moussaid et
// al. 2010, figure 2). Groups of more than four, which their figure does not have, walk like four.
double pace_of_group(std::size_t members) {
  const double size = std::clamp(static_cast<double>(members), 1.0, 4.0);
  return (1.26 - 0.04 * size) / (1.26 - 0.04);
}

// The terms of the model as accelerations with weight 1, m/s2.
//
// Moussaid et al.: Experimental study of the behavioural mechanisms underlying self-organization in human crowds,
// Proc. R. Soc. B 276 (2009); groups: The walking behaviour of pedestrian social groups, PLoS ONE 5 (2010).

// The force of a person at `distance_m` along the unit vector `toward`; `approach` is the own velocity minus the
// other's. It decelerates along the direction of interaction and turns to the side away from the other person, to the
// right in an exactly head-on encounter.
Vec2 interaction(const InteractionShape& shape, Vec2 toward, double distance_m, Vec2 approach) {
  const Vec2 direction = shape.lambda * approach + toward;
  const double squared_length = toolkit::squared_norm(direction);
  const double largest_distance_m = negligible_exponent * shape.gamma;
  if (distance_m * distance_m > largest_distance_m * largest_distance_m * squared_length) return {0.0, 0.0};

  const double length = std::sqrt(squared_length);
  const double range_m = shape.gamma * length;
  const double decay = distance_m / range_m;
  const double slowing_width = shape.n_prime * range_m;
  const double turning_width = shape.n * range_m;
  const Vec2 along = direction / length;
  // theta^2 = u + u^2 / 12 + u^3 / 90 + ... with u = 2 - 2 cos(theta). All terms are positive, so this lower bound
  // rules out most people to the side without computing the angle.
  const double cosine = toolkit::dot(along, toward);
  const double u = 2.0 - 2.0 * cosine;
  const double width = std::min(slowing_width, turning_width);
  if (decay + width * width * u * (1.0 + u * (1.0 / 12.0 + u / 90.0)) > negligible_exponent) return {0.0, 0.0};

  const double theta = std::atan2(toolkit::cross(along, toward), cosine);
  const double squared_theta = theta * theta;
  const double slowing = std::exp(-decay - slowing_width * slowing_width * squared_theta);
  const double turning = std::exp(-decay - turning_width * turning_width * squared_theta);
  return -slowing * along + (theta < 0.0 ? turning : -turning) * toolkit::perpendicular(along);
}

// Decelerates a person who walks along `desired` and would have to turn the head by more than a right angle to see the
// group's centre, in proportion to the excess.
Vec2 gaze(Vec2 desired, Vec2 velocity, Vec2 to_center) {
  const double angle =
      std::atan2(std::abs(toolkit::cross(desired, to_center)), toolkit::dot(desired, to_center));  // in [0, pi]
  return -std::max(0.0, angle - 0.5 * toolkit::pi) * velocity;
}

}  // namespace

Descriptor SocialForce::describe() {
  return describe_model("dmrp.pedestrian.social_force", "Social force")
      .summary("people accelerate toward their targets and away from walls, robots and each other")
      .source(
          "Moussaid et al., Proc. R. Soc. B 276 (2009), doi:10.1098/rspb.2009.0405; groups: PLoS ONE 5 (2010), "
          "doi:10.1371/journal.pone.0010047");
}

Status SocialForce::start(const Start& start) {
  const World& world = start.world;
  shape_ = {lambda, gamma, n, n_prime};
  seed_ = start.seed;
  start_people(start, to_robots, neighbor_cell_m);
  groups_.start();
  walls_.start(world.segments(), world->lower, world->upper, wall_reach_m);
  return Status::ok;
}

Status SocialForce::step(const Crowd& crowd, Motions& motions) {
  gather(crowd, [&](std::uint32_t slot, const Person& person) { return ways_.direction(slot, person); });
  groups_.update(crowd.people);

  const double dt = seconds(crowd.dt_ns);
  for (const Walker& walker : walkers_.by_place()) {
    const Person& person = walker.person;
    Vec2 velocity = person.velocity + dt * acceleration(walker, crowd.people);
    if (motion_noise > 0.0) {
      toolkit::Stream chance(seed_, "pedestrian.motion", person.id, crowd.t_ns);
      const double deviation = motion_noise * std::sqrt(dt);
      velocity.x += chance.normal(0.0, deviation);
      velocity.y += chance.normal(0.0, deviation);
    }
    const double speed = toolkit::norm(velocity);
    const double cap = speed_cap_factor * person.desired_speed;
    motions[walker.slot].velocity = speed > cap ? velocity * (cap / speed) : velocity;
  }
  return Status::ok;
}

Vec2 SocialForce::acceleration(const Walker& walker, const Span<Person>& people) {
  const auto& [person, way, slot, robot_weight] = walker;
  double speed = person.desired_speed * pace_of_group(groups_.members(slot).size());
  const Vec2 neighbors = force_of_neighbors(walker, people, speed);
  const Vec2 desired = speed * way;
  const Vec2 drive = (desired - person.velocity) * (desired_weight / relaxation_time);
  return drive + neighbors + force_of_group(walker, people, desired) + force_of_walls(person);
}

// The repulsion from a wall or a body at this gap. It is bounded in an overlap, which the world keeps small.
double SocialForce::repulsion(double gap_m) const {
  const double gaps = gap_m / obstacle_sigma;
  return gaps > negligible_exponent ? 0.0 : obstacle_weight * std::exp(-std::max(gaps, -1.0));
}

// Also reduces `speed` to the value that the bodies ahead permit.
Vec2 SocialForce::force_of_neighbors(const Walker& walker, const Span<Person>& people, double& speed) {
  const auto& [person, way, slot, robot_weight] = walker;
  Vec2 sum = {0.0, 0.0};
  walkers_.visit_neighbors(walker, neighbor_reach_m, [&, &person = person, &way = way](const Neighbor& neighbor) {
    const Body& other = *neighbor.body;
    const double distance_m = std::sqrt(neighbor.squared_distance);
    const Vec2 apart = other.position - person.position;
    const Vec2 toward = apart / distance_m;
    const double reach_m = person.radius_m + other.radius_m;
    const double gap_m = distance_m - reach_m;
    const double model_distance_m = std::max(gap_m + 2.0 * reference_radius_m, 0.01);
    const Vec2 force = interaction(shape_, toward, model_distance_m, person.velocity - other.velocity);
    const bool is_companion = person.group != 0 && other.slot != no_slot && people[other.slot].group == person.group;
    if (!is_companion && !neighbor.is_ignored)
      sum += neighbor.weight * (social_weight * force - repulsion(gap_m) * toward);

    const double following_s = neighbor.weight * time_gap;
    if (gap_m < speed * following_s)
      speed = std::min(speed, headway(way, apart, reach_m, other.velocity) / following_s);
  });
  return sum;
}

// Members of a group slow down for members out of sight behind, approach a group that has spread out, and keep a gap to
// each other.
Vec2 SocialForce::force_of_group(const Walker& walker, const Span<Person>& people, Vec2 desired) const {
  const auto& [person, way, slot, robot_weight] = walker;
  if (person.group == 0) return {0.0, 0.0};
  const Span<std::uint32_t> members = groups_.members(slot);
  if (members.size() < 2) return {0.0, 0.0};
  Vec2 center = {0.0, 0.0};
  Vec2 repulsion_sum = {0.0, 0.0};
  for (const std::uint32_t member : members) {
    const Person& other = people[member];
    center += other.position / static_cast<double>(members.size());
    if (member == slot) continue;
    const double gap_m = toolkit::distance(other.position, person.position) - person.radius_m - other.radius_m;
    if (gap_m < group_gap_m) repulsion_sum += toolkit::normalized(person.position - other.position);
  }
  const Vec2 to_center = center - person.position;
  const double apart_m = toolkit::norm(to_center);
  const double allowed_m = 0.5 * static_cast<double>(members.size() - 1);
  const double cohesion = std::clamp((apart_m - allowed_m) / cohesion_ramp_m, 0.0, 1.0);
  return gaze_weight * gaze(desired, person.velocity, to_center) +
         cohesion_weight * cohesion * toolkit::normalized(to_center) + repulsion_weight * repulsion_sum;
}

Vec2 SocialForce::force_of_walls(const Person& person) {
  walls_.nearest_points(person.position, wall_points_);
  return push_of_walls(wall_points_, obstacle_sigma,
                       [&](double distance_m) { return repulsion(distance_m - person.radius_m); });
}

}  // namespace dmrp::pedestrians
