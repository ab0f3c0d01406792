// SPDX-License-Identifier: MIT
#include "core/world/solid_motion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::core {
namespace {

constexpr double neighbour_reach_m = 0.25;     // people walk this far in about 0.2 s, then the search runs again
constexpr double disc_tolerance_m = 1e-7;      // far below the 0.5 mm between solid_depth_m and contact_depth_m
constexpr double outline_tolerance_m = 1e-10;  // polygons stay pressed at the same place: tolerances add up
constexpr int pushing_sweeps = 200;            // in a jam, most steps need about a dozen
constexpr int stopping_sweeps = 100;
constexpr int turn_halvings = 10;  // then the body does not turn in this step

// From b toward a; an arbitrary direction where they coincide.
dmrp_vec2 direction_between(dmrp_vec2 b, dmrp_vec2 a, double distance_m) {
  return distance_m > 0.0 ? (a - b) / distance_m : dmrp_vec2{1.0, 0.0};
}

using ContactResponse = SolidBody::ContactResponse;

// The farthest that a body can move in this step, pushed or not.
double reach_of(const SolidBody& body, double max_push_m) {
  const double own_m = toolkit::norm(body.displacement);
  return body.response == ContactResponse::yield ? std::max(own_m, max_push_m) : own_m;
}

// Adds to a displacement without exceeding the body's reach.
void push(SolidBody& body, dmrp_vec2 change, double max_push_m) {
  const double at_most_m = reach_of(body, max_push_m);
  body.displacement += change;
  const double length_m = toolkit::norm(body.displacement);
  if (length_m > at_most_m) body.displacement = body.displacement * (at_most_m / length_m);
}

}  // namespace

std::array<Wall, 4> walls_around(const StaticGeometry& geometry, dmrp_vec2 point) {
  return {{{{1.0, 0.0}, point.x - geometry.lower().x},
           {{-1.0, 0.0}, geometry.upper().x - point.x},
           {{0.0, 1.0}, point.y - geometry.lower().y},
           {{0.0, -1.0}, geometry.upper().y - point.y}}};
}

SolidMotion::SolidMotion(std::shared_ptr<const StaticGeometry> geometry, std::int64_t step_ns)
    : geometry_(std::move(geometry)), max_push_m_(max_push_speed * static_cast<double>(step_ns) / 1e9) {
  assert(geometry_ && step_ns > 0);
}

void SolidMotion::resolve(std::span<SolidBody> bodies, std::span<SolidOutline> outlines) {
  assert(outlines.size() <= bodies.size());
  find_neighbours(bodies);
  limit_turns(bodies, outlines);
  collect_constraints(bodies);
  for (int sweep = 0; sweep < pushing_sweeps; ++sweep)
    if (sweep_once(bodies, true)) return;
  for (int sweep = 0; sweep < stopping_sweeps; ++sweep)
    if (sweep_once(bodies, false)) return;
  stop_violators(bodies);
}

bool SolidMotion::neighbours_are_fresh(std::span<const SolidBody> bodies) const {
  if (bodies.size() != found_at_.size()) return false;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double moved_m = toolkit::distance(bodies[i].position, found_at_[i]);
    if (bodies[i].radius_m != found_radii_m_[i] || moved_m + reaches_m_[i] > reach_m_) return false;
  }
  return true;
}

void SolidMotion::find_neighbours(std::span<const SolidBody> bodies) {
  reaches_m_.clear();
  for (const SolidBody& body : bodies) reaches_m_.push_back(reach_of(body, max_push_m_));
  if (neighbours_are_fresh(bodies)) return;

  double furthest_m = 0.0;
  for (const double reach_m : reaches_m_) furthest_m = std::max(furthest_m, reach_m);
  reach_m_ = neighbour_reach_m + furthest_m;
  found_at_.clear();
  found_radii_m_.clear();
  std::vector<double> reaching_radii_m;
  for (const SolidBody& body : bodies) {
    found_at_.push_back(body.position);
    found_radii_m_.push_back(body.radius_m);
    reaching_radii_m.push_back(body.radius_m + neighbour_reach_m + furthest_m);
  }

  // FCL rebuilds its tree when radii change: rounding them up makes changes rare
  for (double& radius : reaching_radii_m) radius = 0.25 * std::ceil(4.0 * radius);
  pairs_.touching(found_at_, reaching_radii_m, body_neighbours_);

  shape_neighbours_.clear();
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    const dmrp_vec2 reach = {reaching_radii_m[i], reaching_radii_m[i]};
    geometry_->shapes_near({found_at_[i] - reach, found_at_[i] + reach}, near);
    for (const std::uint32_t shape : near) shape_neighbours_.emplace_back(i, shape);
  }
}

void SolidMotion::constrain(std::uint32_t a, std::uint32_t b, dmrp_vec2 normal, double gap_m) {
  const double allowed_m = std::max(0.0, gap_m + solid_depth_m);
  if (reaches_m_[a] + (b == no_body ? 0.0 : reaches_m_[b]) > allowed_m)
    constraints_.push_back({a, b, normal, allowed_m});
}

// Beside a body that ignores contacts; `normal` points away from it.
void SolidMotion::constrain_beside(std::span<const SolidBody> bodies, std::uint32_t stoppable, std::uint32_t other,
                                   dmrp_vec2 normal, double gap_m) {
  if (bodies[stoppable].response == ContactResponse::ignore) return;
  const double comes_m = toolkit::dot(bodies[other].displacement, normal);
  const double allowed_m = std::max(0.0, std::max(0.0, gap_m + solid_depth_m) - comes_m);
  if (reaches_m_[stoppable] > allowed_m) constraints_.push_back({stoppable, no_body, normal, allowed_m});
}

void SolidMotion::constrain_pair(std::span<const SolidBody> bodies, std::uint32_t a, std::uint32_t b, dmrp_vec2 normal,
                                 double gap_m) {
  if (bodies[b].response == ContactResponse::ignore)
    constrain_beside(bodies, a, b, normal, gap_m);
  else if (bodies[a].response == ContactResponse::ignore)
    constrain_beside(bodies, b, a, -1.0 * normal, gap_m);
  else
    constrain(a, b, normal, gap_m);
}

// A half-plane that separates two convex bodies on the line of their nearest points keeps them apart for every motion
// that respects it. So no body can jump over another, however fast it moves.
void SolidMotion::collect_constraints(std::span<const SolidBody> bodies) {
  constraints_.clear();
  for (const auto& [body, shape] : shape_neighbours_) {
    if (bodies[body].response == ContactResponse::ignore || !outlines_.is_disc(body)) continue;
    const SurfaceDistance surface = geometry_->distance_to(shape, bodies[body].position);
    constrain(body, no_body, surface.outward, surface.distance_m - bodies[body].radius_m);
  }
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].response == ContactResponse::ignore || !outlines_.is_disc(i)) continue;
    for (const Wall& wall : walls_around(*geometry_, bodies[i].position))
      constrain(i, no_body, wall.inward, wall.distance_m - bodies[i].radius_m);
  }
  for (const auto& [a, b] : body_neighbours_) {
    if (!outlines_.is_disc(a) || !outlines_.is_disc(b)) continue;
    const double distance_m = toolkit::distance(bodies[b].position, bodies[a].position);
    const dmrp_vec2 normal = direction_between(bodies[b].position, bodies[a].position, distance_m);
    constrain_pair(bodies, a, b, normal, distance_m - bodies[a].radius_m - bodies[b].radius_m);
  }
  if (!outlines_.all_discs()) collect_outline_constraints(bodies);
}

void SolidMotion::collect_outline_constraints(std::span<const SolidBody> bodies) {
  const auto constrain_all = [&](std::uint32_t body, std::span<const Gap> gaps) {
    for (const Gap& gap : gaps) constrain(body, no_body, gap.normal, gap.gap_m - gap.a_growth_m);
  };
  for (const auto& [body, shape] : shape_neighbours_)
    if (!outlines_.is_disc(body)) constrain_all(body, outlines_.to_shape(bodies, body, geometry_->sdk_shapes()[shape]));
  for (std::uint32_t i = 0; i < bodies.size(); ++i)
    if (!outlines_.is_disc(i)) constrain_all(i, outlines_.to_border(bodies, i, *geometry_));
  for (const auto& [a, b] : body_neighbours_) {
    if (outlines_.is_disc(a) && outlines_.is_disc(b)) continue;
    for (const Gap& gap : outlines_.between(bodies, a, b))
      constrain_pair(bodies, a, b, gap.normal, gap.gap_m - gap.a_growth_m - gap.b_growth_m);
  }
}

// Halves the turns that would close a gap until none does.
void SolidMotion::limit_turns(std::span<const SolidBody> bodies, std::span<SolidOutline> outlines) {
  halvings_.assign(outlines.size(), 0);
  std::vector<std::uint32_t> growing;
  const auto note_growth = [&](std::uint32_t a, std::uint32_t b, std::span<const Gap> gaps) {
    for (const Gap& gap : gaps) {
      if (gap.a_growth_m + gap.b_growth_m <= std::max(0.0, gap.gap_m + solid_depth_m)) continue;
      if (gap.a_growth_m > 0.0) growing.push_back(a);
      if (gap.b_growth_m > 0.0) growing.push_back(b);
    }
  };
  do {
    outlines_.place(bodies, outlines);
    growing.clear();
    if (outlines_.all_discs()) return;
    for (const auto& [body, shape] : shape_neighbours_)
      if (!outlines_.is_disc(body))
        note_growth(body, no_body, outlines_.to_shape(bodies, body, geometry_->sdk_shapes()[shape]));
    for (std::uint32_t i = 0; i < outlines.size(); ++i)
      if (!outlines_.is_disc(i)) note_growth(i, no_body, outlines_.to_border(bodies, i, *geometry_));
    for (const auto& [a, b] : body_neighbours_)
      if (!outlines_.is_disc(a) || !outlines_.is_disc(b)) note_growth(a, b, outlines_.between(bodies, a, b));
    std::sort(growing.begin(), growing.end());
    growing.erase(std::unique(growing.begin(), growing.end()), growing.end());
    for (const std::uint32_t body : growing)
      outlines[body].turn_rad = ++halvings_[body] > turn_halvings ? 0.0 : 0.5 * outlines[body].turn_rad;
  } while (!growing.empty());
}

double SolidMotion::tolerance() const {
  return outlines_.all_discs() ? disc_tolerance_m : outline_tolerance_m;
}

// One pass over all constraints. Returns whether all of them held.
bool SolidMotion::sweep_once(std::span<SolidBody> bodies, bool pushing) const {
  bool all_held = true;
  const double tolerated_m = tolerance();
  for (const Constraint& constraint : constraints_) {
    SolidBody& a = bodies[constraint.a];
    SolidBody* b = constraint.b == no_body ? nullptr : &bodies[constraint.b];
    const double a_comes_m = -toolkit::dot(a.displacement, constraint.normal);
    const double b_comes_m = b == nullptr ? 0.0 : toolkit::dot(b->displacement, constraint.normal);
    const double excess_m = a_comes_m + b_comes_m - constraint.allowed_m;
    if (excess_m <= tolerated_m) continue;
    all_held = false;
    if (pushing && b != nullptr && a.response == ContactResponse::yield && b->response == ContactResponse::yield) {
      push(a, constraint.normal * (0.5 * excess_m), max_push_m_);
      push(*b, constraint.normal * (-0.5 * excess_m), max_push_m_);
      continue;
    }
    // the approaching body loses approach; a receding body makes room
    const double room_m = constraint.allowed_m - std::min(a_comes_m, 0.0) - std::min(b_comes_m, 0.0);
    const double approach_m = std::max(a_comes_m, 0.0) + std::max(b_comes_m, 0.0);
    const double lost_share = 1.0 - room_m / approach_m;
    a.displacement += constraint.normal * (lost_share * std::max(a_comes_m, 0.0));
    if (b != nullptr) b->displacement -= constraint.normal * (lost_share * std::max(b_comes_m, 0.0));
  }
  return all_held;
}

// Stops, for this step, the bodies that still violate a constraint after all sweeps; that can make others violate one.
void SolidMotion::stop_violators(std::span<SolidBody> bodies) const {
  bool stopped = true;
  while (stopped) {
    stopped = false;
    for (const Constraint& constraint : constraints_) {
      double approach_m = -toolkit::dot(bodies[constraint.a].displacement, constraint.normal);
      if (constraint.b != no_body) approach_m += toolkit::dot(bodies[constraint.b].displacement, constraint.normal);
      if (approach_m <= constraint.allowed_m + tolerance()) continue;
      bodies[constraint.a].displacement = {0.0, 0.0};
      if (constraint.b != no_body) bodies[constraint.b].displacement = {0.0, 0.0};
      stopped = true;
    }
  }
}

}  // namespace dmrp::core
