// SPDX-License-Identifier: MIT
// solid_motion.hpp: bodies that cannot move through each other or through walls.
#pragma once

#include <dmrp/values.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/scene/broad_phase.hpp"
#include "core/scene/static_geometry.hpp"
#include "core/world/solid_outlines.hpp"

namespace dmrp::core {

// Motion stops where it would make an overlap deeper than this. The value exceeds contact_depth_m, so that a body that
// keeps pressing against another is in contact with it.
inline constexpr double solid_depth_m = 0.0015;

// The speed at which contact can push a person who stands, m/s.
inline constexpr double max_push_speed = 1.0;

using IndexPairs = std::span<const std::pair<std::uint32_t, std::uint32_t>>;

// One of the four sides of the border, as seen from a point.
struct Wall {
  dmrp_vec2 inward;
  double distance_m;
};
std::array<Wall, 4> walls_around(const StaticGeometry& geometry, dmrp_vec2 point);

// A body and its intended displacement in this step. Bodies are discs unless they have an outline (solid_outlines.hpp).
struct SolidBody {
  enum class ContactResponse {
    stop,    // a robot: obstacles stop it, nobody pushes it
    yield,   // a person: obstacles stop them, other people push them
    ignore,  // a recorded person: nothing stops them, the others keep clear
  };
  dmrp_vec2 position{};
  double radius_m = 0.0;  // of the disc, or of the circle around `position` that contains the outline
  dmrp_vec2 displacement{};
  ContactResponse response = ContactResponse::stop;
};

// Keeps bodies solid: removes the part of each displacement that would deepen an overlap. Where two bodies approach
// each other, both lose the same share of their approach; where one of them ignores contacts, the other takes the whole
// loss. So robots neither push nor are pushed: a body that stands in front of a robot stays where it is.
//
// People push people. Each of two people bears half of the displacement that would press them into each other: a moving
// person slows down, a standing person moves, at most at max_push_speed, and never into a wall or a robot. This is the
// projection onto the admissible velocities of Maury & Venel, A discrete contact model for crowd motion, ESAIM: M2AN 45
// (2011), approximated by sweeps over the constraints. Without it, three people who touch in an arch around a door are
// as rigid as one made of stone, however hard the crowd behind them presses.
//
// A body with an outline also turns. A turn that would deepen an overlap is shortened (by halves, so that bodies that
// turn toward each other lose the same share); what is left of it counts as approach in the gaps that it reduces.
class SolidMotion {
 public:
  // `step_ns`: the duration of one step, for which resolve() gets displacements.
  SolidMotion(std::shared_ptr<const StaticGeometry> geometry, std::int64_t step_ns);

  // Changes displacements and turns so that no overlap becomes deeper than solid_depth_m and deeper ones do not deepen.
  // `outlines` are those of the first bodies; empty if all bodies are discs.
  void resolve(std::span<SolidBody> bodies, std::span<SolidOutline> outlines = {});

  // Finds the pairs that can meet in a step from here, in ascending order. Both functions expect the same bodies in the
  // same order.
  void find_neighbours(std::span<const SolidBody> bodies);
  IndexPairs body_neighbours() const { return body_neighbours_; }
  IndexPairs shape_neighbours() const { return shape_neighbours_; }  // body, shape

 private:
  static constexpr std::uint32_t no_body = 0xFFFFFFFFu;

  // Limits the approach of two bodies along the line between them.
  struct Constraint {
    std::uint32_t a;
    std::uint32_t b;   // no_body: something static
    dmrp_vec2 normal;  // from b toward a
    double allowed_m;
  };

  bool neighbours_are_fresh(std::span<const SolidBody> bodies) const;
  void limit_turns(std::span<const SolidBody> bodies, std::span<SolidOutline> outlines);
  void collect_constraints(std::span<const SolidBody> bodies);
  void collect_outline_constraints(std::span<const SolidBody> bodies);
  void constrain_pair(std::span<const SolidBody> bodies, std::uint32_t a, std::uint32_t b, dmrp_vec2 normal,
                      double gap_m);
  void constrain_beside(std::span<const SolidBody> bodies, std::uint32_t stoppable, std::uint32_t other,
                        dmrp_vec2 normal, double gap_m);
  void constrain(std::uint32_t a, std::uint32_t b, dmrp_vec2 normal, double gap_m);
  double tolerance() const;
  bool sweep_once(std::span<SolidBody> bodies, bool pushing) const;
  void stop_violators(std::span<SolidBody> bodies) const;

  std::shared_ptr<const StaticGeometry> geometry_;
  double max_push_m_;  // in a step
  BodyPairs pairs_;
  std::vector<double> reaches_m_;  // the farthest that each body can move in this step

  // Pairs that can meet as long as no body is farther than reach_m_ from its position at the search.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> body_neighbours_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> shape_neighbours_;
  double reach_m_ = 0.0;
  std::vector<dmrp_vec2> found_at_;
  std::vector<double> found_radii_m_;

  std::vector<Constraint> constraints_;
  SolidOutlines outlines_;
  std::vector<int> halvings_;  // of the turn, by body with an outline
};

}  // namespace dmrp::core
