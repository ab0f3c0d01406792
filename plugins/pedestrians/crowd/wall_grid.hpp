// SPDX-License-Identifier: MIT
// The walls near a point: every cell of a uniform grid knows the segments within reach of it. Built once a trial.
#pragma once

#include <dmrp/values.h>

#include <cstddef>
#include <cstdint>
#include <dmrp/cpp/span.hpp>
#include <vector>

namespace dmrp::pedestrians {

// The point of a wall that is nearest to somebody.
struct WallPoint {
  dmrp_vec2 away;     // unit vector from the wall to whom asked
  double distance_m;  // between the two
};

class WallGrid {
 public:
  // Points of walls up to `reach_m` away are found, for people in the world from `lower` to `upper`.
  void start(Span<dmrp_segment> segments, dmrp_vec2 lower, dmrp_vec2 upper, double reach_m);

  // Fills `found` with the nearest point of every segment within reach, in the order of the segments. Segments that
  // the person stands upon have no direction and are left out.
  void nearest_points(dmrp_vec2 position, std::vector<WallPoint>& found) const;

  // The segments that can be within reach of the point: indices into segments().
  Span<std::uint32_t> near(dmrp_vec2 position) const;
  const std::vector<dmrp_segment>& segments() const { return segments_; }

 private:
  std::size_t cell_of(dmrp_vec2 position) const;

  std::vector<dmrp_segment> segments_;
  dmrp_vec2 lower_ = {0.0, 0.0};
  double reach_m_ = 0.0;
  std::int32_t columns_ = 1;
  std::int32_t rows_ = 1;
  std::vector<std::uint32_t> begins_ = {0, 0};  // of every cell in members_, and the end
  std::vector<std::uint32_t> members_;          // segments of the cells, ascending
};

}  // namespace dmrp::pedestrians
