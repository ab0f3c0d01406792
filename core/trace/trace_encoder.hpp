// SPDX-License-Identifier: MIT
// trace_encoder.hpp: writes down a trial as it happens.
#pragma once

#include <dmrp/ext/lidar.h>
#include <dmrp/metric.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "core/foxglove/foxglove_channels.hpp"
#include "core/trace/trace.hpp"

namespace dmrp::core {

// Hands every record, once it is whole, to a sink (a file, say) and keeps none. What there is to look at goes to the
// Foxglove channels, if any.
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

  // A call of the planner and what it gave. One that gave no plan has no paths. `conflicts`: what the plan validator
  // counted between robots (of uncoordinated planners only; others' plans have none).
  void plan(const dmrp_plan& plan, std::uint32_t conflicts = 0);

  // `sample.plan` is null or has the revision of a plan with paths that was written before.
  void sample(const dmrp_sample& sample);

  // What a robot's lidar saw at the control tick of the last sample.
  void scan(std::uint32_t robot, const dmrp_scan& scan);

  // What plugins said through dmrp.annotate/1.
  void trajectory(AnnotationSource source, std::uint32_t role, std::span<const dmrp_pose> poses, std::int64_t step_ns);
  void note(AnnotationSource source, std::string_view text);

  // The last record. `reason` is for people.
  void end(const dmrp_trial_end& end, std::string_view reason = {});

  std::size_t written_bytes() const { return written_bytes_; }  // of all records

 private:
  template <class WriteBody>
  void record(TraceRecordKind kind, WriteBody&& write_body);

  TraceBytes record_;  // being written
  std::size_t written_bytes_ = 0;
  RecordSink sink_;
  FoxgloveChannels* foxglove_;
  std::int64_t now_ns_ = 0;  // of the last sample
};

}  // namespace dmrp::core
