// SPDX-License-Identifier: MIT
// cpp/path.hpp: a path as a span of waypoints; the contract is in ../path.h.
#pragma once

#include "../path.h"
#include "span.hpp"

namespace dmrp {

using Waypoint = dmrp_waypoint;

// Valid as long as the waypoints of the dmrp_path.
class Path : public Span<Waypoint> {
 public:
  explicit Path(const dmrp_path& c) : Span(c.waypoints, c.count, c.stride) {}
};

}  // namespace dmrp
