// SPDX-License-Identifier: MIT
// trace_reader.hpp: reads a trace as the structs that metric plugins take.
#pragma once

#include <dmrp/sample.h>
#include <dmrp/trial_end.h>
#include <dmrp/world.h>

#include <cstdint>
#include <deque>
#include <memory_resource>
#include <span>
#include <string_view>
#include <vector>

#include "core/trace/record_cursor.hpp"
#include "core/trace/trace_contents.hpp"
#include "core/trace/trace_records.hpp"

namespace dmrp::core {

// The records that a reader keeps besides world, plans and end. Samples are never kept.
enum class TraceExtent { samples, with_scans, everything };

// The constructor checks the whole trace and throws TraceError; afterwards nothing fails unless the file changes. A
// trace without an end record is valid up to its last record (records are never truncated).
//
//   TraceReader trace(TraceRecords(path), TraceExtent::samples);
//   metric.begin(trace.first_plan());
//   while (const dmrp_sample* sample = trace.next_sample()) metric.observe(*sample);
//   metric.finish(*trace.end());
//   trace.rewind();
//
// World, plans, end, scans, trajectories and notes keep their addresses and are valid as long as the reader.
class TraceReader {
 public:
  explicit TraceReader(TraceRecords records, TraceExtent extent = TraceExtent::everything);

  // `bytes`, a whole trace in memory, must outlive the reader.
  explicit TraceReader(std::span<const std::uint8_t> bytes) : TraceReader(TraceRecords(bytes)) {}
  TraceReader(const TraceReader&) = delete;
  TraceReader& operator=(const TraceReader&) = delete;

  const dmrp_world& world() const { return world_; }

  const std::deque<TracePlan>& plans() const { return plans_; }
  const dmrp_plan* first_plan() const;  // the first one with paths; null if there is none

  std::size_t sample_count() const { return sample_count_; }
  const dmrp_sample* next_sample();  // null after the last; valid until the next call
  void rewind();

  const dmrp_trial_end* end() const { return ended_ ? &end_ : nullptr; }  // null if the trial was interrupted
  std::string_view reason() const { return reason_; }

  const std::vector<TraceScan>& scans() const { return scans_; }  // empty if not recorded; by time, then robot
  const std::vector<TraceTrajectory>& trajectories() const { return trajectories_; }
  const std::vector<TraceNote>& notes() const { return notes_; }

 private:
  void read_record(const TraceRecord& record);
  void read_world(RecordCursor& in);
  void read_plan(RecordCursor& in);
  void read_sample(RecordCursor& in);
  void read_routes(RecordCursor& in, const TraceSample& read);
  template <class Annotation>
  void read_annotation(RecordCursor& in, std::vector<Annotation>& annotations);
  const dmrp_plan* plan_of_revision(std::uint64_t revision) const;

  TraceRecords records_;
  TraceExtent extent_;
  std::pmr::monotonic_buffer_resource storage_;  // of everything that is valid as long as the reader
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
  std::pmr::monotonic_buffer_resource sample_storage_{std::size_t{1} << 16};
  std::vector<dmrp_contact> contacts_;                 // of the sample: those of known kinds
  std::vector<std::vector<dmrp_waypoint>> waypoints_;  // of each robot's last route
  std::vector<dmrp_path> paths_;                       // of the sample's routes
  std::vector<dmrp_route> routes_;
};

}  // namespace dmrp::core
