// SPDX-License-Identifier: MIT
#include "core/trace/trace_reader.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <type_traits>

#include "core/bytes/trace_bytes.hpp"

namespace dmrp::core {
namespace {

// Bytes that one element takes in a record, at least: bounds for damaged counts.
constexpr std::size_t robot_bytes = 4 + 4 + 24 + 48 + 20 + 4;
constexpr std::size_t goal_bytes = 56;
constexpr std::size_t shape_bytes = 4 + 4 + 16 + 8 + 8 + 4;
constexpr std::size_t waypoint_bytes = 36;
constexpr std::size_t statistic_bytes = 12;
constexpr std::size_t call_bytes = 20;
constexpr std::size_t robot_end_bytes = 16;

using Storage = std::pmr::monotonic_buffer_resource;

// `count` zeroed elements that live as long as the storage; null for none.
template <class Element>
Element* allocate(Storage& storage, std::size_t count) {
  static_assert(std::is_trivially_destructible_v<Element>);
  if (count == 0) return nullptr;
  void* memory = storage.allocate(count * sizeof(Element), alignof(Element));
  auto* elements = static_cast<Element*>(memory);
  std::uninitialized_value_construct_n(elements, count);
  return elements;
}

template <class Value>
const Value* take_stored(ByteCursor& in, Storage& storage, std::size_t count) {
  Value* values = allocate<Value>(storage, count);
  in.take_array(values, count);
  return values;
}

const char* take_stored_text(ByteCursor& in, Storage& storage) {
  const std::string_view text = in.take_text();
  char* copy = allocate<char>(storage, text.size() + 1);
  std::copy(text.begin(), text.end(), copy);
  return copy;
}

const dmrp_limits* take_limits(ByteCursor& in, Storage& storage) {
  auto* limits = allocate<dmrp_limits>(storage, 1);
  limits->struct_size = sizeof(dmrp_limits);
  for (double* value :
       {&limits->v_min, &limits->v_max, &limits->v_y_max, &limits->omega_max, &limits->a_max, &limits->alpha_max})
    *value = in.take<double>();
  return limits;
}

const dmrp_footprint* take_footprint(ByteCursor& in, Storage& storage) {
  auto* footprint = allocate<dmrp_footprint>(storage, 1);
  footprint->struct_size = sizeof(dmrp_footprint);
  footprint->radius_m = in.take<double>();
  footprint->inscribed_radius_m = in.take<double>();
  footprint->vertex_count = in.take_count(sizeof(dmrp_vec2));
  footprint->vertices = take_stored<dmrp_vec2>(in, storage, footprint->vertex_count);
  return footprint;
}

dmrp_robot take_robot(ByteCursor& in, Storage& storage) {
  dmrp_robot robot{};
  robot.name = take_stored_text(in, storage);
  robot.kinematics = in.take<std::uint32_t>();
  robot.start = in.take<dmrp_pose>();
  robot.limits = take_limits(in, storage);
  robot.footprint = take_footprint(in, storage);
  robot.goal_count = in.take_count(goal_bytes);
  robot.goal_stride = sizeof(dmrp_goal);
  auto* goals = allocate<dmrp_goal>(storage, robot.goal_count);
  robot.goals = goals;
  for (std::uint32_t i = 0; i < robot.goal_count; ++i) {
    goals[i].pose = in.take<dmrp_pose>();
    goals[i].tolerance_m = in.take<double>();
    goals[i].tolerance_rad = in.take<double>();
    goals[i].tolerance_speed = in.take<double>();
    goals[i].settle_ns = in.take<std::int64_t>();
  }
  return robot;
}

dmrp_shape take_shape(ByteCursor& in, Storage& storage) {
  dmrp_shape shape{};
  shape.name = take_stored_text(in, storage);
  shape.kind = in.take<std::uint32_t>();
  if (shape.kind != DMRP_SHAPE_CIRCLE && shape.kind != DMRP_SHAPE_POLYGON) in.fail("a shape of unknown kind");
  shape.center = in.take<dmrp_vec2>();
  shape.radius_m = in.take<double>();
  shape.height_m = in.take<double>();
  shape.vertex_count = in.take_count(sizeof(dmrp_vec2));
  shape.vertices = take_stored<dmrp_vec2>(in, storage, shape.vertex_count);
  return shape;
}

bool take_presence(ByteCursor& in) {
  const auto presence = in.take<std::uint8_t>();
  if (presence > 1) in.fail("neither present nor absent");
  return presence == 1;
}

template <class Value>
const Value* take_optional(ByteCursor& in, Storage& storage, std::size_t count) {
  if (!take_presence(in)) return nullptr;
  in.require(count, sizeof(Value));
  return take_stored<Value>(in, storage, count);
}

const dmrp_grid* take_grid(ByteCursor& in, Storage& storage) {
  if (!take_presence(in)) return nullptr;
  auto* grid = allocate<dmrp_grid>(storage, 1);
  grid->struct_size = sizeof(dmrp_grid);
  grid->width = in.take<std::uint32_t>();
  grid->height = in.take<std::uint32_t>();
  grid->resolution_m = in.take<double>();
  grid->origin = in.take<dmrp_vec2>();
  const std::size_t cells = std::size_t{grid->width} * grid->height;
  grid->free = take_optional<std::uint8_t>(in, storage, cells);
  grid->edges = take_optional<std::uint8_t>(in, storage, cells);
  grid->clearance = take_optional<float>(in, storage, cells);
  return grid;
}

dmrp_world take_world(ByteCursor& in, Storage& storage) {
  dmrp_world world{};
  world.struct_size = sizeof(dmrp_world);
  world.self = -1;
  world.person_count = in.take<std::uint32_t>();
  world.lower = in.take<dmrp_vec2>();
  world.upper = in.take<dmrp_vec2>();
  world.step_ns = in.take<std::int64_t>();
  world.control_period_ns = in.take<std::int64_t>();
  world.time_limit_ns = in.take<std::int64_t>();
  world.call_budget_ns = in.take<std::int64_t>();

  world.robot_count = in.take_count(robot_bytes);
  world.robot_stride = sizeof(dmrp_robot);
  auto* robots = allocate<dmrp_robot>(storage, world.robot_count);
  world.robots = robots;
  for (std::uint32_t i = 0; i < world.robot_count; ++i) robots[i] = take_robot(in, storage);

  world.shape_count = in.take_count(shape_bytes);
  world.shape_stride = sizeof(dmrp_shape);
  auto* shapes = allocate<dmrp_shape>(storage, world.shape_count);
  world.shapes = shapes;
  for (std::uint32_t i = 0; i < world.shape_count; ++i) shapes[i] = take_shape(in, storage);

  world.segment_count = in.take_count(sizeof(dmrp_segment));
  world.segments = take_stored<dmrp_segment>(in, storage, world.segment_count);
  world.planning_grid = take_grid(in, storage);
  world.walking_grid = take_grid(in, storage);
  return world;
}

dmrp_path take_path(ByteCursor& in, Storage& storage) {
  dmrp_path path{};
  path.struct_size = sizeof(dmrp_path);
  path.count = in.take_count(waypoint_bytes);
  path.stride = sizeof(dmrp_waypoint);
  auto* waypoints = allocate<dmrp_waypoint>(storage, path.count);
  path.waypoints = waypoints;
  for (std::uint32_t i = 0; i < path.count; ++i) {
    waypoints[i].x = in.take<double>();
    waypoints[i].y = in.take<double>();
    waypoints[i].theta = in.take<double>();
    waypoints[i].t_ns = in.take<std::int64_t>();
    waypoints[i].goal_index = in.take<std::uint32_t>();
  }
  return path;
}

TracePlan take_plan(ByteCursor& in, Storage& storage, std::uint32_t robot_count) {
  TracePlan made;
  made.made_at_ns = in.take<std::int64_t>();
  dmrp_plan& plan = made.plan;
  plan.struct_size = sizeof(dmrp_plan);
  plan.revision = in.take<std::uint64_t>();
  plan.from_ns = in.take<std::int64_t>();
  plan.step_duration_ns = in.take<std::int64_t>();
  plan.planning_ns = in.take<std::int64_t>();
  plan.status = in.take<std::int32_t>();
  made.conflicts = in.take<std::uint32_t>();

  plan.path_count = in.take_count(sizeof(std::uint32_t));
  if (plan.path_count != 0 && plan.path_count != robot_count) in.fail("a plan without a path for every robot");
  plan.path_stride = sizeof(dmrp_path);
  auto* paths = allocate<dmrp_path>(storage, plan.path_count);
  plan.paths = paths;
  for (std::uint32_t i = 0; i < plan.path_count; ++i) paths[i] = take_path(in, storage);

  plan.statistic_count = in.take_count(statistic_bytes);
  plan.statistic_stride = sizeof(dmrp_statistic);
  auto* statistics = allocate<dmrp_statistic>(storage, plan.statistic_count);
  plan.statistics = statistics;
  for (std::uint32_t i = 0; i < plan.statistic_count; ++i) {
    statistics[i].name = take_stored_text(in, storage);
    statistics[i].value = in.take<double>();
  }
  return made;
}

// Metrics index with these without asking again.
void check_contact(const ByteCursor& in, const dmrp_contact& contact, const dmrp_world& world,
                   std::uint32_t person_count) {
  const std::uint32_t others = contact.kind == DMRP_CONTACT_STATIC   ? world.shape_count + 1
                               : contact.kind == DMRP_CONTACT_ROBOT  ? world.robot_count
                               : contact.kind == DMRP_CONTACT_PERSON ? person_count
                                                                     : 0;
  if (contact.a >= world.robot_count || contact.b >= others) in.fail("a contact of unknown bodies");
}

dmrp_call take_call(ByteCursor& in) {
  dmrp_call call{};
  call.kind = in.take<std::uint32_t>();
  call.robot = in.take<std::uint32_t>();
  call.status = in.take<std::int32_t>();
  call.duration_ns = in.take<std::int64_t>();
  return call;
}

dmrp_trial_end take_end(ByteCursor& in, Storage& storage, std::uint32_t robot_count) {
  dmrp_trial_end end{};
  end.struct_size = sizeof(dmrp_trial_end);
  end.ending = in.take<std::uint32_t>();
  end.t_ns = in.take<std::int64_t>();
  end.robot_count = in.take_count(robot_end_bytes);
  if (end.robot_count != robot_count) in.fail("an end of another number of robots");
  end.robot_stride = sizeof(dmrp_robot_end);
  auto* robots = allocate<dmrp_robot_end>(storage, end.robot_count);
  end.robots = robots;
  for (std::uint32_t i = 0; i < end.robot_count; ++i) {
    robots[i].state = in.take<std::uint32_t>();
    robots[i].failure = in.take<std::uint32_t>();
    robots[i].arrival_ns = in.take<std::int64_t>();
  }
  return end;
}

// Elements that lie in the trace as they do in memory.
template <class Element>
void take_elements(ByteCursor& in, std::vector<Element>& elements) {
  elements.resize(in.take_count(sizeof(Element)));
  in.take_array(elements.data(), elements.size());
}

void take_calls(ByteCursor& in, std::vector<dmrp_call>& calls) {
  calls.resize(in.take_count(call_bytes));
  for (dmrp_call& call : calls) call = take_call(in);
}

}  // namespace

TraceReader::TraceReader(TraceRecords records, TraceExtent extent) : records_(std::move(records)), extent_(extent) {
  bool is_first = true;
  while (const auto record = records_.next()) {
    const std::size_t begin = record->offset - trace_record_prefix_bytes;
    if ((record->kind == TraceRecordKind::world) != is_first)
      throw TraceError(begin, "the world must come first, and once");
    if (ended_) throw TraceError(begin, "a record after the end");
    read_record(*record);
    is_first = false;
  }
  if (is_first) throw TraceError(0, "nothing is in it");
  rewind();
}

void TraceReader::read_record(const TraceRecord& record) {
  ByteCursor in(record.body, record.offset);
  switch (record.kind) {
    case TraceRecordKind::world:
      if (const auto version = in.take<std::uint32_t>(); version != trace_format_version)
        throw TraceError(record.offset,
                         "format version " + std::to_string(version) + ", not " + std::to_string(trace_format_version));
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
      throw TraceError(record.offset - 1, "a record of unknown kind");
  }
  if (!in.at_end()) in.fail("the record is longer than what it holds");
}
void TraceReader::read_plan(ByteCursor& in) {
  const TracePlan made = take_plan(in, storage_, world_.robot_count);
  if (made.plan.path_count > 0 && plan_of_revision(made.plan.revision)) in.fail("a second plan of this revision");
  plans_.push_back(made);
}

void TraceReader::read_scan(ByteCursor& in) {
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

void TraceReader::read_trajectory(ByteCursor& in) {
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

void TraceReader::read_note(ByteCursor& in) {
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

// Decodes into sample_, over the sample before.
void TraceReader::read_sample(ByteCursor& in) {
  sample_ = {};
  sample_.struct_size = sizeof(dmrp_sample);
  sample_.t_ns = in.take<std::int64_t>();
  sample_.dt_ns = in.take<std::int64_t>();
  sample_.control_tick = in.take<std::uint32_t>();
  const auto revision = in.take<std::uint64_t>();
  if (revision != 0) sample_.plan = plan_of_revision(revision);
  if (revision != 0 && !sample_.plan) in.fail("a sample under a plan that did not come before it");

  take_elements(in, robots_);
  if (robots_.size() != world_.robot_count) in.fail("a sample of another number of robots");
  take_elements(in, people_);
  take_elements(in, contacts_);
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
    ByteCursor in(record->body, record->offset);
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

// The only one with paths: attempts that gave none may have had the same revision.
const dmrp_plan* TraceReader::plan_of_revision(std::uint64_t revision) const {
  const auto found = std::find_if(plans_.rbegin(), plans_.rend(), [&](const TracePlan& made) {
    return made.plan.revision == revision && made.plan.path_count > 0;
  });
  return found == plans_.rend() ? nullptr : &found->plan;
}

}  // namespace dmrp::core
