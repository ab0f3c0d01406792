// SPDX-License-Identifier: MIT
#include "core/population.hpp"

#include <cmath>
#include <dmrp/toolkit/polyline.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/rectangle.hpp>
#include <stdexcept>
#include <string>

namespace dmrp::core {
namespace {

using toolkit::Stream;

constexpr double personal_gap_m = 0.05;    // between two who begin
constexpr double lane_half_width_m = 1.5;  // how far aside of the route people begin
constexpr int tries_along_flow = 64;
constexpr int tries_anywhere = 2000;
constexpr int tries_in_region = 32;
constexpr std::int64_t retry_period_ns = 500'000'000;

dmrp_vec2 draw_in(Stream& stream, dmrp_vec2 lower, dmrp_vec2 upper) {
  const double x = stream.uniform(lower.x, upper.x);
  return {x, stream.uniform(lower.y, upper.y)};
}

// A place on a route of several legs.
struct RoutePlace {
  dmrp_vec2 point{};
  double heading = 0.0;
  std::uint32_t leg = 0;
};

RoutePlace place_on(const std::vector<Route>& legs, double fraction) {
  double left_m = 0.0;
  for (const Route& leg : legs) left_m += toolkit::length(leg);
  left_m *= fraction;
  for (std::uint32_t i = 0;; ++i) {
    const std::vector<double> arcs = toolkit::arc_lengths(legs[i]);
    if (left_m <= arcs.back() || i + 1 == legs.size())
      return {toolkit::point_at(legs[i], arcs, left_m), toolkit::heading_at(legs[i], arcs, left_m, 0.0), i};
    left_m -= arcs.back();
  }
}

}  // namespace

Population::Population(const Scenario& scenario, std::shared_ptr<const StaticGeometry> geometry,
                       const FlowRoutes& routes, std::uint64_t seed, std::span<const dmrp_vec2> robots)
    : seed_(seed),
      settings_(scenario.people),
      regions_(scenario.regions),
      flows_(scenario.flows),
      geometry_(std::move(geometry)),
      slots_(person_count(scenario)),
      people_(slots_.size()) {
  std::uint32_t slot = 0;
  for (std::uint32_t flow = 0; flow < flows_.size(); ++flow) {
    for (std::uint32_t place = 0; place < flows_[flow].people; ++place, ++slot) {
      slots_[slot].flow = flow;
      place_along_flow(slot, place, routes.legs[flow], robots);
    }
  }
}

void Population::move(std::uint32_t slot, dmrp_vec2 position, dmrp_vec2 velocity) {
  people_[slot].position = position;
  people_[slot].velocity = velocity;
}

void Population::advance(std::int64_t t_ns, std::span<const dmrp_vec2> robots) {
  for (std::uint32_t slot = 0; slot < slots_.size(); ++slot) {
    Slot& own = slots_[slot];
    const dmrp_person& person = people_[slot];
    const bool is_last_leg = own.leg + 2 == flows_[own.flow].regions.size();
    const bool arrived = toolkit::contains(toolkit::Rectangle{person.area_lower, person.area_upper}, person.position);
    if (arrived && !is_last_leg) {
      ++own.leg;
      set_target(slot);
    } else if ((arrived || own.tries > 0) && t_ns >= own.next_try_ns) {
      try_to_begin_anew(slot, t_ns, robots);
    }
  }
}

// Evenly along the whole route, each somewhere in a stretch of its own and somewhere aside of it.
void Population::place_along_flow(std::uint32_t slot, std::uint32_t place, const std::vector<Route>& legs,
                                  std::span<const dmrp_vec2> robots) {
  Stream stream(seed_, "population.begin", slot);
  for (int tries = 0; tries < tries_along_flow; ++tries) {
    const double fraction = (place + stream.uniform()) / flows_[slots_[slot].flow].people;
    const double aside_m = stream.uniform(-lane_half_width_m, lane_half_width_m);
    const RoutePlace on_route = place_on(legs, fraction);
    const dmrp_vec2 left = toolkit::perpendicular(toolkit::from_angle(on_route.heading));
    const dmrp_vec2 point = on_route.point + aside_m * left;
    // not beyond a wall
    if (!has_room(slot, slot, point, robots) || !geometry_->line_of_sight(on_route.point, point)) continue;
    return begin(slot, point, on_route.leg);
  }
  for (int tries = 0; tries < tries_anywhere; ++tries) {
    const RoutePlace on_route = place_on(legs, stream.uniform());
    const dmrp_vec2 reach = {4.0 * lane_half_width_m, 4.0 * lane_half_width_m};
    const dmrp_vec2 point = draw_in(stream, on_route.point - reach, on_route.point + reach);
    if (!has_room(slot, slot, point, robots) || !geometry_->line_of_sight(on_route.point, point)) continue;
    return begin(slot, point, on_route.leg);
  }
  throw std::runtime_error("no room along flow '" + flows_[slots_[slot].flow].name + "' for person " +
                           std::to_string(slot));
}

void Population::begin(std::uint32_t slot, dmrp_vec2 position, std::uint32_t leg) {
  Slot& own = slots_[slot];
  own.leg = leg;
  own.tries = 0;
  own.next_try_ns = 0;
  dmrp_person& person = people_[slot];
  person = {};
  person.id = slot + own.predecessors * slots_.size();
  person.position = position;
  person.radius_m = settings_.radius_m;
  Stream speeds(seed_, "population.speed", slot, own.predecessors);
  person.desired_speed =
      speeds.truncated_normal(settings_.speed_mean, settings_.speed_sd, settings_.speed_min, settings_.speed_max);
  set_target(slot);
}

// Somewhere free in the region that the leg leads to; in its middle where nothing free was found.
void Population::set_target(std::uint32_t slot) {
  const Slot& own = slots_[slot];
  const std::uint32_t index = flows_[own.flow].regions[own.leg + 1];
  const Region& region = regions_[index];
  Stream stream(seed_, "population.target", slot, own.predecessors, own.leg);
  dmrp_vec2 target = draw_in(stream, region.lower, region.upper);
  int tries = 1;
  for (; tries < tries_in_region && !geometry_->disc_is_free(target, settings_.radius_m); ++tries)
    target = draw_in(stream, region.lower, region.upper);
  if (tries == tries_in_region) target = 0.5 * (region.lower + region.upper);

  dmrp_person& person = people_[slot];
  person.target = target;
  person.target_id = index;
  person.area_lower = region.lower;
  person.area_upper = region.upper;
}

// Until there is room in the first region, the old person stays and walks on to its target.
void Population::try_to_begin_anew(std::uint32_t slot, std::int64_t t_ns, std::span<const dmrp_vec2> robots) {
  Slot& own = slots_[slot];
  const Region& first = regions_[flows_[own.flow].regions.front()];
  Stream stream(seed_, "population.anew", slot, own.predecessors, own.tries);
  for (int tries = 0; tries < tries_in_region; ++tries) {
    const dmrp_vec2 point = draw_in(stream, first.lower, first.upper);
    if (!has_room(slot, static_cast<std::uint32_t>(people_.size()), point, robots)) continue;
    ++own.predecessors;
    return begin(slot, point, 0);
  }
  ++own.tries;
  own.next_try_ns = t_ns + retry_period_ns;
}

// Clear of shapes, robots, and the first `others` people.
bool Population::has_room(std::uint32_t slot, std::uint32_t others, dmrp_vec2 point,
                          std::span<const dmrp_vec2> robots) const {
  for (const dmrp_vec2 robot : robots)
    if (toolkit::distance(robot, point) < spawn_distance_to_robots_m) return false;
  const double apart_m = 2.0 * settings_.radius_m + personal_gap_m;
  for (std::uint32_t other = 0; other < others; ++other)
    if (other != slot && toolkit::distance(people_[other].position, point) < apart_m) return false;
  return geometry_->disc_is_free(point, settings_.radius_m);
}

}  // namespace dmrp::core
