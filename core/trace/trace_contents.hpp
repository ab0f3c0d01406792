// SPDX-License-Identifier: MIT
// trace_contents.hpp: what the records of a trace contain, as structs of the plugin contract.
#pragma once

#include <dmrp/plan.h>
#include <dmrp/sample.h>
#include <dmrp/trial_end.h>
#include <dmrp/world.h>

#include <cstdint>
#include <span>
#include <string_view>

#include "core/foxglove/annotation_source.hpp"
#include "core/trace/trace.hpp"

namespace dmrp::core {

struct TraceWorld {
  std::uint32_t format_version = trace_format_version;
  dmrp_world world{};
};

struct TracePlan {
  dmrp_plan plan{};
  std::int64_t made_at_ns = 0;  // simulated time of the sample before the plan
  std::uint32_t conflicts = 0;  // between robots
};

// What a robot was handed to follow: the first `kept` waypoints of what it had, and these.
struct TraceRoute {
  std::uint32_t robot = 0;
  std::uint32_t update_flags = 0;
  std::uint32_t path_flags = 0;
  std::uint32_t kept = 0;
  std::uint32_t count = 0;
  std::uint32_t stride = sizeof(dmrp_waypoint);
  const dmrp_waypoint* waypoints = nullptr;
};

struct TraceSample {
  dmrp_sample sample{};             // its plan and routes are not stored
  std::uint64_t plan_revision = 0;  // 0: there is no plan
  const TraceRoute* routes = nullptr;
  std::uint32_t route_count = 0;
  std::uint32_t route_stride = sizeof(TraceRoute);
};

// Beam i points at angle_min + i * angle_increment from the robot's heading.
struct TraceScan {
  std::int64_t t_ns = 0;
  std::uint32_t robot = 0;
  double angle_min = 0.0;
  double angle_increment = 0.0;
  double range_min = 0.0;
  double range_max = 0.0;
  std::span<const float> ranges;  // infinite for beams without a hit
};

struct TraceTrajectory {
  AnnotationSource source;
  std::int64_t t_ns = 0;
  std::int64_t step_ns = 0;
  std::uint32_t role = 0;  // DMRP_ANNOTATE_*
  std::span<const dmrp_pose> poses;
};

struct TraceNote {
  AnnotationSource source;
  std::int64_t t_ns = 0;
  std::string_view text;
};

struct TraceEnd {
  dmrp_trial_end end{};
  std::string_view reason;
};

}  // namespace dmrp::core
