// SPDX-License-Identifier: MIT
#include "host/report/replay/replay_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "host/report/replay/replay_contacts.hpp"
#include "host/report/replay/replay_numbers.hpp"
#include "host/report/replay/replay_scans.hpp"
#include "host/report/replay/replay_tracks.hpp"
#include "host/report/replay/replay_world.hpp"

namespace dmrp::host {
namespace {

using nlohmann::json;

// The tracks and contacts, from the samples.
struct Tracks {
  std::vector<std::int64_t> times_ms;
  std::vector<RobotTrack> robots;
  PeopleTracks people;
  Runs plan;
  ReplayContacts contacts;
};

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
  trace.rewind();
  if (trace.sample_count() == 0) keep_start(tracks, trace.world());
  std::int64_t next_ns = 0;
  for (std::size_t left = trace.sample_count(); left > 0; --left) {
    const dmrp_sample& sample = *trace.next_sample();
    tracks.contacts.observe(sample);
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

void write_end_of_robot(json& robot, const dmrp_robot_end& end) {
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
  if (end.culprit != DMRP_NOBODY) robot["culprit"] = end.culprit;
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
    if (json scans = replay_scans(trace.scans(), i, tracks.times_ms); !scans.is_null())
      robot["scans"] = std::move(scans);
    if (const dmrp_trial_end* end = trace.end()) write_end_of_robot(robot, end->robots[i]);
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
