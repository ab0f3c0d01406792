// SPDX-License-Identifier: MIT
#include "host/report/replay/replay_data.hpp"

#include <dmrp/sample.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/segment.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "host/report/replay/replay_numbers.hpp"
#include "host/report/replay/replay_world.hpp"

namespace dmrp::host {

namespace {

using nlohmann::json;

constexpr std::size_t most_beams = 180;  // of a scan: others are left out

class RobotTrack {
 public:
  // `path`: the current path; may be null.
  void add(std::size_t sample, const dmrp_robot_sample& robot, const dmrp_path* path);

  // Adds the series to the robot's JSON object.
  void write_to(nlohmann::json& robot) &&;

 private:
  Deltas x_;
  Deltas y_;
  Deltas theta_;
  double unwrapped_theta_ = 0.0;
  Runs state_;
  Runs goal_;
  bool active_ = true;
  Deltas speed_;
  Deltas deviation_;  // -1 without a path
};

class PeopleTracks {
 public:
  void add(std::size_t sample, const dmrp_sample& people);
  nlohmann::json json() &&;

 private:
  // One person's presence, from entering to leaving.
  struct Visit {
    std::uint64_t id;
    std::uint32_t group;
    double radius_m;
    std::size_t from_sample;
    Deltas x;
    Deltas y;
  };
  std::vector<Visit> visits_;
  std::map<std::uint64_t, std::size_t> latest_;  // by id: index of the last visit
};

struct ReplayContact {
  std::uint32_t kind = 0;   // DMRP_CONTACT_*
  std::uint32_t robot = 0;  // `a` of the contact in the trace
  std::uint64_t other = 0;  // `b`; the id, not the index, of a person
  std::uint32_t flags = 0;  // DMRP_CONTACT_*, of the first sample
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;     // of the last sample
  double depth_m = 0.0;       // maximum
  dmrp_vec2 point{};          // at the beginning
  double impact_speed = 0.0;  // m/s; NaN: not known
};

// Turns the contacts of samples into events with beginning and end. Expects every sample in order.
class ReplayContacts {
 public:
  void observe(const dmrp_sample& sample);
  const std::vector<ReplayContact>& events() const { return events_; }  // by beginning

 private:
  using Pair = std::tuple<std::uint32_t, std::uint32_t, std::uint64_t>;  // kind, robot, other

  std::vector<ReplayContact> events_;
  std::map<Pair, std::size_t> latest_;  // index of the pair's last event
};

// The local routes of one robot: each as far as it was led around something when it was handed over.
class LedRoutes {
 public:
  // `route`: what the robot was handed in the sample. Nothing is kept of paths as planned, but that they end a route.
  void add(std::size_t sample, const dmrp_path& route, bool is_led);
  nlohmann::json json() && { return std::move(routes_); }

 private:
  nlohmann::json routes_ = nlohmann::json::array();
  bool follows_one_ = false;
};

// The tracks and contacts, from the samples.
struct Tracks {
  std::vector<std::int64_t> times_ms;
  std::vector<RobotTrack> robots;
  std::vector<LedRoutes> routes;  // by robot
  PeopleTracks people;
  Runs plan;
  ReplayContacts contacts;
};

std::int64_t microradians(double angle) {
  return std::llround(angle * 1e6);
}

// Differences between beams in centimetres; 0 for a beam without a hit.
void write_ranges(const core::TraceScan& scan, std::size_t every, std::vector<std::int64_t>& to) {
  std::int64_t last = 0;
  for (std::size_t i = 0; i < scan.ranges.size(); i += every) {
    const std::int64_t range = std::isfinite(scan.ranges[i]) ? std::llround(100.0 * scan.ranges[i]) : 0;
    to.push_back(range - last);
    last = range;
  }
}

// The scans of one robot; null if there are none. `times_ms`: times of the replay's samples. All scans of a robot have
// the same beams.
nlohmann::json replay_scans(const std::vector<core::TraceScan>& scans, std::uint32_t robot,
                            std::span<const std::int64_t> times_ms) {
  const core::TraceScan* first = nullptr;
  std::size_t every = 1;
  Deltas samples;
  std::vector<std::int64_t> ranges;
  for (const core::TraceScan& scan : scans) {
    const auto sample = std::lower_bound(times_ms.begin(), times_ms.end(), milliseconds(scan.t_ns));
    const bool is_kept = sample != times_ms.end() && *sample == milliseconds(scan.t_ns);
    if (scan.robot != robot || scan.ranges.empty() || !is_kept) continue;
    if (!first) {
      first = &scan;
      every = (scan.ranges.size() + most_beams - 1) / most_beams;
    }
    if (scan.ranges.size() != first->ranges.size()) continue;
    samples.add(sample - times_ms.begin());
    write_ranges(scan, every, ranges);
  }
  if (!first) return nullptr;
  return {{"first", microradians(first->angle_min)},
          {"step", microradians(first->angle_increment * static_cast<double>(every))},
          {"beams", (first->ranges.size() + every - 1) / every},
          {"samples", std::move(samples).json()},
          {"ranges", std::move(ranges)}};
}

dmrp_vec2 waypoint(const dmrp_path& path, std::uint32_t index) {
  return {path.waypoints[index].x, path.waypoints[index].y};
}

// The distance of a point from a path that is not empty.
double distance_to(const dmrp_path& path, dmrp_vec2 point) {
  double nearest = toolkit::squared_distance(waypoint(path, 0), point);
  for (std::uint32_t i = 1; i < path.count; ++i)
    nearest =
        std::min(nearest, toolkit::squared_distance(dmrp_segment{waypoint(path, i - 1), waypoint(path, i)}, point));
  return std::sqrt(nearest);
}

void RobotTrack::add(std::size_t sample, const dmrp_robot_sample& robot, const dmrp_path* path) {
  x_.add(thousandths(robot.pose.x));
  y_.add(thousandths(robot.pose.y));
  unwrapped_theta_ += sample == 0 ? robot.pose.theta : toolkit::difference(unwrapped_theta_, robot.pose.theta);
  theta_.add(thousandths(unwrapped_theta_));
  state_.add(sample, robot.state);
  goal_.add(sample, robot.goal_index);

  // the curves end with the robot's task
  if (!active_) return;
  active_ = robot.state == DMRP_ROBOT_ACTIVE;
  const double speed = std::hypot(robot.velocity.v_x, robot.velocity.v_y);
  speed_.add(thousandths(robot.velocity.v_x < 0.0 ? -speed : speed));
  const bool has_path = path && path->count > 0;
  deviation_.add(has_path ? thousandths(distance_to(*path, {robot.pose.x, robot.pose.y})) : -1);
}

void RobotTrack::write_to(nlohmann::json& robot) && {
  robot["x"] = std::move(x_).json();
  robot["y"] = std::move(y_).json();
  robot["theta"] = std::move(theta_).json();
  robot["state"] = std::move(state_).json();
  robot["goal"] = std::move(goal_).json();
  robot["speed"] = std::move(speed_).json();
  robot["deviation"] = std::move(deviation_).json();
}

void PeopleTracks::add(std::size_t sample, const dmrp_sample& people) {
  for (std::uint32_t i = 0; i < people.person_count; ++i) {
    const dmrp_person& person = people.people[i];
    const auto [latest, is_new] = latest_.try_emplace(person.id, visits_.size());
    const auto left_before = [&](const Visit& visit) { return visit.from_sample + visit.x.size() != sample; };
    if (is_new || left_before(visits_[latest->second])) {
      latest->second = visits_.size();
      visits_.push_back({person.id, person.group, person.radius_m, sample, {}, {}});
    }
    Visit& visit = visits_[latest->second];
    visit.x.add(thousandths(person.position.x));
    visit.y.add(thousandths(person.position.y));
  }
}

nlohmann::json PeopleTracks::json() && {
  nlohmann::json list = nlohmann::json::array();
  for (Visit& visit : visits_)
    list.push_back({{"id", visit.id},
                    {"group", visit.group},
                    {"radius", thousandths(visit.radius_m)},
                    {"from", visit.from_sample},
                    {"x", std::move(visit.x).json()},
                    {"y", std::move(visit.y).json()}});
  return list;
}

void LedRoutes::add(std::size_t sample, const dmrp_path& route, bool is_led) {
  if (!is_led && !follows_one_) return;
  follows_one_ = is_led;
  nlohmann::json& one = routes_.emplace_back(nlohmann::json{{"from", sample}});
  if (!is_led) return;
  Deltas x, y;
  for (std::uint32_t i = 0; i < route.count; ++i) {
    const dmrp_vec2 at = waypoint(route, i);
    x.add(thousandths(at.x));
    y.add(thousandths(at.y));
  }
  one["x"] = std::move(x).json();
  one["y"] = std::move(y).json();
}

void ReplayContacts::observe(const dmrp_sample& sample) {
  for (std::uint32_t i = 0; i < sample.contact_count; ++i) {
    const dmrp_contact& contact = sample.contacts[i];
    const std::uint64_t other = contact.kind == DMRP_CONTACT_PERSON ? sample.people[contact.b].id : contact.b;
    const auto [latest, first_of_pair] = latest_.try_emplace({contact.kind, contact.a, other}, events_.size());
    if (first_of_pair || (contact.flags & DMRP_CONTACT_BEGINS) != 0) {
      latest->second = events_.size();
      events_.push_back({contact.kind, contact.a, other, contact.flags, sample.t_ns, sample.t_ns, 0.0, contact.point,
                         contact.impact_speed});
    }
    ReplayContact& event = events_[latest->second];
    event.to_ns = sample.t_ns;
    event.depth_m = std::max(event.depth_m, contact.depth_m);
  }
}

std::int64_t index_of(const dmrp_plan* plan, const std::deque<core::TracePlan>& plans) {
  const auto found =
      std::find_if(plans.begin(), plans.end(), [plan](const core::TracePlan& made) { return &made.plan == plan; });
  return found == plans.end() ? -1 : found - plans.begin();
}

void keep_sample(Tracks& to, const dmrp_sample& sample, const std::deque<core::TracePlan>& plans) {
  const std::size_t index = to.times_ms.size();
  to.times_ms.push_back(milliseconds(sample.t_ns));
  for (std::uint32_t i = 0; i < sample.robot_count; ++i)
    to.robots[i].add(index, sample.robots[i], sample.plan ? &sample.plan->paths[i] : nullptr);
  to.people.add(index, sample);
  to.plan.add(index, index_of(sample.plan, plans));
}

void keep_routes(Tracks& to, const dmrp_sample& sample) {
  for (std::uint32_t i = 0; i < sample.route_count; ++i) {
    const dmrp_route& route = sample.routes[i];
    const std::span events(sample.events, sample.event_count);
    const bool is_led = std::any_of(events.begin(), events.end(), [&](const dmrp_robot_event& event) {
      return event.robot == route.robot && event.kind == DMRP_ROBOT_EVENT_ROUTE;
    });
    to.routes[route.robot].add(to.times_ms.size(), *route.path, is_led);
  }
}

// Without a plan there are no samples: one sample with the robots at their starts.
void keep_start(Tracks& to, const dmrp_world& world) {
  to.times_ms.push_back(0);
  for (std::uint32_t i = 0; i < world.robot_count; ++i) {
    dmrp_robot_sample robot{};
    robot.pose = world.robots[i].start;
    robot.state = DMRP_ROBOT_FAILED;
    to.robots[i].add(0, robot, nullptr);
  }
  to.plan.add(0, -1);
}

// Contacts use every sample; the tracks keep the first sample at or after each period and the last one.
Tracks follow(core::TraceReader& trace) {
  Tracks tracks;
  tracks.robots.resize(trace.world().robot_count);
  tracks.routes.resize(trace.world().robot_count);
  trace.rewind();
  if (trace.sample_count() == 0) keep_start(tracks, trace.world());
  std::int64_t next_ns = 0;
  for (std::size_t left = trace.sample_count(); left > 0; --left) {
    const dmrp_sample& sample = *trace.next_sample();
    tracks.contacts.observe(sample);
    keep_routes(tracks, sample);
    if (sample.t_ns < next_ns && left > 1) continue;
    keep_sample(tracks, sample, trace.plans());
    next_ns = (sample.t_ns / replay_period_ns + 1) * replay_period_ns;
  }
  return tracks;
}

json contacts_json(const ReplayContacts& contacts) {
  constexpr std::array<const char*, 4> kinds = {"", "static", "robot", "person"};  // by DMRP_CONTACT_*
  constexpr std::array<const char*, 4> faults = {"none", "robot", "other", "both"};
  json list = json::array();
  for (const ReplayContact& contact : contacts.events()) {
    const std::size_t fault = ((contact.flags & DMRP_CONTACT_FAULT_A) != 0 ? 1U : 0U) +
                              ((contact.flags & DMRP_CONTACT_FAULT_B) != 0 ? 2U : 0U);
    list.push_back({{"kind", kinds.at(contact.kind)},
                    {"robot", contact.robot},
                    {"other", contact.other},
                    {"from", milliseconds(contact.from_ns)},
                    {"to", milliseconds(contact.to_ns)},
                    {"at", {thousandths(contact.point.x), thousandths(contact.point.y)}},
                    {"depth", thousandths(contact.depth_m)},
                    {"fault", faults.at(fault)}});
    if (!std::isnan(contact.impact_speed)) list.back()["speed"] = thousandths(contact.impact_speed);
  }
  return list;
}

json events_json(const std::vector<MetricEvent>& events) {
  json list = json::array();
  for (const MetricEvent& event : events)
    list.push_back({{"metric", event.metric},
                    {"from", milliseconds(event.from_ns)},
                    {"to", milliseconds(event.to_ns)},
                    {"robots", event.robots},
                    {"text", event.text}});
  return list;
}

// What a metric says of why a robot failed, which knows more than the referee's class at the end: the event
// "robot 3 failed: stood after hitting another robot"; null without one.
const MetricEvent* failure_event(const TrialRecord& trial, std::uint32_t robot) {
  const auto found = std::find_if(trial.events.begin(), trial.events.end(), [&](const MetricEvent& event) {
    return event.text.starts_with("robot " + std::to_string(robot) + " failed: ");
  });
  return found == trial.events.end() ? nullptr : &*found;
}

void write_end_of_robot(json& robot, const dmrp_robot_end& end, const TrialRecord& trial, std::uint32_t index) {
  constexpr std::array<const char*, 11> failures = {"",
                                                    "time limit",
                                                    "oscillation",
                                                    "deadlock",
                                                    "no command",
                                                    "no plan",
                                                    "held behind another robot",
                                                    "circling",
                                                    "blocked by a person",
                                                    "blocked by a robot",
                                                    "stuck"};  // by DMRP_FAILURE_*
  if (end.failure != DMRP_FAILURE_NONE && end.failure < failures.size()) robot["failure"] = failures.at(end.failure);
  const MetricEvent* event = failure_event(trial, index);
  if (event) robot["failure"] = event->text.substr(event->text.find(": ") + 2);
  if (end.culprit != DMRP_NOBODY && (!event || event->robots.size() > 1)) robot["culprit"] = end.culprit;
  if (end.arrival_ns >= 0) robot["arrival"] = milliseconds(end.arrival_ns);
}

}  // namespace

std::string replay_json(core::TraceReader& trace, const TrialRecord& trial) {
  const dmrp_world& world = trace.world();
  Tracks tracks = follow(trace);
  json robots = json::array();
  for (std::uint32_t i = 0; i < world.robot_count; ++i) {
    json& robot = robots.emplace_back(replay_robot(world.robots[i]));
    std::move(tracks.robots[i]).write_to(robot);
    if (json routes = std::move(tracks.routes[i]).json(); !routes.empty()) robot["routes"] = std::move(routes);
    if (json scans = replay_scans(trace.scans(), i, tracks.times_ms); !scans.is_null())
      robot["scans"] = std::move(scans);
    if (const dmrp_trial_end* end = trace.end()) write_end_of_robot(robot, end->robots[i], trial, i);
  }
  Deltas times;
  for (const std::int64_t t_ms : tracks.times_ms) times.add(t_ms);
  json replay = {{"format", 1},
                 {"trial", trial.id},
                 {"times", std::move(times).json()},
                 {"world", replay_world(world)},
                 {"robots", std::move(robots)},
                 {"people", std::move(tracks.people).json()},
                 {"plans", replay_plans(trace.plans())},
                 {"plan", std::move(tracks.plan).json()},
                 {"contacts", contacts_json(tracks.contacts)},
                 {"events", events_json(trial.events)}};
  if (const dmrp_trial_end* end = trace.end())
    replay["end"] = {{"t", milliseconds(end->t_ns)}, {"reason", std::string(trace.reason())}};
  return replay.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace dmrp::host
