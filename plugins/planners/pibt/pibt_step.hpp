// SPDX-License-Identifier: MIT
// pibt_step.hpp: one step of all robots by priority inheritance with backtracking.
#pragma once

#include <array>
#include <cstdint>
#include <dmrp/toolkit/random.hpp>
#include <span>
#include <vector>

#include "planners/mapf/tour_table.hpp"

namespace dmrp::planners {

// Where all robots are, and on which leg of its tour each one got there.
struct Configuration {
  std::vector<Location> locations;
  std::vector<std::int32_t> legs;

  bool operator==(const Configuration&) const = default;
};

Configuration start_configuration(const Problem& problem);

// PIBT (Okumura, Machida, Defago, Tamura 2022): the robots choose their moves by priority, nearest to their goals
// first. A robot that stands in the way of another inherits its priority and has to move; where it cannot, the other
// one chooses again. With the swap of Okumura 2023: where two robots have to exchange their places in a narrow part of
// the map, the one with the higher priority first moves away from its goal and pulls the other one behind it.
class PibtStep {
 public:
  // A move that is given.
  struct Fixed {
    std::int32_t agent;
    Location to;
  };

  PibtStep(const Problem& problem, const std::vector<TourTable>& tables);

  // Moves all robots from one configuration to the next without a conflict. `order` has all agents, the highest
  // priority first; ties between moves are broken at random. False if that fails, which is possible with fixed moves
  // only, or where a robot has lost the way to its goal by moves that are open in one direction.
  bool step(const Configuration& from, std::span<const std::int32_t> order, std::span<const Fixed> fixed,
            toolkit::Stream& random, Configuration& to);

  // Whether the robot is at the end of its tour.
  bool rests(const Configuration& at, std::int32_t agent) const {
    const auto i = static_cast<std::size_t>(agent);
    const Agent& robot = problem_.agents[i];
    return at.locations[i] == robot.last_goal() && at.legs[i] == robot.last_leg();
  }

  // Steps to the end of the robot's tour from its place in the configuration.
  std::int32_t distance(const Configuration& at, std::int32_t agent) const {
    const auto i = static_cast<std::size_t>(agent);
    return tables_[i].distance(at.legs[i], at.locations[i]);
  }

 private:
  static constexpr std::int32_t nobody = -1;
  static constexpr std::size_t choices = GridGraph::direction_count + 1;

  // A robot that is choosing its move.
  struct Choice {
    std::int32_t agent;
    std::int32_t pulled;  // the robot that follows if the first choice succeeds, or nobody
    std::array<Location, choices> to;
    std::uint8_t count;
    std::uint8_t next;
  };

  // The neighboring places of two robots that move in a row.
  struct Line {
    Location rear;
    Location front;
  };
  enum class WayOn : std::uint8_t { corridor, branch, dead_end };

  bool set_fixed(std::span<const Fixed> fixed);
  bool choose(std::int32_t agent, toolkit::Stream& random);
  Choice begin_choice(std::int32_t agent, toolkit::Stream& random);
  void reserve(std::int32_t agent, Location to);
  void pull(const Choice& choice);
  std::int32_t find_swap(std::int32_t agent, Location first_choice) const;
  std::int32_t find_opponent(std::int32_t agent, Line line) const;
  bool block_each_other(std::int32_t rear, std::int32_t front, Line line) const;
  bool reaches_branch(Line line) const;
  WayOn advance(Line& line) const;
  bool is_parking_place(Location location) const;
  void clear(const Configuration& from);

  bool can_move(Location from, Location to) const;
  Location where(std::int32_t agent) const { return from_->locations[static_cast<std::size_t>(agent)]; }
  Location& next_of(std::int32_t agent) { return next_[static_cast<std::size_t>(agent)]; }
  Location next_of(std::int32_t agent) const { return next_[static_cast<std::size_t>(agent)]; }
  std::int32_t robot_at(Location location) const { return here_[static_cast<std::size_t>(location)]; }
  std::int32_t& taken_by(Location location) { return taken_[static_cast<std::size_t>(location)]; }
  std::int32_t steps_left(std::int32_t agent, Location location) const {
    const auto i = static_cast<std::size_t>(agent);
    return tables_[i].distance(legs_[i], location);
  }

  const Problem& problem_;
  const std::vector<TourTable>& tables_;
  std::vector<std::int32_t> degrees_;  // by location: the moves from it
  const Configuration* from_ = nullptr;
  std::vector<std::int32_t> legs_;   // of the step that is being chosen
  std::vector<std::int32_t> here_;   // by location: the robot there now
  std::vector<std::int32_t> taken_;  // by location: the robot there after the step
  std::vector<Location> next_;       // by agent: its choice, or nowhere
  std::vector<Choice> stack_;        // the robots that push each other
};

// The priorities of robots: those that have been on their way longest come first; of these the one that began farthest
// from its goal.
class Priorities {
 public:
  Priorities(const Problem& problem, const std::vector<TourTable>& tables);

  // The order of the agents, given the steps since each one was at rest.
  void sort(std::span<const std::int32_t> steps_underway, std::vector<std::int32_t>& order) const;

 private:
  std::vector<std::int32_t> by_distance_;  // agents, the farthest first
};

// One path for each agent along the configurations, without waits at its end.
std::vector<std::vector<Location>> paths_of(const std::vector<const Configuration*>& configurations,
                                            const std::vector<TourTable>& tables);

}  // namespace dmrp::planners
