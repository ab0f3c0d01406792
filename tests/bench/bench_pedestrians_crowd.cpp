// SPDX-License-Identifier: MIT
#include "tests/bench/bench_pedestrians_crowd.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/rectangle.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <stdexcept>

#include "core/scene/planning_grid.hpp"

namespace dmrp::bench {

namespace {

constexpr double people_per_m2 = 0.25;
constexpr double block_m = 10.0;  // period of the furniture
constexpr double side_depth_m = 1.5;
constexpr std::int64_t step_ns = 20'000'000;

core::Shape box(dmrp_vec2 lower, dmrp_vec2 upper) {
  core::Shape shape;
  shape.name = "bench";
  shape.vertices = {lower, {upper.x, lower.y}, upper, {lower.x, upper.y}};
  return shape;
}

core::Shape pillar(dmrp_vec2 center) {
  core::Shape shape;
  shape.name = "pillar";
  shape.kind = core::Shape::Kind::circle;
  shape.center = center;
  shape.radius_m = 0.4;
  return shape;
}

core::Scenario furnished_square(std::uint32_t people) {
  core::Scenario scenario;
  const double side_m = std::sqrt(people / people_per_m2);
  scenario.upper = {side_m, side_m};
  for (double y = 0.0; y + 0.6 * block_m < side_m; y += block_m) {
    for (double x = 0.0; x + 0.6 * block_m < side_m; x += block_m) {
      scenario.shapes.push_back(box({x + 2.0, y + 3.0}, {x + 4.0, y + 3.5}));
      scenario.shapes.push_back(pillar({x + 4.8, y + 4.8}));
    }
  }
  scenario.flows = {{"crossing", {}, people}};
  return scenario;
}

}  // namespace

Square::Square(std::uint32_t count)
    : people(count),
      scenario(furnished_square(count)),
      geometry(std::make_shared<const core::StaticGeometry>(scenario)),
      walking_grid(core::build_walking_grid(*geometry, scenario.people.radius_m)),
      view(scenario, {}, {}, *geometry, walking_grid, 0) {}

CrossingCrowd::CrossingCrowd(const Square& square, const std::string& model, std::uint64_t seed)
    : side_m_(square.scenario.upper.x),
      grid_(square.walking_grid.view()),
      walking_grid_(grid_),
      model_("libdmrp_pedestrians.so", model),
      geometry_(square.geometry),
      motion_(geometry_, step_ns) {
  place_people(square, seed);
  motions_.resize(people_.size());
  walking_grid_.offer(model_.host());
  if (model_.start(square.view.world(), seed) != DMRP_OK) throw std::runtime_error(model + " does not start");
}

void CrossingCrowd::place_people(const Square& square, std::uint64_t seed) {
  const core::PeopleSettings settings;
  toolkit::Stream chance(seed, "crowd");
  while (people_.size() < square.people) {
    const double x = chance.uniform(0.0, side_m_);
    const dmrp_vec2 at = {x, chance.uniform(0.0, side_m_)};
    const bool taken = std::any_of(people_.begin(), people_.end(), [&](const dmrp_person& other) {
      return toolkit::distance(other.position, at) < 2.0 * settings.radius_m;
    });
    if (taken || !geometry_->disc_is_free(at, settings.radius_m)) continue;
    dmrp_person person{};
    person.id = people_.size();
    person.position = at;
    person.radius_m = settings.radius_m;
    person.desired_speed =
        chance.truncated_normal(settings.speed_mean, settings.speed_sd, settings.speed_min, settings.speed_max);
    send_to(person, static_cast<std::uint32_t>(person.id % 4));
    people_.push_back(person);
    bodies_.push_back({at, settings.radius_m, {}, core::SolidBody::ContactResponse::yield});
  }
}

// Sides 0 to 3: west, south, east, north. Everybody walks along a straight line.
void CrossingCrowd::send_to(dmrp_person& person, std::uint32_t side) const {
  const double near_m = side < 2 ? 0.0 : side_m_ - side_depth_m;
  const double along_m = side < 2 ? 0.5 : side_m_ - 0.5;
  const bool across_x = side % 2 == 0;
  person.target_id = side;
  person.area_lower = across_x ? dmrp_vec2{near_m, 0.0} : dmrp_vec2{0.0, near_m};
  person.area_upper = across_x ? dmrp_vec2{near_m + side_depth_m, side_m_} : dmrp_vec2{side_m_, near_m + side_depth_m};
  person.target = across_x ? dmrp_vec2{along_m, person.position.y} : dmrp_vec2{person.position.x, along_m};
}

void CrossingCrowd::step_model() {
  dmrp_crowd crowd{};
  crowd.struct_size = sizeof(crowd);
  crowd.person_count = static_cast<std::uint32_t>(people_.size());
  crowd.t_ns = t_ns_;
  crowd.dt_ns = step_ns;
  crowd.people = people_.data();
  crowd.person_stride = sizeof(dmrp_person);
  crowd.robot_stride = sizeof(dmrp_agent);
  dmrp_motions motions = {sizeof(motions), crowd.person_count, sizeof(dmrp_motion), 0, motions_.data()};
  if (model_.as<dmrp_pedestrian_model>().step(model_.self(), &crowd, &motions) != DMRP_OK)
    throw std::runtime_error("a step failed");
}

void CrossingCrowd::move() {
  constexpr double step_s = 1e-9 * step_ns;
  for (std::size_t i = 0; i < people_.size(); ++i) bodies_[i].displacement = motions_[i].velocity * step_s;
  motion_.resolve(bodies_);
  for (std::size_t i = 0; i < people_.size(); ++i) {
    dmrp_person& person = people_[i];
    bodies_[i].position += bodies_[i].displacement;
    person.position = bodies_[i].position;
    person.velocity = bodies_[i].displacement / step_s;
    if (toolkit::contains(toolkit::Rectangle{person.area_lower, person.area_upper}, person.position))
      send_to(person, (person.target_id + 2) % 4);
  }
  t_ns_ += step_ns;
}

}  // namespace dmrp::bench
