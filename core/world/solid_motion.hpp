// SPDX-License-Identifier: MIT
// solid_motion.hpp: round bodies that cannot walk through each other or through walls.
#pragma once

#include <dmrp/values.h>

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/scene/broad_phase.hpp"
#include "core/scene/static_geometry.hpp"

namespace dmrp::core {

// Motion is cancelled where it would bring two bodies deeper into each other than this. More than contact_depth_m, so
// that a body that presses on is in contact.
inline constexpr double solid_depth_m = 0.0015;

// How far others push somebody in a step: 1 m/s at the default of 0.02 s.
inline constexpr double pushed_at_most_m = 0.02;

// A disc and where it is about to go in this step.
struct SolidBody {
  enum class Bearing {
    stands_firm,  // a robot: stopped by whatever is in its way, never pushed
    gives_way,    // a person: likewise, but people who press against each other push each other
    unstoppable,  // a recorded person: goes its way whatever is in it, and only others keep clear
  };
  dmrp_vec2 position{};
  double radius_m = 0.0;
  dmrp_vec2 displacement{};
  Bearing bearing = Bearing::stands_firm;
};

// Two bodies, or a body and a shape, that overlap.
struct Overlap {
  std::uint32_t a = 0;  // body
  std::uint32_t b = 0;  // body, shape, or StaticGeometry::border()
  double depth_m = 0.0;
  dmrp_vec2 point{};  // in the middle of the overlap
};

// Keeps bodies solid: a body loses the part of its motion that would deepen an overlap, the rest stays. Where two
// approach each other, both lose the same share of their approach; where one of them is unstoppable, the other loses all
// that is to be lost. So robots neither push nor are pushed: who stands before one keeps standing.
//
// People do push people. Of a motion that would press two of them into each other each bears half: one who goes on is
// held back, one who stands is moved, at most pushed_at_most_m in a step, and never into a wall or a robot. That is the
// projection onto the permitted velocities of Maury & Venel, A discrete contact model for crowd motion, ESAIM: M2AN 45
// (2011), approached by sweeps. Without it, three people who touch in an arch round a door are as rigid as
// one of stone, whoever presses from behind.
class SolidMotion {
 public:
  explicit SolidMotion(std::shared_ptr<const StaticGeometry> geometry);

  // Changes the displacements so that no overlap gets deeper than solid_depth_m, and none that is deeper gets deeper.
  void resolve(std::span<SolidBody> bodies);

  // Overlaps deeper than `depth_m` at the present positions, ordered by a, then b, with a among the first `count`
  // bodies: with shapes, and with bodies. All three functions want the same bodies, in the same order.
  void overlaps_with_shapes(std::span<const SolidBody> bodies, std::uint32_t count, double depth_m,
                            std::vector<Overlap>& found);
  void overlaps_between(std::span<const SolidBody> bodies, std::uint32_t count, double depth_m,
                        std::vector<Overlap>& found);

 private:
  static constexpr std::uint32_t no_body = 0xFFFFFFFFu;

  // How far two may approach along the line between them.
  struct Constraint {
    std::uint32_t a;
    std::uint32_t b;   // no_body: something static
    dmrp_vec2 normal;  // from b toward a
    double allowed_m;
  };

  void find_neighbours(std::span<const SolidBody> bodies);
  bool neighbours_are_fresh(std::span<const SolidBody> bodies) const;
  void collect_constraints(std::span<const SolidBody> bodies);
  void constrain_beside(std::span<const SolidBody> bodies, std::uint32_t stoppable, std::uint32_t other,
                        dmrp_vec2 normal, double gap_m);
  void constrain(std::span<const SolidBody> bodies, std::uint32_t a, std::uint32_t b, dmrp_vec2 normal, double gap_m);
  bool hold(std::span<SolidBody> bodies, bool pushing) const;
  void stop_violators(std::span<SolidBody> bodies) const;

  std::shared_ptr<const StaticGeometry> geometry_;
  BodyPairs pairs_;

  // Who may meet whom as long as no body is further than reach_m_ from where it was when they were found.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> body_neighbours_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> shape_neighbours_;  // body, shape
  double reach_m_ = 0.0;
  std::vector<dmrp_vec2> found_at_;
  std::vector<double> found_radii_m_;

  std::vector<Constraint> constraints_;
};

}  // namespace dmrp::core
