// SPDX-License-Identifier: MIT
#include "core/trace/trace_reader.hpp"

#include <algorithm>
#include <string>

#include "core/trace/trace_field_reader.hpp"

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

void check_version(const TraceRecord& world) {
  const auto version = ByteCursor(world.body, world.offset).take<std::uint32_t>();
  if (version != trace_format_version)
    throw TraceError(world.offset, "format version " + std::to_string(version) + "; this program reads version " +
                                       std::to_string(trace_format_version) + ": run the experiment again");
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
  if (record.kind == TraceRecordKind::world) check_version(record);
  RecordCursor in(record.body, record.offset);
  switch (record.kind) {
    case TraceRecordKind::world:
      read_world(in);
      break;
    case TraceRecordKind::plan:
      read_plan(in);
      break;
    case TraceRecordKind::sample:
      read_sample(in);
      ++sample_count_;
      break;
    case TraceRecordKind::scan: {
      const bool is_kept = extent_ != TraceExtent::samples;
      const auto scan = read_fields<TraceScan>(in, is_kept ? &storage_ : nullptr);
      if (scan.robot >= world_.robot_count) in.fail("a scan of an unknown robot");
      if (is_kept) scans_.push_back(scan);
      break;
    }
    case TraceRecordKind::trajectory:
      read_annotation(in, trajectories_);
      break;
    case TraceRecordKind::note:
      read_annotation(in, notes_);
      break;
    case TraceRecordKind::end: {
      const auto read = read_fields<TraceEnd>(in, &storage_);
      if (read.end.robot_count != world_.robot_count) in.fail("an end record with another number of robots");
      end_ = read.end;
      end_.struct_size = sizeof(dmrp_trial_end);
      reason_ = read.reason;
      ended_ = true;
      break;
    }
    default:
      throw TraceError(record.offset - 1, "the kind of the record is unknown");
  }
}

void TraceReader::read_world(RecordCursor& in) {
  world_ = read_fields<TraceWorld>(in, &storage_).world;
  world_.struct_size = sizeof(dmrp_world);
  waypoints_.resize(world_.robot_count);
}

void TraceReader::read_plan(RecordCursor& in) {
  auto made = read_fields<TracePlan>(in, &storage_);
  made.plan.struct_size = sizeof(dmrp_plan);
  if (made.plan.path_count != 0 && made.plan.path_count != world_.robot_count)
    in.fail("a plan without a path for every robot");
  if (made.plan.path_count > 0 && plan_of_revision(made.plan.revision)) in.fail("a second plan of this revision");
  plans_.push_back(made);
}

template <class Annotation>
void TraceReader::read_annotation(RecordCursor& in, std::vector<Annotation>& annotations) {
  const bool is_kept = extent_ == TraceExtent::everything;
  const auto annotation = read_fields<Annotation>(in, is_kept ? &storage_ : nullptr);
  if (is_kept) annotations.push_back(annotation);
}

// Overwrites the previous sample.
void TraceReader::read_sample(RecordCursor& in) {
  sample_storage_.release();
  const auto read = read_fields<TraceSample>(in, &sample_storage_);
  sample_ = read.sample;
  sample_.struct_size = sizeof(dmrp_sample);
  if (read.plan_revision != 0) {
    sample_.plan = plan_of_revision(read.plan_revision);
    if (!sample_.plan) in.fail("the plan of the sample does not precede it");
  }
  if (sample_.robot_count != world_.robot_count) in.fail("a sample with another number of robots");
  contacts_.clear();
  for (const dmrp_contact& contact : std::span(sample_.contacts, sample_.contact_count)) {
    if (!is_known(contact)) continue;
    check_contact(in, contact, world_, sample_.person_count);
    contacts_.push_back(contact);
  }
  sample_.contacts = contacts_.data();
  sample_.contact_count = static_cast<std::uint32_t>(contacts_.size());
  const auto is_robot_or_nobody = [&](std::uint32_t robot) {
    return robot < world_.robot_count || robot == DMRP_NOBODY;
  };
  for (const dmrp_call& call : std::span(sample_.calls, sample_.call_count))
    if (call.robot >= world_.robot_count && call.robot != DMRP_ALL_ROBOTS) in.fail("a call for an unknown robot");
  for (const dmrp_robot_event& event : std::span(sample_.events, sample_.event_count))
    if (event.robot >= world_.robot_count || !is_robot_or_nobody(event.other)) in.fail("an event of an unknown robot");
  read_routes(in, read);
}

void TraceReader::read_routes(RecordCursor& in, const TraceSample& read) {
  paths_.clear();
  routes_.clear();
  paths_.reserve(read.route_count);
  for (const TraceRoute& route : std::span(read.routes, read.route_count)) {
    if (route.robot >= world_.robot_count) in.fail("a route of an unknown robot");
    if (!routes_.empty() && route.robot <= routes_.back().robot) in.fail("routes that are not ordered by robot");
    std::vector<dmrp_waypoint>& waypoints = waypoints_[route.robot];
    if (route.kept > waypoints.size()) in.fail("a route that keeps more than there was");
    waypoints.resize(route.kept);
    waypoints.insert(waypoints.end(), route.waypoints, route.waypoints + route.count);
    paths_.push_back({sizeof(dmrp_path), static_cast<std::uint32_t>(waypoints.size()), sizeof(dmrp_waypoint),
                      route.path_flags, waypoints.data()});
    routes_.push_back({route.robot, route.update_flags, &paths_.back()});
  }
  sample_.routes = routes_.data();
  sample_.route_count = static_cast<std::uint32_t>(routes_.size());
  sample_.route_stride = sizeof(dmrp_route);
}

void TraceReader::rewind() {
  records_.rewind();
  for (auto& waypoints : waypoints_) waypoints.clear();
}

const dmrp_sample* TraceReader::next_sample() {
  while (const auto record = records_.next()) {
    if (record->kind != TraceRecordKind::sample) continue;
    RecordCursor in(record->body, record->offset);
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
