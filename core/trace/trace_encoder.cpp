// SPDX-License-Identifier: MIT
#include "core/trace/trace_encoder.hpp"

#include <cassert>
#include <utility>

#include "core/trace/trace_field_writer.hpp"

namespace dmrp::core {

template <class Content>
void TraceEncoder::record(TraceRecordKind kind, const Content& content) {
  write_record(record_, kind, content, TraceForm::current, written_bytes_);
  written_bytes_ += record_.size();
  sink_(now_ns_, record_);
}

TraceEncoder::TraceEncoder(const dmrp_world& world, RecordSink sink, FoxgloveChannels* foxglove)
    : sink_(std::move(sink)), foxglove_(foxglove) {
  assert(sink_);
  record(TraceRecordKind::world, TraceWorld{trace_format_version, world});
  if (foxglove_) foxglove_->world(world);
}

void TraceEncoder::plan(const dmrp_plan& plan, std::uint32_t conflicts) {
  record(TraceRecordKind::plan, TracePlan{plan, now_ns_, conflicts});
  if (foxglove_) foxglove_->plan(now_ns_, plan);
}

void TraceEncoder::sample(const dmrp_sample& sample) {
  assert(sample.t_ns >= now_ns_);
  now_ns_ = sample.t_ns;
  if (foxglove_) foxglove_->sample(sample);
  record(TraceRecordKind::sample, TraceSample{sample, sample.plan ? sample.plan->revision : 0});
}

void TraceEncoder::scan(std::uint32_t robot, const dmrp_scan& scan) {
  record(TraceRecordKind::scan, TraceScan{scan.t_ns,
                                          robot,
                                          scan.angle_min,
                                          scan.angle_increment,
                                          scan.range_min,
                                          scan.range_max,
                                          {scan.ranges, scan.count}});
  if (foxglove_) foxglove_->scan(robot, scan);
}

void TraceEncoder::trajectory(AnnotationSource source, std::uint32_t role, std::span<const dmrp_pose> poses,
                              std::int64_t step_ns) {
  record(TraceRecordKind::trajectory, TraceTrajectory{source, now_ns_, step_ns, role, poses});
  if (foxglove_) foxglove_->trajectory(now_ns_, source, role, poses);
}

void TraceEncoder::note(AnnotationSource source, std::string_view text) {
  record(TraceRecordKind::note, TraceNote{source, now_ns_, text});
  if (foxglove_) foxglove_->note(now_ns_, source, text);
}

void TraceEncoder::end(const dmrp_trial_end& end, std::string_view reason) {
  if (foxglove_) foxglove_->end(end, reason);
  record(TraceRecordKind::end, TraceEnd{end, reason});
}

}  // namespace dmrp::core
