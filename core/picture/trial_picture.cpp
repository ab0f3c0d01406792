// SPDX-License-Identifier: MIT
#include "core/picture/trial_picture.hpp"

#include <algorithm>
#include <array>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::core {
namespace {

constexpr double least_step_m = 0.05;  // between the points of a way

std::vector<dmrp_vec2> points_of(const dmrp_path& path) {
  std::vector<dmrp_vec2> points;
  for (std::uint32_t i = 0; i < path.count; ++i) {
    const dmrp_waypoint& waypoint = *DMRP_AT(dmrp_waypoint, path.waypoints, path.stride, i);
    points.push_back({waypoint.x, waypoint.y});
  }
  return points;
}

dmrp_vec2 place_of(const dmrp_robot_sample& robot) {
  return {robot.pose.x, robot.pose.y};
}

const dmrp_robot_sample& robot_at(const dmrp_sample& sample, std::uint32_t i) {
  return *DMRP_AT(dmrp_robot_sample, sample.robots, sample.robot_stride, i);
}

const dmrp_person& person_at(const dmrp_sample& sample, std::uint32_t i) {
  return *DMRP_AT(dmrp_person, sample.people, sample.person_stride, i);
}

const dmrp_contact& contact_at(const dmrp_sample& sample, std::uint32_t i) {
  return *DMRP_AT(dmrp_contact, sample.contacts, sample.contact_stride, i);
}

void lengthen(std::vector<dmrp_vec2>& way, dmrp_vec2 to) {
  if (way.empty() || toolkit::distance(to, way.back()) >= least_step_m) way.push_back(to);
}

}  // namespace

TrialMap::TrialMap(const dmrp_world& world) : world_(world), robots_(world.robot_count) {}

void TrialMap::observe(const dmrp_sample& sample) {
  for (std::uint32_t i = 0; i < sample.robot_count; ++i) {
    Robot& robot = robots_[i];
    robot.last = robot_at(sample, i);
    lengthen(robot.driven, place_of(robot.last));
    if (robot.planned.empty() && sample.plan)
      robot.planned = points_of(*DMRP_AT(dmrp_path, sample.plan->paths, sample.plan->path_stride, i));
  }
  for (std::uint32_t i = 0; i < sample.person_count; ++i)
    lengthen(walks_[person_at(sample, i).id], person_at(sample, i).position);
  for (std::uint32_t i = 0; i < sample.contact_count; ++i)
    if (contact_at(sample, i).flags & DMRP_CONTACT_BEGINS) contacts_.push_back(contact_at(sample, i).point);
}

std::string TrialMap::document(PictureFormat format, std::string_view title) const {
  WorldPicture picture({format}, world_.lower, world_.upper, title);
  std::vector<Mark> marks = {Mark::wall, Mark::furniture, Mark::start, Mark::goal, Mark::robot, Mark::plan, Mark::way};
  picture.shapes(world_);
  for (const auto& [id, walk] : walks_) picture.line(Mark::walk, 0, walk);
  if (!walks_.empty()) marks.push_back(Mark::walk);
  for (std::size_t i = 0; i < robots_.size(); ++i) picture.line(Mark::plan, i, robots_[i].planned);
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const Robot& robot = robots_[i];
    if (robot.driven.empty()) continue;
    const dmrp_robot& known = *DMRP_AT(dmrp_robot, world_.robots, world_.robot_stride, i);
    for (std::uint32_t g = 0; g < known.goal_count; ++g)
      picture.goal(i, *known.footprint, DMRP_AT(dmrp_goal, known.goals, known.goal_stride, g)->pose);
    picture.line(Mark::way, i, robot.driven);
    picture.start(i, robot.driven.front());
    picture.robot(i, *known.footprint, robot.last.pose, robot.last.state);
    picture.number(i, *known.footprint, place_of(robot.last));
    if (robot.last.state == DMRP_ROBOT_FAILED && marks.back() != Mark::failed) marks.push_back(Mark::failed);
  }
  for (const dmrp_vec2 contact : contacts_) picture.contact(contact);
  if (!contacts_.empty()) marks.push_back(Mark::contact);
  picture.legend(marks);
  return picture.painter().document();
}

TrialFrames::TrialFrames(const dmrp_world& world, int width, int height, std::string_view title)
    : world_(world),
      still_({PictureFormat::frame, static_cast<double>(width), static_cast<double>(height)}, world.lower, world.upper,
             title),
      frame_({PictureFormat::frame, static_cast<double>(width), static_cast<double>(height)}, world.lower, world.upper,
             title) {
  constexpr std::array marks = {Mark::wall, Mark::furniture, Mark::robot,  Mark::goal,   Mark::plan,
                                Mark::way,  Mark::person,    Mark::failed, Mark::contact};
  still_.shapes(world);
  still_.legend(marks);
}

void TrialFrames::observe(const dmrp_sample& sample) {
  for (std::uint32_t i = 0; i < sample.robot_count; ++i) {
    const dmrp_vec2 at = place_of(robot_at(sample, i));
    if (i == places_.size()) places_.push_back(at);
    if (toolkit::distance(at, places_[i]) < least_step_m) continue;
    const std::array<dmrp_vec2, 2> step = {places_[i], at};
    still_.line(Mark::way, i, step);
    places_[i] = at;
  }
}

std::span<const std::uint8_t> TrialFrames::frame(const dmrp_sample& sample, std::string_view clock) {
  frame_.painter().copy(still_.painter());
  const auto known = [&](std::uint32_t i) -> const dmrp_robot& {
    return *DMRP_AT(dmrp_robot, world_.robots, world_.robot_stride, i);
  };
  for (std::uint32_t i = 0; i < sample.robot_count; ++i) {
    if (known(i).goal_count > 0) {
      const std::uint32_t goal = std::min(robot_at(sample, i).goal_index, known(i).goal_count - 1);
      frame_.goal(i, *known(i).footprint, DMRP_AT(dmrp_goal, known(i).goals, known(i).goal_stride, goal)->pose);
    }
    if (sample.plan)
      frame_.line(Mark::plan, i, points_of(*DMRP_AT(dmrp_path, sample.plan->paths, sample.plan->path_stride, i)));
  }
  for (std::uint32_t i = 0; i < sample.person_count; ++i) frame_.person(person_at(sample, i));
  for (std::uint32_t i = 0; i < sample.robot_count; ++i)
    frame_.robot(i, *known(i).footprint, robot_at(sample, i).pose, robot_at(sample, i).state);
  for (std::uint32_t i = 0; i < sample.robot_count; ++i)
    frame_.number(i, *known(i).footprint, place_of(robot_at(sample, i)));
  for (std::uint32_t i = 0; i < sample.contact_count; ++i) frame_.contact(contact_at(sample, i).point);
  frame_.clock(clock);
  return frame_.painter().frame();
}

}  // namespace dmrp::core
