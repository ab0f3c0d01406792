// SPDX-License-Identifier: MIT
// foxglove_channels.hpp: the visualisation of a trial: besides the trace itself, channels of JSON messages that
// Foxglove and Lichtblick display (docs/traces.md). They are derived from the trace and rounded; no measurement reads
// them.
//
//   /map, /goals            foxglove.SceneUpdate, once
//   /tf                     foxglove.FrameTransforms: map -> robot_0, robot_1, ..., ten times a second
//   /robots                 foxglove.SceneUpdate in their frames: once, and when a robot's state changes
//   /people                 foxglove.SceneUpdate, ten times a second
//   /plan                   foxglove.SceneUpdate, every plan with paths
//   /contacts               foxglove.SceneUpdate, at the beginning of each contact
//   /predictions            foxglove.SceneUpdate: trajectories from plugins' annotations
//   /robot_0/scan, ...      foxglove.LaserScan, if scans are recorded
//   /log                    foxglove.Log: contacts, plans, notes of plugins, the end
//   /metric_events          foxglove.Log: events from metrics
//   /metric_events/robots   foxglove.SceneUpdate: the robots of an event, for its duration
//
// Times are simulated and start at 0; the frame `map` is the world frame.
#pragma once

#include <dmrp/ext/lidar.h>
#include <dmrp/sample.h>
#include <dmrp/trial_end.h>
#include <dmrp/world.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/foxglove/annotation_source.hpp"
#include "core/foxglove/foxglove_scene.hpp"
#include "core/mcap/mcap_writer.hpp"

namespace dmrp::core {

// An event that a metric reported after the trial, as it is shown.
struct EventMark {
  std::string_view metric;
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
  std::span<const std::uint32_t> robots;
  std::string_view text;
};

// Takes the same data as a TraceEncoder, in the same order; TraceFileWriter connects the two.
class FoxgloveChannels {
 public:
  explicit FoxgloveChannels(McapWriter& file);  // must outlive this object
  FoxgloveChannels(const FoxgloveChannels&) = delete;
  FoxgloveChannels& operator=(const FoxgloveChannels&) = delete;

  void world(const dmrp_world& world);
  void plan(std::int64_t now_ns, const dmrp_plan& plan);
  void sample(const dmrp_sample& sample);
  void scan(std::uint32_t robot, const dmrp_scan& scan);
  void trajectory(std::int64_t now_ns, AnnotationSource source, std::uint32_t role, std::span<const dmrp_pose> poses);
  void note(std::int64_t now_ns, AnnotationSource source, std::string_view text);
  void end(const dmrp_trial_end& end, std::string_view reason);
  void metric_event(const EventMark& event);

 private:
  struct Robot {
    std::string name;   // from the scenario
    std::string frame;  // "robot_0"
    double radius_m = 0.0;
    std::vector<std::vector<dmrp_vec2>> parts;  // of the outline; empty: a disc
    std::uint32_t state = DMRP_ROBOT_ACTIVE;
    dmrp_pose pose{};
  };
  enum class Level { info = 2, warning = 3 };

  void put_map(const dmrp_world& world);
  void put_goals(const dmrp_world& world);
  void put_robots(std::int64_t t_ns);
  void put_frames(std::int64_t t_ns);
  void put_people(const dmrp_sample& sample);
  void put_contact(const dmrp_sample& sample, const dmrp_contact& contact);
  void put_log(std::uint16_t channel, std::int64_t t_ns, Level level, std::string_view name, std::string_view text);
  void flush_trajectories();
  std::string name_of(std::uint32_t robot) const;
  std::string name_of(AnnotationSource source) const;

  McapWriter& file_;
  std::uint16_t map_ = 0, goals_ = 0, tf_ = 0, robots_channel_ = 0, people_ = 0, plan_ = 0, contacts_ = 0;
  std::uint16_t predictions_ = 0, log_ = 0, metric_log_ = 0, metric_robots_ = 0;
  std::vector<std::uint16_t> scans_;  // channels by robot; empty until the first scan
  std::vector<Robot> robots_;
  std::vector<std::string> shapes_;
  std::int64_t t_ns_ = 0;       // of the last sample
  std::int64_t shown_ns_ = -1;  // of the last displayed sample
  std::uint32_t contact_count_ = 0;
  std::uint32_t metric_figure_count_ = 0;

  // Trajectories of one plugin, one role and one time, written as one message: a controller may annotate a hundred in
  // one step.
  struct TrajectoryGroup {
    std::int64_t t_ns = -1;  // -1: the group is empty
    AnnotationSource source;
    std::uint32_t role = 0;
    SceneEntity lines;
  };
  TrajectoryGroup trajectories_;

  SceneUpdate scene_;
  SceneEntity entity_;
  JsonText json_;
};

}  // namespace dmrp::core
