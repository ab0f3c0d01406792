// SPDX-License-Identifier: MIT
#include "host/report/replay/replay_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/segment.hpp>
#include <utility>

namespace dmrp::host {
namespace {

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

}  // namespace

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

}  // namespace dmrp::host
