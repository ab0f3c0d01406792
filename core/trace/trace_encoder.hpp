// SPDX-License-Identifier: MIT
// trace_encoder.hpp: encodes a trial as trace records while it runs.
#pragma once

#include <dmrp/ext/lidar.h>
#include <dmrp/sample.h>
#include <dmrp/trial_end.h>
#include <dmrp/world.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "core/foxglove/foxglove_channels.hpp"
#include "core/trace/trace.hpp"
#include "core/trace/trace_contents.hpp"

namespace dmrp::core {

// Passes every complete record to a sink (a file, for example) and keeps none. Passes the same data to the Foxglove
// channels, if there are any.
//
//   TraceEncoder trace(world, sink);
//   trace.plan(plan, conflicts);
//   for (...) trace.sample(sample);
//   trace.end(end, "all robots arrived");
class TraceEncoder {
 public:
  // `t_ns` is the simulated time at which the record was made.
  using RecordSink = std::function<void(std::int64_t t_ns, std::span<const std::uint8_t> record)>;

  explicit TraceEncoder(const dmrp_world& world, RecordSink sink, FoxgloveChannels* foxglove = nullptr);

  // A call of the planner and its result; without a plan it has no paths. `conflicts`: the number of conflicts between
  // robots that the plan validator counted (only plans of uncoordinated planners have any).
  void plan(const dmrp_plan& plan, std::uint32_t conflicts = 0);

  // `sample.plan` is null or has the revision of an earlier plan with paths.
  void sample(const dmrp_sample& sample);

  // The scan of a robot's lidar at the control tick of the last sample.
  void scan(std::uint32_t robot, const dmrp_scan& scan);

  // Annotations of plugins through dmrp.annotate/1.
  void trajectory(AnnotationSource source, std::uint32_t role, std::span<const dmrp_pose> poses, std::int64_t step_ns);
  void note(AnnotationSource source, std::string_view text);

  // The last record. `reason` is for display.
  void end(const dmrp_trial_end& end, std::string_view reason = {});

  std::size_t written_bytes() const { return written_bytes_; }  // of all records

 private:
  template <class Content>
  void record(TraceRecordKind kind, const Content& content);
  std::vector<TraceRoute> shortened(const dmrp_sample& sample);

  TraceBytes record_;  // the current one
  std::size_t written_bytes_ = 0;
  RecordSink sink_;
  FoxgloveChannels* foxglove_;
  std::int64_t now_ns_ = 0;                         // of the last sample
  std::vector<std::vector<dmrp_waypoint>> routes_;  // the last of each robot
};

}  // namespace dmrp::core
