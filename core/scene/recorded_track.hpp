// SPDX-License-Identifier: MIT
// track.hpp: somebody's recorded way.
#pragma once

#include <dmrp/values.h>

#include <cstdint>
#include <vector>

namespace dmrp::core {

// Times grow; at least one point. Straight and at one speed from a point to the next.
struct Track {
  struct Point {
    std::int64_t t_ns = 0;
    dmrp_vec2 position{};
  };
  std::vector<Point> points;
};

// From the first point's time to the last one's.
bool is_on_track(const Track& track, std::int64_t t_ns);

// The first or last point's before and after.
dmrp_vec2 position_on(const Track& track, std::int64_t t_ns);

// Along the piece that begins at or before this time; zero before, after and where there is but one point.
dmrp_vec2 velocity_on(const Track& track, std::int64_t t_ns);

// Length by time, m/s; 0 where there is but one point.
double mean_speed(const Track& track);

}  // namespace dmrp::core
