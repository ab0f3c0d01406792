// SPDX-License-Identifier: MIT
#include "core/trace/trace_encoder.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

#include "core/trace/trace_field_writer.hpp"

namespace dmrp::core {

template <class Content>
void TraceEncoder::record(TraceRecordKind kind, const Content& content) {
  write_record(record_, kind, content, written_bytes_);
  written_bytes_ += record_.size();
  sink_(now_ns_, record_);
}

TraceEncoder::TraceEncoder(const dmrp_world& world, RecordSink sink, FoxgloveChannels* foxglove)
    : sink_(std::move(sink)), foxglove_(foxglove), routes_(world.robot_count) {
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
  const std::vector<TraceRoute> routes = shortened(sample);
  record(TraceRecordKind::sample, TraceSample{sample, sample.plan ? sample.plan->revision : 0, routes.data(),
                                              static_cast<std::uint32_t>(routes.size())});
}

// The sample's routes without the waypoints that each has in common with its robot's last one. Valid until the next call.
std::vector<TraceRoute> TraceEncoder::shortened(const dmrp_sample& sample) {
  std::vector<TraceRoute> routes;
  for (std::uint32_t i = 0; i < sample.route_count; ++i) {
    const dmrp_route& route = *DMRP_AT(dmrp_route, sample.routes, sample.route_stride, i);
    std::vector<dmrp_waypoint>& last = routes_[route.robot];
    const auto waypoint = [&](std::size_t k) -> const dmrp_waypoint& {
      return *DMRP_AT(dmrp_waypoint, route.path->waypoints, route.path->stride, k);
    };
    std::size_t kept = 0;
    const std::size_t most = std::min<std::size_t>(last.size(), route.path->count);
    while (kept < most && std::memcmp(&last[kept], &waypoint(kept), sizeof(dmrp_waypoint)) == 0) ++kept;
    last.resize(kept);
    for (std::size_t k = kept; k < route.path->count; ++k) last.push_back(waypoint(k));
    routes.push_back({route.robot, route.flags, route.path->flags, static_cast<std::uint32_t>(kept),
                      static_cast<std::uint32_t>(last.size() - kept), sizeof(dmrp_waypoint), last.data() + kept});
  }
  return routes;
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
