// SPDX-License-Identifier: MIT
// The walls near a point. Every cell of a uniform grid lists the segments within reach; built once a trial.
#pragma once

#include <cstddef>
#include <cstdint>
#include <dmrp/cpp/plugin_base.hpp>
#include <vector>

namespace dmrp::pedestrians {

// The point of a wall that is nearest to a person.
struct WallPoint {
  Vec2 away;          // unit vector from the wall to the person
  double distance_m;  // between the two
};

class WallGrid {
 public:
  // For people in the world from `lower` to `upper` and walls up to `reach_m` away.
  void start(Span<Segment> segments, Vec2 lower, Vec2 upper, double reach_m);

  // Fills `found` with the nearest point of every segment within reach, in the order of the segments. Skips segments
  // that contain the position, because they have no direction.
  void nearest_points(Vec2 position, std::vector<WallPoint>& found) const;

  // A superset of the segments within reach of the point: indices of segments().
  Span<std::uint32_t> near(Vec2 position) const;
  const std::vector<Segment>& segments() const { return segments_; }

 private:
  std::size_t cell_of(Vec2 position) const;

  std::vector<Segment> segments_;
  Vec2 lower_ = {0.0, 0.0};
  double reach_m_ = 0.0;
  std::int32_t columns_ = 1;
  std::int32_t rows_ = 1;
  std::vector<std::uint32_t> begins_ = {0, 0};  // of every cell in members_, and the end
  std::vector<std::uint32_t> members_;          // segments of the cells, ascending
};

}  // namespace dmrp::pedestrians
