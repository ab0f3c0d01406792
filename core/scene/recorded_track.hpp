// SPDX-License-Identifier: MIT
// recorded_track.hpp: the recorded track of a person.
#pragma once

#include <dmrp/values.h>

#include <cstdint>
#include <vector>

namespace dmrp::core {

// At least one point; times increase strictly. Between points the person moves in a straight line at constant speed.
struct Track {
  struct Point {
    std::int64_t t_ns = 0;
    dmrp_vec2 position{};
  };
  std::vector<Point> points;
};

// Whether the time is between those of the first and the last point.
bool is_on_track(const Track& track, std::int64_t t_ns);

// Before the first point's time its position, after the last point's time that of the last point.
dmrp_vec2 position_on(const Track& track, std::int64_t t_ns);

// The velocity of the segment that begins at or before this time; zero before, after, and if there is only one point.
dmrp_vec2 velocity_on(const Track& track, std::int64_t t_ns);

// Length divided by duration, m/s; 0 if there is only one point.
double mean_speed(const Track& track);

}  // namespace dmrp::core
