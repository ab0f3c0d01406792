// SPDX-License-Identifier: MIT
#include "tests/unit/pedestrians/walking_world.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/segment.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>
#include <utility>

namespace dmrp::test {

namespace {

constexpr double walking_radius_m = 0.3;

// As in a later version of the contract: models must use the stride.
struct LongerMotion {
  dmrp_motion motion;
  double later_field;
};

void add_outline(const Box& box, std::vector<dmrp_segment>& segments) {
  const dmrp_vec2 corners[] = {box.lower, {box.upper.x, box.lower.y}, box.upper, {box.lower.x, box.upper.y}};
  for (int i = 0; i < 4; ++i) segments.push_back({corners[i], corners[(i + 1) % 4]});
}

// Removes the part of a velocity that leads toward an obstacle.
void cancel(dmrp_vec2& velocity, dmrp_vec2 toward) {
  const double closing = toolkit::dot(velocity, toward);
  if (closing > 0.0) velocity -= closing * toward;
}

}  // namespace

double distance_to_box(const Box& box, dmrp_vec2 point) {
  const dmrp_vec2 nearest = {std::clamp(point.x, box.lower.x, box.upper.x),
                             std::clamp(point.y, box.lower.y, box.upper.y)};
  return toolkit::distance(nearest, point);
}

WalkingWorld::WalkingWorld(dmrp_vec2 size, std::vector<Box> boxes, double cell_m)
    : size_(size), boxes_(std::move(boxes)) {
  for (const Box& box : boxes_) add_outline(box, segments_);
  add_outline({{0.0, 0.0}, size_}, segments_);
  rasterise(cell_m);
  world_.struct_size = sizeof(world_);
  world_.upper = size_;
  world_.step_ns = 20'000'000;
  world_.control_period_ns = 100'000'000;
  world_.segments = segments_.data();
  world_.segment_count = static_cast<uint32_t>(segments_.size());
  world_.person_radius_m = walking_radius_m;
  world_.planning_grid = &grid_;
}

double WalkingWorld::clearance(dmrp_vec2 point) const {
  double nearest = std::min(std::min(point.x, size_.x - point.x), std::min(point.y, size_.y - point.y));
  for (const Box& box : boxes_) nearest = std::min(nearest, distance_to_box(box, point));
  return nearest;
}

void WalkingWorld::rasterise(double cell_m) {
  grid_.struct_size = sizeof(grid_);
  grid_.width = static_cast<uint32_t>(std::lround(size_.x / cell_m));
  grid_.height = static_cast<uint32_t>(std::lround(size_.y / cell_m));
  grid_.resolution_m = cell_m;
  const toolkit::GridView view(grid_);
  for (uint32_t cell = 0; cell < view.size(); ++cell) {
    const double at_center = clearance(view.center(cell));
    clearance_.push_back(static_cast<float>(at_center));
    free_.push_back(at_center >= walking_radius_m);
  }
  for (uint32_t cell = 0; cell < view.size(); ++cell) {
    const auto is_free = [&](int direction) {
      const uint32_t beside = view.neighbour(cell, direction & 7);
      return beside != toolkit::no_cell && free_[beside];
    };
    uint8_t edges = 0;
    for (int d = 0; d < toolkit::direction_count; ++d)
      if (free_[cell] && is_free(d) && (!toolkit::is_diagonal(d) || (is_free(d - 1) && is_free(d + 1))))
        edges = static_cast<uint8_t>(edges | 1 << d);
    edges_.push_back(edges);
  }
  grid_.free = free_.data();
  grid_.edges = edges_.data();
  grid_.clearance = clearance_.data();
}

dmrp_person person(uint64_t id, dmrp_vec2 position, dmrp_vec2 target, double desired_speed) {
  dmrp_person made{};
  made.id = id;
  made.target_id = static_cast<uint32_t>(id);
  made.position = position;
  made.radius_m = 0.3;
  made.desired_speed = desired_speed;
  made.target = target;
  made.area_lower = {target.x - 0.2, target.y - 0.2};
  made.area_upper = {target.x + 0.2, target.y + 0.2};
  return made;
}

dmrp_agent robot(uint64_t id, dmrp_vec2 position, dmrp_vec2 velocity, double radius_m) {
  dmrp_agent made{};
  made.id = id;
  made.kind = DMRP_AGENT_ROBOT;
  made.pose = {position.x, position.y, 0.0};
  made.velocity = velocity;
  made.radius_m = radius_m;
  return made;
}

bool arrived(const dmrp_person& person) {
  return toolkit::distance(person.position, person.target) < 0.5;
}

bool all_arrived(const std::vector<dmrp_person>& people) {
  return std::all_of(people.begin(), people.end(), arrived);
}

double least_gap(const std::vector<dmrp_person>& people) {
  double least = 100.0;
  for (std::size_t i = 0; i < people.size(); ++i) {
    for (std::size_t j = i + 1; j < people.size(); ++j) {
      const double apart_m = toolkit::distance(people[i].position, people[j].position);
      least = std::min(least, apart_m - people[i].radius_m - people[j].radius_m);
    }
  }
  return least;
}

dmrp_vec2 anywhere(const WalkingWorld& world, toolkit::Stream& chance) {
  dmrp_vec2 point = {0.0, 0.0};
  while (world.clearance(point) < 0.5)
    point = {chance.uniform(0.0, world.c().upper.x), chance.uniform(0.0, world.c().upper.y)};
  return point;
}

std::vector<dmrp_person> random_people(const WalkingWorld& world, uint64_t count, uint64_t seed, double radius_m) {
  toolkit::Stream chance(seed, "people");
  std::vector<dmrp_person> people;
  while (people.size() < count) {
    const dmrp_vec2 at = anywhere(world, chance);
    const bool taken = std::any_of(people.begin(), people.end(), [&](const dmrp_person& other) {
      return toolkit::distance(other.position, at) < 2.0 * radius_m + 0.05;
    });
    if (taken) continue;
    people.push_back(
        person(people.size() + 1, at, anywhere(world, chance), chance.truncated_normal(1.2, 0.2, 0.5, 2.0)));
    people.back().radius_m = radius_m;
  }
  return people;
}

Walk::Walk(const WalkingWorld& world, const std::string& model, ParamOverrides params, uint64_t seed)
    : world_(&world), model_("libdmrp_pedestrians.so", model, std::move(params)) {
  restart(world, seed);
}

void Walk::restart(const WalkingWorld& world, uint64_t seed) {
  world_ = &world;
  step_ = 0;
  walking_grid_ = std::make_unique<GivenWalkingGrid>(world.walking_grid());
  walking_grid_->offer(model_.host());
  REQUIRE(model_.start(world.c(), seed) == DMRP_OK);
}

void Walk::step() {
  dmrp_crowd crowd{};
  crowd.struct_size = sizeof(crowd);
  crowd.person_count = static_cast<uint32_t>(people.size());
  crowd.t_ns = step_ * 20'000'000;
  crowd.dt_ns = 20'000'000;
  crowd.people = people.data();
  crowd.robots = robots.data();
  crowd.person_stride = sizeof(dmrp_person);
  crowd.robot_count = static_cast<uint32_t>(robots.size());
  crowd.robot_stride = sizeof(dmrp_agent);

  const double unwritten = std::numeric_limits<double>::quiet_NaN();
  std::vector<LongerMotion> answer(people.size(), {{{unwritten, unwritten}}, unwritten});
  dmrp_motions motions = {sizeof(motions), crowd.person_count, sizeof(LongerMotion), 0, &answer.data()->motion};
  REQUIRE(model_.as<dmrp_pedestrian_model>().step(model_.self(), &crowd, &motions) == DMRP_OK);
  velocities.clear();
  for (const LongerMotion& each : answer) {
    REQUIRE(std::isnan(each.later_field));
    velocities.push_back(each.motion.velocity);
  }
  for (const dmrp_vec2 velocity : velocities)
    if (!(toolkit::norm(velocity) <= 5.0)) FAIL("a velocity of " << velocity.x << ", " << velocity.y);

  for (std::size_t i = 0; i < people.size(); ++i) people[i].velocity = velocities[i];
  keep_solid();
  for (dmrp_person& p : people) p.position += step_s * p.velocity;
  for (dmrp_agent& r : robots) {
    r.pose.x += step_s * r.velocity.x;
    r.pose.y += step_s * r.velocity.y;
  }
  ++step_;
}

void walk_for(Walk& walk, double duration_s) {
  walk.until(duration_s, [] { return false; });
}

double passing_distance(const std::string& model, ParamOverrides params, const dmrp_agent& in_the_way) {
  const WalkingWorld world({24.0, 10.0}, {});
  Walk walk(world, model, std::move(params));
  walk.people = {person(1, {2.0, 5.0}, {22.0, 5.0})};
  walk.robots = {in_the_way};
  double nearest = 100.0;
  REQUIRE(walk.until(40.0, [&] {
    nearest = std::min(nearest, toolkit::distance(walk.people[0].position, toolkit::position(walk.robots[0].pose)));
    return arrived(walk.people[0]);
  }));
  return nearest;
}

void Walk::keep_solid() {
  for (std::size_t i = 0; i < people.size(); ++i) {
    dmrp_person& p = people[i];
    for (dmrp_person& other : people) {
      if (&other == &p) continue;
      const dmrp_vec2 apart = other.position - p.position;
      if (toolkit::norm(apart) < p.radius_m + other.radius_m) cancel(p.velocity, toolkit::normalized(apart));
    }
    for (const dmrp_agent& r : robots) {
      const dmrp_vec2 apart = toolkit::position(r.pose) - p.position;
      if (toolkit::norm(apart) < p.radius_m + r.radius_m) cancel(p.velocity, toolkit::normalized(apart));
    }
    for (uint32_t s = 0; s < world_->c().segment_count; ++s) {
      const dmrp_vec2 apart = toolkit::closest_point(world_->c().segments[s], p.position) - p.position;
      if (toolkit::norm(apart) < p.radius_m) cancel(p.velocity, toolkit::normalized(apart));
    }
  }
}

}  // namespace dmrp::test
