// SPDX-License-Identifier: MIT
// lattice.hpp: the state lattice (x, y, heading) and the unicycle motion primitives between its states.
//
// Headings are the 16 directions of the lattice vectors (1,0), (2,1), (1,1), (1,2), ..., not multiples of 22.5 degrees.
// Straight motions then follow their heading exactly, and a motion of one straight piece and one arc ends exactly on a
// lattice state. Tables of motion primitives with equal angles (SBPL) are distorted to achieve this.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "controllers/motion/unicycle.hpp"

namespace dmrp::controllers::e3mop {

inline constexpr int direction_count = 16;

// The direction of the lattice vector (dx, dy); numbered counter-clockwise from +x.
struct Direction {
  int dx;
  int dy;
  double theta;
  Vec2 unit;
};

const std::array<Direction, direction_count>& directions();

// The index of the direction nearest to an angle.
int nearest_direction(double theta);

enum class MotionKind : std::uint8_t { short_forward, long_forward, arc, turn };

// Costs are times in units of 0.1 ms: sums and comparisons of integers are exact.
using Ticks = std::int32_t;
inline constexpr double ticks_per_s = 1e4;

// A motion primitive from one heading at (0, 0) to another at (dx, dy), in cells: a straight piece, an arc, a straight
// piece; or a turn in place. `cost` is the travel time at the robot's limits, weighted by the kind of motion.
struct Motion {
  MotionKind kind;
  std::int32_t dx;
  std::int32_t dy;
  std::int32_t to_heading;
  double length_m;
  double radius_m;  // of the arc; infinite if there is none
  Ticks cost;
  std::uint32_t first_sample;
  std::uint32_t sample_count;
  // Bit k: the search drops the motion if the shortest path to the goal leaves the cell in direction k. Set if
  // |(alpha - theta) - (beta - theta)| > pi/4 for this direction alpha, the direction beta of (dx, dy) and the heading
  // theta. Never set for short forward motions and turns: they keep the search complete.
  std::uint16_t dropped_for;
};

// All motions of a robot. Forward only: a robot that turns in place needs no reverse.
class MotionSet {
 public:
  // Arcs at full speed have a radius of at least v_max / omega_max; tighter arcs are driven at the speed that omega_max
  // allows.
  void build(const Limits& limits, double resolution_m);

  struct Range {
    const Motion* first;
    const Motion* last;
    const Motion* begin() const { return first; }
    const Motion* end() const { return last; }
  };
  Range from(int heading) const {
    const auto h = static_cast<std::size_t>(heading);
    return {motions_.data() + begins_[h], motions_.data() + begins_[h + 1]};
  }
  const Motion& at(std::size_t index) const { return motions_[index]; }
  std::size_t index_of(const Motion& motion) const { return static_cast<std::size_t>(&motion - motions_.data()); }
  // Poses along the motions, relative to the motion's start; without the start, with the end.
  const std::vector<DirectedPoint>& samples() const { return samples_; }
  double resolution_m() const { return resolution_m_; }

 private:
  void add_straight(int heading, int steps, MotionKind kind);
  void add_turn(int heading, int to_heading);
  void add_arc(int heading, int to_heading, double radius_min_m, double radius_max_m);
  void add(int heading, Motion motion, double before_m, double after_m);
  double cost_s(const Motion& motion, double turn, double straight_m) const;

  double resolution_m_ = 0.1;
  double v_max_ = 0.0;
  double omega_max_ = 0.0;
  std::vector<Motion> motions_;  // by heading
  std::array<std::size_t, direction_count + 1> begins_{};
  std::vector<DirectedPoint> samples_;
};

}  // namespace dmrp::controllers::e3mop
