// SPDX-License-Identifier: MIT
// lattice.hpp: the state lattice (x, y, heading) and the unicycle motions that join its states.
//
// Headings are the 16 directions of the lattice vectors (1,0), (2,1), (1,1), (1,2), ... and not multiples of 22.5
// degrees: straight motions then follow their heading exactly, and a curve that is one straight piece and one arc ends
// exactly on a lattice state, without the distortion that tables of motion primitives (SBPL) have to accept.
#ifndef DMRP_CONTROLLERS_E3MOP_LATTICE_HPP
#define DMRP_CONTROLLERS_E3MOP_LATTICE_HPP

#include <dmrp/robot.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dmrp::controllers::e3mop {

inline constexpr int direction_count = 16;

// One of the lattice's directions: that of the vector (dx, dy), counted counter-clockwise from +x.
struct Direction {
  int dx;
  int dy;
  double theta;
  double cos_theta;
  double sin_theta;
};

const std::array<Direction, direction_count>& directions();

// The index of the direction nearest to an angle.
int nearest_direction(double theta);

enum class MotionKind : std::uint8_t { short_forward, long_forward, arc, turn };

// Costs, which are times, in units of 0.1 ms, so that sums and comparisons are exact.
using Ticks = std::int32_t;
inline constexpr double ticks_per_s = 1e4;

// A place on the way of a motion, relative to the motion's start, in metres.
struct MotionSample {
  double x;
  double y;
  double cos_theta;
  double sin_theta;
};

// A motion primitive: from a heading at (0, 0) to another one at (dx, dy), in cells: straight, then an arc, then
// straight; or a turn in place. `cost` is its travel time at the limits, weighted by its kind.
struct Motion {
  MotionKind kind;
  std::int32_t dx;
  std::int32_t dy;
  std::int32_t to_heading;
  double length_m;
  double radius_m;  // of the arc; infinite where there is none
  Ticks cost;
  std::uint32_t first_sample;
  std::uint32_t sample_count;
  // Bit k: dropped where the way to the goal leaves the cell in direction k. |(alpha - theta) - (beta - theta)| > pi/4
  // with alpha that direction, beta the one of (dx, dy), theta the heading; never set for the shortest step ahead and
  // for turns, which keep the search complete.
  std::uint16_t dropped_for;
};

// All motions of a robot. Forward only: what turns in place needs no reverse.
class MotionSet {
 public:
  // Full-speed arcs have a radius of v_max / omega_max at least; tighter ones are driven as fast as omega_max lets
  // them.
  void build(const dmrp_limits& limits, double resolution_m);

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
  const std::vector<MotionSample>& samples() const { return samples_; }  // the start is none; the end is the last one
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
  std::vector<MotionSample> samples_;
};

}  // namespace dmrp::controllers::e3mop

#endif
