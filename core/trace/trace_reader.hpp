// SPDX-License-Identifier: MIT
// trace_reader.hpp: gives a trace back as the structs that metric plugins take.
#pragma once

#include <dmrp/metric.h>

#include <cstdint>
#include <deque>
#include <memory_resource>
#include <span>
#include <string_view>
#include <vector>

#include "core/bytes/trace_bytes.hpp"
#include "core/foxglove/annotation_source.hpp"
#include "core/trace/trace.hpp"
#include "core/trace/trace_records.hpp"

namespace dmrp::core {

struct TracePlan {
  dmrp_plan plan{};
  std::int64_t made_at_ns = 0;  // simulated time of the sample before it
  std::uint32_t conflicts = 0;  // between robots
};

// Beam i points at angle_min + i * angle_increment from the robot's heading.
struct TraceScan {
  std::int64_t t_ns = 0;
  std::uint32_t robot = 0;
  double angle_min = 0.0;
  double angle_increment = 0.0;
  double range_min = 0.0;
  double range_max = 0.0;
  std::span<const float> ranges;  // infinite where nothing was hit
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
// What of a trace stays at hand beside world, plans and end. Samples never do.
enum class TraceExtent { samples, with_scans, everything };

// The constructor checks the whole trace and throws TraceError; after it nothing fails, unless a file that is being
// read changes. A trace without an end record is whole as far as it goes (records are never cut).
//
//   TraceReader trace(TraceRecords(path), TraceExtent::samples);
//   metric.begin(trace.first_plan());
//   while (const dmrp_sample* sample = trace.next_sample()) metric.observe(*sample);
//   metric.finish(*trace.end());
//   trace.rewind();
//
// World, plans, end, scans, trajectories and notes keep their addresses and live as long as the reader.
class TraceReader {
 public:
  explicit TraceReader(TraceRecords records, TraceExtent extent = TraceExtent::everything);

  // `bytes`, a whole trace in memory, outlive the reader.
  explicit TraceReader(std::span<const std::uint8_t> bytes) : TraceReader(TraceRecords(bytes)) {}
  TraceReader(const TraceReader&) = delete;
  TraceReader& operator=(const TraceReader&) = delete;

  const dmrp_world& world() const { return world_; }  // with self = -1

  const std::deque<TracePlan>& plans() const { return plans_; }
  const dmrp_plan* first_plan() const;  // the first one with paths; null if there is none

  std::size_t sample_count() const { return sample_count_; }
  const dmrp_sample* next_sample();  // null after the last; valid until the next call
  void rewind() { records_.rewind(); }

  const dmrp_trial_end* end() const { return ended_ ? &end_ : nullptr; }  // null where the trial was cut short
  std::string_view reason() const { return reason_; }

  const std::vector<TraceScan>& scans() const { return scans_; }  // where they were recorded; by time, then robot
  const std::vector<TraceTrajectory>& trajectories() const { return trajectories_; }
  const std::vector<TraceNote>& notes() const { return notes_; }

 private:
  void read_record(const TraceRecord& record);
  void read_plan(ByteCursor& in);
  void read_sample(ByteCursor& in);
  void read_scan(ByteCursor& in);
  void read_trajectory(ByteCursor& in);
  void read_note(ByteCursor& in);
  const dmrp_plan* plan_of_revision(std::uint64_t revision) const;

  TraceRecords records_;
  TraceExtent extent_;
  std::pmr::monotonic_buffer_resource storage_;  // of everything that lives as long as the reader
  dmrp_world world_{};
  std::deque<TracePlan> plans_;
  std::vector<TraceScan> scans_;
  std::vector<TraceTrajectory> trajectories_;
  std::vector<TraceNote> notes_;
  dmrp_trial_end end_{};
  bool ended_ = false;
  std::string_view reason_;

  std::size_t sample_count_ = 0;
  dmrp_sample sample_{};
  std::vector<dmrp_robot_sample> robots_;
  std::vector<dmrp_person> people_;
  std::vector<dmrp_contact> contacts_;
  std::vector<dmrp_call> calls_;
};

}  // namespace dmrp::core
