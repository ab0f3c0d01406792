// SPDX-License-Identifier: MIT
#include "core/trace/trace_reader.hpp"

#include <algorithm>
#include <string>

#include "core/bytes/trace_bytes.hpp"
#include "core/trace/trace_decoder.hpp"
#include "core/trace/trace_elements.hpp"

namespace dmrp::core {
namespace {

bool is_known(const dmrp_contact& contact) {
  return contact.kind == DMRP_CONTACT_STATIC || contact.kind == DMRP_CONTACT_ROBOT ||
         contact.kind == DMRP_CONTACT_PERSON;
}

// Metrics use these as indices without further checks.
void check_contact(const ByteCursor& in, const dmrp_contact& contact, const dmrp_world& world,
                   std::uint32_t person_count) {
  const std::uint32_t others = contact.kind == DMRP_CONTACT_STATIC  ? world.shape_count + 1
                               : contact.kind == DMRP_CONTACT_ROBOT ? world.robot_count
                                                                    : person_count;
  if (contact.a >= world.robot_count || contact.b >= others) in.fail("a contact of unknown bodies");
}

std::uint32_t format_version(const TraceRecord& world) {
  const auto version = ByteCursor(world.body, world.offset).take<std::uint32_t>();
  if (version == 0 || version > trace_format_version)
    throw TraceError(world.offset, "format version " + std::to_string(version) + "; this program reads versions 1 to " +
                                       std::to_string(trace_format_version));
  return version;
}

template <class Element>
void take_into(RecordCursor& in, std::vector<Element>& elements) {
  const TraceElements stored = take_element_count<Element>(in);
  elements.resize(stored.count);
  take_elements(in, stored, elements.data());
}

}  // namespace

TraceReader::TraceReader(TraceRecords records, TraceExtent extent) : records_(std::move(records)), extent_(extent) {
  bool is_first = true;
  while (const auto record = records_.next()) {
    const std::size_t begin = record->offset - trace_record_prefix_bytes;
    if ((record->kind == TraceRecordKind::world) != is_first)
      throw TraceError(begin, "the world must be the first record and occur once");
    if (ended_) throw TraceError(begin, "a record after the end");
    read_record(*record);
    is_first = false;
  }
  if (is_first) throw TraceError(0, "the trace is empty");
  rewind();
}

void TraceReader::read_record(const TraceRecord& record) {
  if (record.kind == TraceRecordKind::world) version_ = format_version(record);
  RecordCursor in(record.body, record.offset, version_);
  switch (record.kind) {
    case TraceRecordKind::world:
      in.take<std::uint32_t>();  // format version
      world_ = take_world(in, storage_);
      break;
    case TraceRecordKind::plan:
      read_plan(in);
      break;
    case TraceRecordKind::sample:
      read_sample(in);
      ++sample_count_;
      break;
    case TraceRecordKind::scan:
      read_scan(in);
      break;
    case TraceRecordKind::trajectory:
      read_trajectory(in);
      break;
    case TraceRecordKind::note:
      read_note(in);
      break;
    case TraceRecordKind::end:
      end_ = take_end(in, storage_, world_.robot_count);
      reason_ = take_stored_text(in, storage_);
      ended_ = true;
      break;
    default:
      throw TraceError(record.offset - 1, "the kind of the record is unknown");
  }
  if (version_ == 1 && !in.at_end()) in.fail("the record is longer than its content");
}

void TraceReader::read_plan(RecordCursor& in) {
  const TracePlan made = take_plan(in, storage_, world_.robot_count);
  if (made.plan.path_count > 0 && plan_of_revision(made.plan.revision)) in.fail("a second plan of this revision");
  plans_.push_back(made);
}

void TraceReader::read_scan(RecordCursor& in) {
  TraceScan scan;
  scan.t_ns = in.take<std::int64_t>();
  scan.robot = in.take<std::uint32_t>();
  if (scan.robot >= world_.robot_count) in.fail("a scan of an unknown robot");
  scan.angle_min = in.take<double>();
  scan.angle_increment = in.take<double>();
  scan.range_min = in.take<double>();
  scan.range_max = in.take<double>();
  const std::uint32_t count = in.take_count(sizeof(float));
  if (extent_ == TraceExtent::samples) {
    in.take_bytes(count * sizeof(float));
  } else {
    scan.ranges = {take_stored<float>(in, storage_, count), count};
    scans_.push_back(scan);
  }
}

void TraceReader::read_trajectory(RecordCursor& in) {
  TraceTrajectory trajectory;
  trajectory.t_ns = in.take<std::int64_t>();
  trajectory.source = in.take<AnnotationSource>();
  trajectory.role = in.take<std::uint32_t>();
  trajectory.step_ns = in.take<std::int64_t>();
  const std::uint32_t count = in.take_count(sizeof(dmrp_pose));
  if (extent_ != TraceExtent::everything) {
    in.take_bytes(count * sizeof(dmrp_pose));
  } else {
    trajectory.poses = {take_stored<dmrp_pose>(in, storage_, count), count};
    trajectories_.push_back(trajectory);
  }
}

void TraceReader::read_note(RecordCursor& in) {
  TraceNote note;
  note.t_ns = in.take<std::int64_t>();
  note.source = in.take<AnnotationSource>();
  if (extent_ != TraceExtent::everything) {
    in.take_text();
  } else {
    note.text = take_stored_text(in, storage_);
    notes_.push_back(note);
  }
}

// Decodes into sample_ and overwrites the previous sample.
void TraceReader::read_sample(RecordCursor& in) {
  sample_ = {};
  sample_.struct_size = sizeof(dmrp_sample);
  sample_.t_ns = in.take<std::int64_t>();
  sample_.dt_ns = in.take<std::int64_t>();
  sample_.control_tick = in.take<std::uint32_t>();
  const auto revision = in.take<std::uint64_t>();
  if (revision != 0) sample_.plan = plan_of_revision(revision);
  if (revision != 0 && !sample_.plan) in.fail("the plan of the sample does not precede it");

  take_into(in, robots_);
  if (robots_.size() != world_.robot_count) in.fail("a sample with another number of robots");
  take_into(in, people_);
  take_into(in, contacts_);
  std::erase_if(contacts_, [](const dmrp_contact& contact) { return !is_known(contact); });
  for (const dmrp_contact& contact : contacts_)
    check_contact(in, contact, world_, static_cast<std::uint32_t>(people_.size()));
  take_calls(in, calls_);
  for (const dmrp_call& call : calls_)
    if (call.kind == DMRP_CALL_CONTROL && call.robot >= world_.robot_count) in.fail("a call for an unknown robot");

  sample_.robots = robots_.data();
  sample_.robot_count = static_cast<std::uint32_t>(robots_.size());
  sample_.robot_stride = sizeof(dmrp_robot_sample);
  sample_.people = people_.data();
  sample_.person_count = static_cast<std::uint32_t>(people_.size());
  sample_.person_stride = sizeof(dmrp_person);
  sample_.contacts = contacts_.data();
  sample_.contact_count = static_cast<std::uint32_t>(contacts_.size());
  sample_.contact_stride = sizeof(dmrp_contact);
  sample_.calls = calls_.data();
  sample_.call_count = static_cast<std::uint32_t>(calls_.size());
  sample_.call_stride = sizeof(dmrp_call);
}

const dmrp_sample* TraceReader::next_sample() {
  while (const auto record = records_.next()) {
    if (record->kind != TraceRecordKind::sample) continue;
    RecordCursor in(record->body, record->offset, version_);
    read_sample(in);
    return &sample_;
  }
  return nullptr;
}

const dmrp_plan* TraceReader::first_plan() const {
  const auto found =
      std::find_if(plans_.begin(), plans_.end(), [](const TracePlan& made) { return made.plan.path_count > 0; });
  return found == plans_.end() ? nullptr : &found->plan;
}

// The one plan of this revision that has paths: failed calls of the planner may have the same revision.
const dmrp_plan* TraceReader::plan_of_revision(std::uint64_t revision) const {
  const auto found = std::find_if(plans_.rbegin(), plans_.rend(), [&](const TracePlan& made) {
    return made.plan.revision == revision && made.plan.path_count > 0;
  });
  return found == plans_.rend() ? nullptr : &found->plan;
}

}  // namespace dmrp::core
