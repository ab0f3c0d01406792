// SPDX-License-Identifier: MIT
#include "pedestrians/crowd/robot_reactions.hpp"

#include <cmath>
#include <dmrp/toolkit/grid_line.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <stdexcept>

namespace dmrp::pedestrians {

namespace {

// People see robots ahead up to this far, and answer anew once all have been farther than `parted_m` for `forgotten_s`.
constexpr double sight_m = 4.0;
constexpr double parted_m = 6.0;
constexpr double forgotten_s = 20.0;

// The gaps at which curious people stop before the robot and threatening people stand in its way.
constexpr double curious_gap_m = 0.8;
constexpr double threatening_gap_m = 0.4;

// Shares of the desired speed.
constexpr double curious_speed = 0.5;
constexpr double standing_speed = 0.01;

// Seconds that a reaction lasts: between these, drawn.
struct Lasting {
  double least_s, most_s;
};

Lasting lasting(std::uint32_t reaction) {
  switch (reaction) {
    case DMRP_REACTION_SURPRISED:
      return {3.0, 6.0};
    case DMRP_REACTION_CURIOUS:
      return {8.0, 16.0};
    case DMRP_REACTION_SCARED:
      return {6.0, 12.0};
    default:
      return {10.0, 20.0};  // threatening
  }
}

Wish walk_to(const Person& person, Vec2 place, double speed) {
  const Vec2 apart = place - person.position;
  const double near = std::min(toolkit::norm(apart), 1.0);  // slows down over the last metre
  return {toolkit::normalized(apart), std::max(speed * near, standing_speed) * person.desired_speed};
}

Wish wish_of(std::uint32_t reaction, const Person& person, const Agent& robot) {
  const Vec2 at = toolkit::position(robot.pose);
  const Vec2 toward = toolkit::normalized(at - person.position);
  const double touching_m = person.radius_m + robot.radius_m;
  if (reaction == DMRP_REACTION_SCARED) return {-toward, person.desired_speed};
  if (reaction == DMRP_REACTION_CURIOUS)
    return walk_to(person, at - (touching_m + curious_gap_m) * toward, curious_speed);
  if (reaction == DMRP_REACTION_THREATENING) {
    const Vec2 ahead = {std::cos(robot.pose.theta), std::sin(robot.pose.theta)};
    return walk_to(person, at + (touching_m + threatening_gap_m) * ahead, 1.0);
  }
  return {toward, standing_speed * person.desired_speed};  // surprised
}

}  // namespace

void RobotReactions::start(std::uint64_t seed, const toolkit::GridView& grid, const ReactionShares& shares) {
  seed_ = seed;
  grid_ = grid;
  shares_ = shares;
  const double sum = shares.surprised + shares.curious + shares.scared + shares.threatening;
  if (sum > 1.0 + 1e-9) throw std::invalid_argument("the shares of people who react to robots add up to more than 1");
  any_share_ = sum > 0.0;
  encounters_.clear();
}

std::uint32_t RobotReactions::of(const Person& person) const {
  if (person.reaction >= DMRP_REACTION_REGULAR && person.reaction <= DMRP_REACTION_THREATENING) return person.reaction;
  if (!any_share_) return DMRP_REACTION_UNSPECIFIED;
  double drawn = toolkit::Stream(seed_, "pedestrian.reaction", person.id).uniform();
  if ((drawn -= shares_.surprised) < 0.0) return DMRP_REACTION_SURPRISED;
  if ((drawn -= shares_.curious) < 0.0) return DMRP_REACTION_CURIOUS;
  if ((drawn -= shares_.scared) < 0.0) return DMRP_REACTION_SCARED;
  return drawn < shares_.threatening ? DMRP_REACTION_THREATENING : DMRP_REACTION_UNSPECIFIED;
}

bool RobotReactions::sees(const Person& person, Vec2 way, const Agent& robot) const {
  const Vec2 at = toolkit::position(robot.pose);
  return toolkit::distance(person.position, at) <= sight_m && toolkit::dot(way, at - person.position) > 0.0 &&
         toolkit::line_is_free(grid_, person.position, at);
}

std::optional<Wish> RobotReactions::answer(std::uint32_t reaction, const Person& person, Vec2 way,
                                           const Span<Agent>& robots, double step_s) {
  if (!is_answer(reaction)) return std::nullopt;
  const Agent* const robot = nearest(robots, [&](const Agent& each) {
    return toolkit::squared_distance(person.position, toolkit::position(each.pose));
  });
  if (robot == nullptr) return std::nullopt;
  auto known = encounters_.find(person.id);
  if (known == encounters_.end()) {
    if (!sees(person, way, *robot)) return std::nullopt;
    const Lasting time = lasting(reaction);
    toolkit::Stream random(seed_, "pedestrian.reaction_time", person.id);
    known = encounters_.emplace(person.id, Encounter{random.uniform(time.least_s, time.most_s), 0.0, true}).first;
  }
  Encounter& encounter = known->second;
  const bool is_away = toolkit::distance(person.position, toolkit::position(robot->pose)) > parted_m;
  encounter.away_s = is_away ? encounter.away_s + step_s : 0.0;
  encounter.is_seen = encounter.away_s < forgotten_s;
  encounter.remaining_s -= step_s;
  if (is_away || encounter.remaining_s < 0.0) return std::nullopt;
  return wish_of(reaction, person, *robot);
}

}  // namespace dmrp::pedestrians
