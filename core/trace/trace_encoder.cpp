// SPDX-License-Identifier: MIT
#include "core/trace/trace_encoder.hpp"

#include <cassert>
#include <limits>
#include <utility>

#include "core/bytes/trace_bytes.hpp"
#include "core/trace/trace_elements.hpp"

namespace dmrp::core {
namespace {

std::string_view text_of(const char* text) {
  return text ? std::string_view(text) : std::string_view();
}

// An array that may be absent.
template <class Value>
void put_optional(ByteWriter& out, const Value* values, std::size_t count) {
  out.put(static_cast<std::uint8_t>(values != nullptr));
  if (values) out.put_array(values, count);
}

void put_limits(ByteWriter& out, const dmrp_limits& limits) {
  out.put_block([&] {
    for (const double value : {limits.v_min, limits.v_max, limits.v_y_max, limits.omega_max, limits.a_max,
                               limits.alpha_max, limits.wheelbase_m, limits.steering_max, limits.steering_rate_max})
      out.put(value);
  });
}

void put_vertices(ByteWriter& out, const dmrp_vec2* vertices, std::uint32_t count) {
  out.put(count);
  out.put_array(vertices, count);
}

void put_footprint(ByteWriter& out, const dmrp_footprint& footprint) {
  out.put_block([&] {
    out.put(footprint.radius_m);
    out.put(footprint.inscribed_radius_m);
    out.put(footprint.part_count);
    for (std::uint32_t i = 0; i < footprint.part_count; ++i) {
      const dmrp_polygon& part = *DMRP_AT(dmrp_polygon, footprint.parts, footprint.part_stride, i);
      out.put_block([&] { put_vertices(out, part.vertices, part.vertex_count); });
    }
  });
}

void put_robot(ByteWriter& out, const dmrp_robot& robot) {
  out.put_block([&] {
    out.put_text(text_of(robot.name));
    out.put(robot.kinematics);
    out.put(robot.start);
    put_limits(out, *robot.limits);
    put_footprint(out, *robot.footprint);
    put_elements(out, robot.goals, robot.goal_count, robot.goal_stride);
    out.put_text(text_of(robot.type));
  });
}

void put_shape(ByteWriter& out, const dmrp_shape& shape) {
  out.put_block([&] {
    out.put_text(text_of(shape.name));
    out.put(shape.kind);
    out.put(shape.center);
    out.put(shape.radius_m);
    out.put(shape.height_m);
    put_vertices(out, shape.vertices, shape.kind == DMRP_SHAPE_POLYGON ? shape.vertex_count : 0);
  });
}

void put_grid(ByteWriter& out, const dmrp_grid* grid) {
  out.put(static_cast<std::uint8_t>(grid != nullptr));
  if (!grid) return;
  out.put_block([&] {
    out.put(grid->width);
    out.put(grid->height);
    out.put(grid->resolution_m);
    out.put(grid->origin);
    const std::size_t cells = std::size_t{grid->width} * grid->height;
    put_optional(out, grid->free, cells);
    put_optional(out, grid->edges, cells);
    put_optional(out, grid->clearance, cells);
  });
}

void put_world(ByteWriter& out, const dmrp_world& world) {
  out.put(world.person_count);
  out.put(world.lower);
  out.put(world.upper);
  out.put(world.step_ns);
  out.put(world.control_period_ns);
  out.put(world.time_limit_ns);
  out.put(world.call_budget_ns);
  out.put(world.robot_count);
  for (std::uint32_t i = 0; i < world.robot_count; ++i)
    put_robot(out, *DMRP_AT(dmrp_robot, world.robots, world.robot_stride, i));
  out.put(world.shape_count);
  for (std::uint32_t i = 0; i < world.shape_count; ++i)
    put_shape(out, *DMRP_AT(dmrp_shape, world.shapes, world.shape_stride, i));
  out.put(world.segment_count);
  out.put_array(world.segments, world.segment_count);
  put_grid(out, world.planning_grid);
  out.put(world.person_radius_m);
}

void put_path(ByteWriter& out, const dmrp_path& path) {
  out.put_block([&] { put_elements(out, path.waypoints, path.count, path.stride); });
}

void put_statistic(ByteWriter& out, const dmrp_statistic& statistic) {
  out.put_block([&] {
    out.put_text(text_of(statistic.name));
    out.put(statistic.value);
  });
}

}  // namespace

template <class WriteBody>
void TraceEncoder::record(TraceRecordKind kind, WriteBody&& write_body) {
  record_.clear();
  ByteWriter out(record_);
  out.put(std::uint32_t{0});
  out.put(kind);
  write_body(out);

  const std::size_t body_bytes = record_.size() - trace_record_prefix_bytes;
  if (body_bytes > std::numeric_limits<std::uint32_t>::max())
    throw TraceError(written_bytes_, "a record of more than 4 GB");
  const auto length = static_cast<std::uint32_t>(body_bytes);
  std::memcpy(record_.data(), &length, sizeof(length));
  written_bytes_ += record_.size();
  sink_(now_ns_, record_);
}

TraceEncoder::TraceEncoder(const dmrp_world& world, RecordSink sink, FoxgloveChannels* foxglove)
    : sink_(std::move(sink)), foxglove_(foxglove) {
  assert(sink_);
  record(TraceRecordKind::world, [&](ByteWriter& out) {
    out.put(trace_format_version);
    put_world(out, world);
  });
  if (foxglove_) foxglove_->world(world);
}

void TraceEncoder::plan(const dmrp_plan& plan, std::uint32_t conflicts) {
  record(TraceRecordKind::plan, [&](ByteWriter& out) {
    out.put(now_ns_);
    out.put(plan.revision);
    out.put(plan.from_ns);
    out.put(plan.step_duration_ns);
    out.put(plan.planning_ns);
    out.put(plan.status);
    out.put(conflicts);
    out.put(plan.path_count);
    for (std::uint32_t i = 0; i < plan.path_count; ++i)
      put_path(out, *DMRP_AT(dmrp_path, plan.paths, plan.path_stride, i));
    out.put(plan.statistic_count);
    for (std::uint32_t i = 0; i < plan.statistic_count; ++i)
      put_statistic(out, *DMRP_AT(dmrp_statistic, plan.statistics, plan.statistic_stride, i));
  });
  if (foxglove_) foxglove_->plan(now_ns_, plan);
}

// Robots, people and contacts are most of a trace. They are copied in their memory layout, which has no padding.
void TraceEncoder::sample(const dmrp_sample& sample) {
  assert(sample.t_ns >= now_ns_);
  now_ns_ = sample.t_ns;
  if (foxglove_) foxglove_->sample(sample);
  record(TraceRecordKind::sample, [&](ByteWriter& out) {
    out.put(sample.t_ns);
    out.put(sample.dt_ns);
    out.put(sample.control_tick);
    out.put(sample.plan ? sample.plan->revision : std::uint64_t{0});
    put_elements(out, sample.robots, sample.robot_count, sample.robot_stride);
    put_elements(out, sample.people, sample.person_count, sample.person_stride);
    put_elements(out, sample.contacts, sample.contact_count, sample.contact_stride);
    put_elements(out, sample.calls, sample.call_count, sample.call_stride);
  });
}

void TraceEncoder::scan(std::uint32_t robot, const dmrp_scan& scan) {
  record(TraceRecordKind::scan, [&](ByteWriter& out) {
    out.put(scan.t_ns);
    out.put(robot);
    out.put(scan.angle_min);
    out.put(scan.angle_increment);
    out.put(scan.range_min);
    out.put(scan.range_max);
    out.put(scan.count);
    out.put_array(scan.ranges, scan.count);
  });
  if (foxglove_) foxglove_->scan(robot, scan);
}

void TraceEncoder::trajectory(AnnotationSource source, std::uint32_t role, std::span<const dmrp_pose> poses,
                              std::int64_t step_ns) {
  record(TraceRecordKind::trajectory, [&](ByteWriter& out) {
    out.put(now_ns_);
    out.put(source);
    out.put(role);
    out.put(step_ns);
    out.put(static_cast<std::uint32_t>(poses.size()));
    out.put_array(poses.data(), poses.size());
  });
  if (foxglove_) foxglove_->trajectory(now_ns_, source, role, poses);
}

void TraceEncoder::note(AnnotationSource source, std::string_view text) {
  record(TraceRecordKind::note, [&](ByteWriter& out) {
    out.put(now_ns_);
    out.put(source);
    out.put_text(text);
  });
  if (foxglove_) foxglove_->note(now_ns_, source, text);
}

void TraceEncoder::end(const dmrp_trial_end& end, std::string_view reason) {
  if (foxglove_) foxglove_->end(end, reason);
  record(TraceRecordKind::end, [&](ByteWriter& out) {
    out.put(end.ending);
    out.put(end.t_ns);
    put_elements(out, end.robots, end.robot_count, end.robot_stride);
    out.put_text(reason);
  });
}

}  // namespace dmrp::core
