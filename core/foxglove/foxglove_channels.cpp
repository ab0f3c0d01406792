// SPDX-License-Identifier: MIT
#include "core/foxglove/foxglove_channels.hpp"

#include <dmrp/descriptor.h>
#include <dmrp/ext/annotate.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/foxglove/foxglove_figures.hpp"
#include "core/foxglove/foxglove_schemas.hpp"

namespace dmrp::core {
namespace {

constexpr std::int64_t shown_every_ns = 100'000'000;
constexpr std::int64_t contact_shown_ns = 2'000'000'000;
constexpr std::int64_t prediction_shown_ns = 150'000'000;
constexpr std::int64_t min_event_shown_ns = 500'000'000;

std::string_view text_or(const char* text, std::string_view fallback) {
  return text && *text ? std::string_view(text) : fallback;
}

std::string numbered(const char* word, std::uint64_t number) {
  return word + std::to_string(number);
}

}  // namespace

FoxgloveChannels::FoxgloveChannels(McapWriter& file) : file_(file) {
  const std::uint16_t of_log = file.add_schema(log_schema());
  const std::uint16_t of_frames = file.add_schema(frame_transforms_schema());
  const std::uint16_t of_scene = file.add_schema(scene_update_schema());
  const auto scene = [&](const char* topic) { return file.add_channel({topic, "json", of_scene, {}}); };
  map_ = scene("/map");
  goals_ = scene("/goals");
  tf_ = file.add_channel({"/tf", "json", of_frames, {}});
  robots_channel_ = scene("/robots");
  people_ = scene("/people");
  plan_ = scene("/plan");
  contacts_ = scene("/contacts");
  predictions_ = scene("/predictions");
  log_ = file.add_channel({"/log", "json", of_log, {}});
  metric_log_ = file.add_channel({"/metric_events", "json", of_log, {}});
  metric_robots_ = scene("/metric_events/robots");
}

void FoxgloveChannels::world(const dmrp_world& world) {
  for (std::uint32_t i = 0; i < world.robot_count; ++i) {
    const dmrp_robot& robot = *DMRP_AT(dmrp_robot, world.robots, world.robot_stride, i);
    Robot& known = robots_.emplace_back();
    known.frame = numbered("robot_", i);
    known.name = text_or(robot.name, known.frame);
    known.radius_m = robot.footprint->radius_m;
    for (std::uint32_t p = 0; p < robot.footprint->part_count; ++p) {
      const dmrp_polygon& part = *DMRP_AT(dmrp_polygon, robot.footprint->parts, robot.footprint->part_stride, p);
      known.parts.emplace_back(part.vertices, part.vertices + part.vertex_count);
    }
    known.pose = robot.start;
  }
  put_map(world);
  put_goals(world);
  put_robots(0);
}

void FoxgloveChannels::put_map(const dmrp_world& world) {
  scene_.begin(0);
  entity_.clear();
  draw_border(entity_, world.lower, world.upper);
  scene_.add(entity_, "border", {});
  for (std::uint32_t i = 0; i < world.shape_count; ++i) {
    const dmrp_shape& shape = *DMRP_AT(dmrp_shape, world.shapes, world.shape_stride, i);
    const std::string id = numbered("shape_", i);
    shapes_.emplace_back(text_or(shape.name, id));
    entity_.clear();
    entity_.note("name", shapes_.back());
    draw_shape(entity_, shape);
    scene_.add(entity_, id, {});
  }
  file_.write(map_, 0, scene_.message());
}

void FoxgloveChannels::put_goals(const dmrp_world& world) {
  scene_.begin(0);
  for (std::uint32_t i = 0; i < world.robot_count; ++i) {
    const dmrp_robot& robot = *DMRP_AT(dmrp_robot, world.robots, world.robot_stride, i);
    entity_.clear();
    entity_.note("robot", robots_[i].name);
    for (std::uint32_t g = 0; g < robot.goal_count; ++g) {
      const dmrp_goal& goal = *DMRP_AT(dmrp_goal, robot.goals, robot.goal_stride, g);
      draw_goal(entity_, goal, i, robots_[i].name + (robot.goal_count > 1 ? numbered(" ", g + 1) : ""));
    }
    scene_.add(entity_, numbered("goals_", i), {});
  }
  file_.write(goals_, 0, scene_.message());
}

void FoxgloveChannels::put_robots(std::int64_t t_ns) {
  static constexpr const char* const states[] = {"active", "finished", "failed"};
  scene_.begin(t_ns);
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const Robot& robot = robots_[i];
    entity_.clear();
    entity_.note("name", robot.name);
    entity_.note("state", states[std::min<std::uint32_t>(robot.state, 2)]);
    draw_robot(entity_, {i, robot.name, robot.radius_m, robot.parts, robot.state});
    scene_.add(entity_, robot.frame, {robot.frame, true, 0});
  }
  file_.write(robots_channel_, t_ns, scene_.message());
}

void FoxgloveChannels::put_frames(std::int64_t t_ns) {
  json_.clear();
  json_.raw(R"({"transforms":[)");
  for (const Robot& robot : robots_) {
    json_.raw(&robot == robots_.data() ? R"({"timestamp":)" : R"(,{"timestamp":)");
    put_time(json_, t_ns);
    json_.raw(R"(,"parent_frame_id":"map","child_frame_id":)").string(robot.frame).raw(R"(,"translation":)");
    put_position(json_, robot.pose.x, robot.pose.y, 0.0);
    json_.raw(R"(,"rotation":)");
    put_rotation(json_, robot.pose.theta);
    json_.raw("}");
  }
  json_.raw("]}");
  file_.write(tf_, t_ns, json_.bytes());
}

// All people are one entity, so people who have left disappear without a deletion message.
void FoxgloveChannels::put_people(const dmrp_sample& sample) {
  scene_.begin(sample.t_ns);
  entity_.clear();
  for (std::uint32_t i = 0; i < sample.person_count; ++i)
    draw_person(entity_, *DMRP_AT(dmrp_person, sample.people, sample.person_stride, i));
  scene_.add(entity_, "people", {});
  file_.write(people_, sample.t_ns, scene_.message());
}

void FoxgloveChannels::plan(std::int64_t now_ns, const dmrp_plan& plan) {
  if (plan.path_count == 0) return put_log(log_, now_ns, Level::warning, "planner", "found no plan");
  put_log(log_, now_ns, Level::info, "planner",
          "plan " + std::to_string(plan.revision) + " found in " +
              std::to_string(static_cast<double>(plan.planning_ns) * 1e-6) + " ms");
  scene_.begin(now_ns);
  for (std::uint32_t i = 0; i < plan.path_count; ++i) {
    entity_.clear();
    entity_.note("robot", name_of(i));
    entity_.note("plan", std::to_string(plan.revision));
    draw_path(entity_, *DMRP_AT(dmrp_path, plan.paths, plan.path_stride, i), i);
    scene_.add(entity_, numbered("path_", i), {});
  }
  file_.write(plan_, now_ns, scene_.message());
}

void FoxgloveChannels::sample(const dmrp_sample& sample) {
  flush_trajectories();
  t_ns_ = sample.t_ns;
  bool changed = false;
  for (std::uint32_t i = 0; i < sample.robot_count; ++i) {
    const dmrp_robot_sample& robot = *DMRP_AT(dmrp_robot_sample, sample.robots, sample.robot_stride, i);
    changed = changed || robot.state != robots_[i].state;
    robots_[i].state = robot.state;
    robots_[i].pose = robot.pose;
  }
  if (changed) put_robots(t_ns_);
  for (std::uint32_t i = 0; i < sample.contact_count; ++i) {
    const dmrp_contact& contact = *DMRP_AT(dmrp_contact, sample.contacts, sample.contact_stride, i);
    if ((contact.flags & DMRP_CONTACT_BEGINS) != 0) put_contact(sample, contact);
  }
  if (shown_ns_ >= 0 && t_ns_ - shown_ns_ < shown_every_ns) return;
  shown_ns_ = t_ns_;
  if (!robots_.empty()) put_frames(t_ns_);
  if (sample.person_count > 0 || t_ns_ > 0) put_people(sample);
}

void FoxgloveChannels::put_contact(const dmrp_sample& sample, const dmrp_contact& contact) {
  std::string other;
  if (contact.kind == DMRP_CONTACT_ROBOT)
    other = name_of(contact.b);
  else if (contact.kind == DMRP_CONTACT_PERSON)
    other = numbered("person ", DMRP_AT(dmrp_person, sample.people, sample.person_stride, contact.b)->id);
  else
    other = contact.b < shapes_.size() ? shapes_[contact.b] : "the border";
  std::string text = name_of(contact.a) + " touches " + other;
  if (DMRP_STRIDE_HAS(dmrp_contact, sample.contact_stride, impact_speed) && !std::isnan(contact.impact_speed))
    text += " at " + std::to_string(contact.impact_speed) + " m/s";
  const bool fault_a = (contact.flags & DMRP_CONTACT_FAULT_A) != 0;
  const bool fault_b = (contact.flags & DMRP_CONTACT_FAULT_B) != 0;
  if (fault_a || fault_b)
    text += "; at fault: " + (fault_a ? name_of(contact.a) + (fault_b ? " and " + other : "") : other);
  put_log(log_, sample.t_ns, Level::warning, "contact", text);

  entity_.clear();
  entity_.note("contact", text);
  draw_contact(entity_, contact.point);
  scene_.begin(sample.t_ns);
  scene_.add(entity_, numbered("contact_", contact_count_++), {"map", false, contact_shown_ns});
  file_.write(contacts_, sample.t_ns, scene_.message());
}

// Foxglove has no value for a beam without a hit: such beams get 0, a point inside the robot.
void FoxgloveChannels::scan(std::uint32_t robot, const dmrp_scan& scan) {
  assert(robot < robots_.size());
  if (scans_.empty()) {
    const std::uint16_t of_scan = file_.add_schema(laser_scan_schema());
    for (const Robot& known : robots_)
      scans_.push_back(file_.add_channel({"/" + known.frame + "/scan", "json", of_scan, {}}));
  }
  json_.clear();
  json_.raw(R"({"timestamp":)");
  put_time(json_, scan.t_ns);
  json_.raw(R"(,"frame_id":)").string(robots_[robot].frame).raw(R"(,"pose":)");
  put_pose(json_, {0.0, 0.0, figure_robot_height_m, 0.0});
  json_.raw(R"(,"start_angle":)").number(scan.angle_min).raw(R"(,"end_angle":)");
  json_.number(scan.angle_min + scan.angle_increment * (scan.count - 1.0)).raw(R"(,"ranges":[)");
  for (std::uint32_t i = 0; i < scan.count; ++i)
    json_.raw(i > 0 ? "," : "").number(std::isfinite(scan.ranges[i]) ? static_cast<double>(scan.ranges[i]) : 0.0);
  json_.raw(R"(],"intensities":[]})");
  file_.write(scans_[robot], scan.t_ns, json_.bytes());
}

void FoxgloveChannels::trajectory(std::int64_t now_ns, AnnotationSource source, std::uint32_t role,
                                  std::span<const dmrp_pose> poses) {
  const bool more = trajectories_.t_ns == now_ns && trajectories_.role == role &&
                    trajectories_.source.robot == source.robot &&
                    trajectories_.source.plugin_kind == source.plugin_kind;
  if (!more) {
    flush_trajectories();
    trajectories_.t_ns = now_ns;
    trajectories_.source = source;
    trajectories_.role = role;
  }
  draw_trajectory(trajectories_.lines, poses, source.robot, role);
}

void FoxgloveChannels::flush_trajectories() {
  if (trajectories_.t_ns < 0) return;
  const char* what = trajectories_.role == DMRP_ANNOTATE_PREDICTED ? "predicted by " : "considered by ";
  scene_.begin(trajectories_.t_ns);
  scene_.add(trajectories_.lines, what + name_of(trajectories_.source), {"map", false, prediction_shown_ns});
  file_.write(predictions_, trajectories_.t_ns, scene_.message());
  trajectories_.lines.clear();
  trajectories_.t_ns = -1;
}

void FoxgloveChannels::note(std::int64_t now_ns, AnnotationSource source, std::string_view text) {
  put_log(log_, now_ns, Level::info, name_of(source), text);
}

void FoxgloveChannels::end(const dmrp_trial_end& end, std::string_view reason) {
  flush_trajectories();
  if (shown_ns_ >= 0 && shown_ns_ < t_ns_ && !robots_.empty()) put_frames(t_ns_);
  put_log(log_, end.t_ns, end.ending == DMRP_ENDING_ARRIVED ? Level::info : Level::warning, "trial", reason);
}

void FoxgloveChannels::metric_event(const EventMark& event) {
  std::string text(event.text);
  for (std::size_t i = 0; i < event.robots.size(); ++i) text += (i == 0 ? ": " : ", ") + name_of(event.robots[i]);
  put_log(metric_log_, event.from_ns, Level::info, event.metric, text);
  scene_.begin(event.from_ns);
  for (const std::uint32_t robot : event.robots) {
    if (robot >= robots_.size()) continue;
    entity_.clear();
    entity_.note("metric", event.metric);
    entity_.note("event", text);
    draw_halo(entity_, robots_[robot].radius_m);
    scene_.add(entity_, numbered("mark_", metric_figure_count_++),
               {robots_[robot].frame, true, std::max(event.to_ns - event.from_ns, min_event_shown_ns)});
  }
  if (!event.robots.empty()) file_.write(metric_robots_, event.from_ns, scene_.message());
}

void FoxgloveChannels::put_log(std::uint16_t channel, std::int64_t t_ns, Level level, std::string_view name,
                               std::string_view text) {
  json_.clear();
  json_.raw(R"({"timestamp":)");
  put_time(json_, t_ns);
  json_.raw(R"(,"level":)").integer(static_cast<int>(level)).raw(R"(,"message":)").string(text);
  json_.raw(R"(,"name":)").string(name).raw(R"(,"file":"","line":0})");
  file_.write(channel, t_ns, json_.bytes());
}

std::string FoxgloveChannels::name_of(std::uint32_t robot) const {
  return robot < robots_.size() ? robots_[robot].name : numbered("robot_", robot);
}

std::string FoxgloveChannels::name_of(AnnotationSource source) const {
  switch (source.plugin_kind) {
    case DMRP_KIND_GLOBAL_PLANNER:
      return "planner";
    case DMRP_KIND_PEDESTRIAN_MODEL:
      return "pedestrian model";
    default:
      return name_of(source.robot);
  }
}

}  // namespace dmrp::core
