// SPDX-License-Identifier: MIT
#include "core/foxglove/foxglove_channels.hpp"

#include <dmrp/ext/annotate.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/foxglove/foxglove_schemas.hpp"

namespace dmrp::core {
namespace {

constexpr std::int64_t shown_every_ns = 100'000'000;
constexpr std::int64_t contact_shown_ns = 2'000'000'000;
constexpr std::int64_t prediction_shown_ns = 150'000'000;
constexpr std::size_t candidate_points = 8;  // roughly, of a trajectory that was only considered
constexpr std::int64_t least_mark_ns = 500'000'000;

constexpr double tall_m = 2.0;  // shapes this tall are walls, lower ones furniture
constexpr double robot_height_m = 0.4;
constexpr double person_height_m = 1.7;

// Colours that people with any colour vision tell apart (Okabe and Ito, 2008).
constexpr std::array<Color, 7> series{{{0.0, 0.447, 0.698, 1.0},
                                       {0.902, 0.624, 0.0, 1.0},
                                       {0.0, 0.62, 0.451, 1.0},
                                       {0.8, 0.475, 0.655, 1.0},
                                       {0.337, 0.706, 0.914, 1.0},
                                       {0.835, 0.369, 0.0, 1.0},
                                       {0.941, 0.894, 0.259, 1.0}}};
constexpr Color wall{0.45, 0.45, 0.48, 1.0};
constexpr Color furniture{0.72, 0.62, 0.49, 1.0};
constexpr Color border{0.3, 0.3, 0.33, 1.0};
constexpr Color person{0.55, 0.58, 0.62, 0.9};
constexpr Color given_up{0.25, 0.25, 0.25, 1.0};
constexpr Color alarm{0.85, 0.1, 0.1, 0.8};
constexpr Color amber{0.95, 0.7, 0.1, 0.35};
constexpr Color label{1.0, 1.0, 1.0, 1.0};

Color of_series(std::size_t index, double alpha = 1.0) {
  Color color = series[index % series.size()];
  color.a = alpha;
  return color;
}

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
  events_ = file.add_channel({"/metric_events", "json", of_log, {}});
  marks_ = scene("/metric_events/robots");
}

void FoxgloveChannels::world(const dmrp_world& world) {
  for (std::uint32_t i = 0; i < world.robot_count; ++i) {
    const dmrp_robot& robot = *DMRP_AT(dmrp_robot, world.robots, world.robot_stride, i);
    Robot& known = robots_.emplace_back();
    known.frame = numbered("robot_", i);
    known.name = text_or(robot.name, known.frame);
    known.radius_m = robot.footprint->radius_m;
    known.outline.assign(robot.footprint->vertices, robot.footprint->vertices + robot.footprint->vertex_count);
    known.pose = robot.start;
  }
  put_map(world);
  put_goals(world);
  put_robots(0);
}

void FoxgloveChannels::put_map(const dmrp_world& world) {
  scene_.begin(0);
  entity_.clear();
  const std::array<ScenePose, 4> corners{{{world.lower.x, world.lower.y, 0.0, 0.0},
                                          {world.upper.x, world.lower.y, 0.0, 0.0},
                                          {world.upper.x, world.upper.y, 0.0, 0.0},
                                          {world.lower.x, world.upper.y, 0.0, 0.0}}};
  entity_.line(corners, true, 0.08, border);
  scene_.add(entity_, "border", {});
  for (std::uint32_t i = 0; i < world.shape_count; ++i) {
    const dmrp_shape& shape = *DMRP_AT(dmrp_shape, world.shapes, world.shape_stride, i);
    const std::string id = numbered("shape_", i);
    shapes_.emplace_back(text_or(shape.name, id));
    const Color& color = shape.height_m >= tall_m ? wall : furniture;
    entity_.clear();
    entity_.note("name", shapes_.back());
    if (shape.kind == DMRP_SHAPE_CIRCLE)
      entity_.cylinder({shape.center.x, shape.center.y, 0.0, 0.0}, shape.radius_m, shape.height_m, color);
    else
      entity_.prism({shape.vertices, shape.vertex_count}, 0.0, shape.height_m, color);
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
      entity_.cylinder({goal.pose.x, goal.pose.y, 0.0, 0.0}, std::max(goal.tolerance_m, 0.05), 0.02, of_series(i, 0.6));
      entity_.text({goal.pose.x, goal.pose.y, 0.3, 0.0}, 0.3, of_series(i),
                   robots_[i].name + (robot.goal_count > 1 ? numbered(" ", g + 1) : ""));
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
    const Color color =
        robot.state == DMRP_ROBOT_FAILED ? given_up : of_series(i, robot.state == DMRP_ROBOT_FINISHED ? 0.4 : 1.0);
    entity_.clear();
    entity_.note("name", robot.name);
    entity_.note("state", states[std::min<std::uint32_t>(robot.state, 2)]);
    if (robot.outline.empty())
      entity_.cylinder({}, robot.radius_m, robot_height_m, color);
    else
      entity_.prism(robot.outline, 0.0, robot_height_m, color);
    entity_.arrow({0.0, 0.0, robot_height_m, 0.0}, 1.6 * robot.radius_m, 0.25 * robot.radius_m, label);
    entity_.text({0.0, 0.0, robot_height_m + 0.35, 0.0}, 0.3, label, robot.name);
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

// One entity of all: who has left is gone without a word.
void FoxgloveChannels::put_people(const dmrp_sample& sample) {
  scene_.begin(sample.t_ns);
  entity_.clear();
  for (std::uint32_t i = 0; i < sample.person_count; ++i) {
    const dmrp_person& body = *DMRP_AT(dmrp_person, sample.people, sample.person_stride, i);
    entity_.cylinder({body.position.x, body.position.y, 0.0, 0.0}, body.radius_m, person_height_m, person);
  }
  scene_.add(entity_, "people", {});
  file_.write(people_, sample.t_ns, scene_.message());
}

void FoxgloveChannels::plan(std::int64_t now_ns, const dmrp_plan& plan) {
  if (plan.path_count == 0) return put_log(log_, now_ns, Level::warning, "planner", "found no plan");
  put_log(log_, now_ns, Level::info, "planner",
          "plan " + std::to_string(plan.revision) + " found in " +
              std::to_string(static_cast<double>(plan.planning_ns) * 1e-6) + " ms");
  scene_.begin(now_ns);
  std::vector<ScenePose> points;
  for (std::uint32_t i = 0; i < plan.path_count; ++i) {
    const dmrp_path& path = *DMRP_AT(dmrp_path, plan.paths, plan.path_stride, i);
    points.clear();
    for (std::uint32_t k = 0; k < path.count; ++k) {
      const dmrp_waypoint& waypoint = *DMRP_AT(dmrp_waypoint, path.waypoints, path.stride, k);
      points.push_back({waypoint.x, waypoint.y, 0.03, 0.0});
    }
    entity_.clear();
    entity_.note("robot", name_of(i));
    entity_.note("plan", std::to_string(plan.revision));
    entity_.line(points, false, 0.06, of_series(i, 0.8));
    scene_.add(entity_, numbered("path_", i), {});
  }
  file_.write(plan_, now_ns, scene_.message());
}

void FoxgloveChannels::sample(const dmrp_sample& sample) {
  put_told();
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
  const bool fault_a = (contact.flags & DMRP_CONTACT_FAULT_A) != 0;
  const bool fault_b = (contact.flags & DMRP_CONTACT_FAULT_B) != 0;
  if (fault_a || fault_b)
    text += "; at fault: " + (fault_a ? name_of(contact.a) + (fault_b ? " and " + other : "") : other);
  if ((contact.flags & DMRP_CONTACT_UNAVOIDABLE) != 0) text += "; not to be avoided";
  put_log(log_, sample.t_ns, Level::warning, "contact", text);

  entity_.clear();
  entity_.note("contact", text);
  entity_.sphere({contact.point.x, contact.point.y, 0.5 * robot_height_m, 0.0}, 0.3, alarm);
  scene_.begin(sample.t_ns);
  scene_.add(entity_, numbered("contact_", contact_count_++), {"map", false, contact_shown_ns});
  file_.write(contacts_, sample.t_ns, scene_.message());
}

// Foxglove knows no beam without a hit: those read 0, which is inside the robot.
void FoxgloveChannels::scan(std::uint32_t robot, const dmrp_scan& scan) {
  if (scans_.empty()) {
    const std::uint16_t of_scan = file_.add_schema(laser_scan_schema());
    for (const Robot& known : robots_)
      scans_.push_back(file_.add_channel({"/" + known.frame + "/scan", "json", of_scan, {}}));
  }
  json_.clear();
  json_.raw(R"({"timestamp":)");
  put_time(json_, scan.t_ns);
  json_.raw(R"(,"frame_id":)").string(robots_[robot].frame).raw(R"(,"pose":)");
  put_pose(json_, {0.0, 0.0, robot_height_m, 0.0});
  json_.raw(R"(,"start_angle":)").number(scan.angle_min).raw(R"(,"end_angle":)");
  json_.number(scan.angle_min + scan.angle_increment * (scan.count - 1.0)).raw(R"(,"ranges":[)");
  for (std::uint32_t i = 0; i < scan.count; ++i)
    json_.raw(i > 0 ? "," : "").number(std::isfinite(scan.ranges[i]) ? static_cast<double>(scan.ranges[i]) : 0.0);
  json_.raw(R"(],"intensities":[]})");
  file_.write(scans_[robot], scan.t_ns, json_.bytes());
}

void FoxgloveChannels::trajectory(std::int64_t now_ns, AnnotationSource source, std::uint32_t role,
                                  std::span<const dmrp_pose> poses) {
  const bool more = told_.t_ns == now_ns && told_.role == role && told_.source.robot == source.robot &&
                    told_.source.plugin_kind == source.plugin_kind;
  if (!more) {
    put_told();
    told_.t_ns = now_ns;
    told_.source = source;
    told_.role = role;
  }
  const bool predicted = role == DMRP_ANNOTATE_PREDICTED;
  const std::size_t stride = predicted ? 1 : std::max<std::size_t>(poses.size() / candidate_points, 1);
  std::vector<ScenePose> points;
  for (std::size_t i = 0; i < poses.size(); i += stride) points.push_back({poses[i].x, poses[i].y, 0.05, 0.0});
  told_.lines.line(points, false, predicted ? 0.05 : 0.02, of_series(source.robot, predicted ? 0.9 : 0.3));
}

void FoxgloveChannels::put_told() {
  if (told_.t_ns < 0) return;
  const char* what = told_.role == DMRP_ANNOTATE_PREDICTED ? "predicted by " : "considered by ";
  scene_.begin(told_.t_ns);
  scene_.add(told_.lines, what + name_of(told_.source), {"map", false, prediction_shown_ns});
  file_.write(predictions_, told_.t_ns, scene_.message());
  told_.lines.clear();
  told_.t_ns = -1;
}

void FoxgloveChannels::note(std::int64_t now_ns, AnnotationSource source, std::string_view text) {
  put_log(log_, now_ns, Level::info, name_of(source), text);
}

void FoxgloveChannels::end(const dmrp_trial_end& end, std::string_view reason) {
  put_told();
  if (shown_ns_ >= 0 && shown_ns_ < t_ns_ && !robots_.empty()) put_frames(t_ns_);
  put_log(log_, end.t_ns, end.ending == DMRP_ENDING_ARRIVED ? Level::info : Level::warning, "trial", reason);
}

void FoxgloveChannels::mark(const MetricMark& mark) {
  std::string text(mark.text);
  for (std::size_t i = 0; i < mark.robots.size(); ++i) text += (i == 0 ? ": " : ", ") + name_of(mark.robots[i]);
  put_log(events_, mark.from_ns, Level::info, mark.metric, text);
  scene_.begin(mark.from_ns);
  for (const std::uint32_t robot : mark.robots) {
    if (robot >= robots_.size()) continue;
    entity_.clear();
    entity_.note("metric", mark.metric);
    entity_.note("event", text);
    entity_.cylinder({0.0, 0.0, 0.01, 0.0}, 2.5 * robots_[robot].radius_m, 0.02, amber);
    scene_.add(entity_, numbered("mark_", mark_count_++),
               {robots_[robot].frame, true, std::max(mark.to_ns - mark.from_ns, least_mark_ns)});
  }
  if (!mark.robots.empty()) file_.write(marks_, mark.from_ns, scene_.message());
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
