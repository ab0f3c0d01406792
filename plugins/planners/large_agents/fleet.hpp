// SPDX-License-Identifier: MIT
// fleet.hpp: a planning problem of robots that differ: each has its own graph and its own body, and two robots can be in
// conflict on different cells (Li, Surynek, Felner, Ma, Kumar, Koenig: Multi-agent path finding for large agents, AAAI
// 2019).
#pragma once

#include <cstdlib>
#include <deque>
#include <dmrp/plugin.hpp>
#include <optional>
#include <string>
#include <vector>

#include "planners/large_agents/body.hpp"
#include "planners/mapf/problem.hpp"
#include "planners/mapf/stop_signal.hpp"
#include "planners/mapf/tour_table.hpp"

namespace dmrp::planners {

// Which cells and steps two kinds of body cannot share, as a table over offsets of cells.
// Entries are computed when they are first asked for. The bodies must outlive the relation.
class ConflictRelation {
 public:
  ConflictRelation(const Body& a, const Body& b, double cell_m);

  // Bodies that are more columns or rows apart do not overlap in the next step.
  std::int32_t reach() const { return reach_; }

  // Whether the bodies overlap during one step. `columns`, `rows`: from a's cell to b's cell at the beginning.
  bool overlap(std::int32_t columns, std::int32_t rows, Motion a_does, Motion b_does) {
    if (std::abs(columns) > reach_ || std::abs(rows) > reach_) return false;
    Entry& entry = entries_[index(columns, rows, a_does, b_does)];
    if (entry == Entry::unknown) entry = look_up(columns, rows, a_does, b_does);
    return entry == Entry::overlap;
  }

 private:
  enum class Entry : std::uint8_t { unknown, apart, overlap };

  std::size_t index(std::int32_t columns, std::int32_t rows, Motion a_does, Motion b_does) const {
    const auto side = static_cast<std::size_t>(2 * reach_ + 1);
    const std::size_t place =
        static_cast<std::size_t>(rows + reach_) * side + static_cast<std::size_t>(columns + reach_);
    return (place * motion_count + static_cast<std::size_t>(a_does)) * motion_count + static_cast<std::size_t>(b_does);
  }
  Entry look_up(std::int32_t columns, std::int32_t rows, Motion a_does, Motion b_does) const;

  const Body& a_;
  const Body& b_;
  double cell_m_;
  std::int32_t reach_;
  std::vector<Entry> entries_;
};

// An index of `Fleet::agents`.
using AgentIndex = std::int32_t;

// When two robots conflict in a step.
enum class Clash : std::uint8_t {
  none,
  at_end,  // they cannot be at these places together
  on_way,  // they can, but they swap cells or touch on the way
};

class Fleet {
 public:
  // Robots that are not active are obstacles: the graphs do not have the cells and moves on which a robot would touch
  // them.
  explicit Fleet(const PlanningProblem& problem);

  std::vector<Agent> agents;  // active robots; locations are numbers of the agent's own graph

  std::int32_t size() const { return static_cast<std::int32_t>(agents.size()); }
  const GridGraph& graph(AgentIndex agent) const { return kind(agent).graph; }

  // Whether two agents cannot be at these locations at the same time.
  bool exclude(AgentIndex a, Location at_a, AgentIndex b, Location at_b) const;

  // Of the steps from a0 to a1 and from b0 to b1 at the same time; a wait stays where it is.
  Clash clash(AgentIndex a, Location a0, Location a1, AgentIndex b, Location b0, Location b1) const {
    const Place& from_a = kind(a).places[index(a0)];
    const Place& from_b = kind(b).places[index(b0)];
    if (std::abs(from_a.column - from_b.column) > reach_ || std::abs(from_a.row - from_b.row) > reach_)
      return Clash::none;
    if (exclude(a, a1, b, b1)) return Clash::at_end;
    return touch_on_way(a, a0, a1, b, b0, b1) ? Clash::on_way : Clash::none;
  }

  // Two robots that cannot be at their starts together, or at their last goals; with the numbers that show it.
  std::optional<std::string> find_overlap() const;

 private:
  struct Place {
    std::int32_t column;
    std::int32_t row;
    Motion stands;
  };
  // Robots with one grid and one body.
  struct Kind {
    const dmrp_grid* grid;
    std::size_t body;
    GridGraph graph;
    std::vector<Place> places;  // by location
  };
  // A robot that is not active.
  struct Parked {
    std::uint32_t robot;
    std::size_t body;
    Place place;
  };
  // Where an active robot begins and ends.
  struct Ends {
    std::uint32_t robot;
    std::size_t body;
    Place start;
    Place goal;
  };

  static std::size_t index(Location location) { return static_cast<std::size_t>(location); }
  const Kind& kind(AgentIndex agent) const { return kinds_[kind_of_[static_cast<std::size_t>(agent)]]; }
  ConflictRelation& relation(std::size_t body_a, std::size_t body_b) const {
    return relations_[body_a * bodies_.size() + body_b];
  }
  bool touch_on_way(AgentIndex a, Location a0, Location a1, AgentIndex b, Location b0, Location b1) const;
  bool touch(std::size_t body_a, const Place& a, Motion a_does, std::size_t body_b, const Place& b,
             Motion b_does) const {
    return relation(body_a, body_b).overlap(b.column - a.column, b.row - a.row, a_does, b_does);
  }

  bool exclude(std::size_t body_a, const Place& a, std::size_t body_b, const Place& b) const;

  std::size_t body_of(const PlanningRobot& robot);
  std::size_t kind_of(const PlanningRobot& robot, std::size_t body);
  GridGraph graph_around_parked(const dmrp_grid& grid, std::size_t body) const;
  void note_ends(const PlanningRobot& robot, std::uint32_t number, std::size_t body);
  std::string describe(std::uint32_t robot_a, const Place& a, const char* verb, std::uint32_t robot_b,
                       const Place& b) const;

  double cell_m_;
  std::int32_t reach_ = 0;                          // cells; steps that begin farther apart do not clash
  std::deque<Body> bodies_;                         // all different; a deque, because relations refer to them
  mutable std::deque<ConflictRelation> relations_;  // by pair of bodies; tables that fill when they are read
  std::vector<Kind> kinds_;
  std::vector<std::size_t> kind_of_;  // by agent
  std::vector<Parked> parked_;
  std::vector<Ends> ends_;
  std::vector<double> radii_m_;  // by robot
};

// A fleet and what a planner needs to know of it before a search.
struct PreparedFleet {
  Fleet fleet;
  std::vector<TourTable> tables;  // one for each agent
  std::string obstruction;        // why there is no plan; empty if that is not known

  // The sum of the robots' costs alone.
  double lower_bound() const;
};

// Nothing if `stop` was raised.
std::optional<PreparedFleet> prepare_fleet(const PlanningProblem& problem, StopSignal& stop);

// Gives the host the paths of the agents and of the robots that are not active.
void write_paths(const PlanningProblem& problem, const Fleet& fleet, const std::vector<PathView>& paths,
                 PlanSink& sink);

}  // namespace dmrp::planners
