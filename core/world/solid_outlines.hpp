// SPDX-License-Identifier: MIT
// solid_outlines.hpp: the gaps around solid bodies that are not discs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/settings.hpp"
#include "core/scene/static_geometry.hpp"

namespace dmrp::core {

struct SolidBody;

// The outline of a body that is not a disc, and its intended turn in this step.
struct SolidOutline {
  std::span<const ConvexPolygon> parts;  // in the body's frame; empty: the body is a disc
  double theta = 0.0;
  double turn_rad = 0.0;
};

// The gap between a part of body `a` and something else, `b`.
struct Gap {
  dmrp_vec2 normal{};       // unit, from b toward a
  double gap_m = 0.0;       // along the normal; negative: they overlap
  double a_growth_m = 0.0;  // by which the turn of a reduces the gap
  double b_growth_m = 0.0;
};

// Places the outlines of bodies in the world, at their headings before and after the intended turns.
class SolidOutlines {
 public:
  // `outlines` are those of the first bodies; the other bodies are discs.
  void place(std::span<const SolidBody> bodies, std::span<const SolidOutline> outlines);

  bool all_discs() const { return placed_.empty(); }
  bool is_disc(std::uint32_t body) const { return body >= placed_.size() || placed_[body].empty(); }

  // The gaps around a body that is not a disc: one for each pair of parts, or part and wall. Valid until the next call.
  std::span<const Gap> to_shape(std::span<const SolidBody> bodies, std::uint32_t a, const dmrp_shape& shape);
  std::span<const Gap> to_border(std::span<const SolidBody> bodies, std::uint32_t a, const StaticGeometry& geometry);

  // Between two bodies, at least one of which is not a disc.
  std::span<const Gap> between(std::span<const SolidBody> bodies, std::uint32_t a, std::uint32_t b);

 private:
  struct Part {
    ConvexPolygon now;
    ConvexPolygon turned;
  };

  static double growth(const Part& part, dmrp_vec2 position, dmrp_vec2 direction);

  std::vector<std::vector<Part>> placed_;  // empty if all bodies are discs
  std::vector<Gap> gaps_;
};

}  // namespace dmrp::core
