// SPDX-License-Identifier: MIT
// occupancy.hpp: the positions and diagonals of all robots over time, to count and list conflicts with a path.
//
// Paths are added and removed one by one, so changing from one node of the constraint tree to another costs only the
// paths that differ.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

#include "planners/ecbs8/step_cost.hpp"

namespace dmrp::planners::ecbs8 {

// Two robots whose steps exclude each other.
struct Conflict {
  enum class Kind : std::uint8_t {
    vertex,  // both are at `location` at time t
    edge,    // they swap along the straight edge between `location` < `other`, arriving at time t
    corner,  // their diagonals, arriving at time t, cross the corner whose lower left cell is `location`
    pass,    // a is at `location` at time t, beside a diagonal of b that begins or ends then
  };
  Kind kind = Kind::vertex;
  std::int32_t a = -1;
  std::int32_t b = -1;
  Location location = nowhere;
  Location other = nowhere;
  std::int32_t t = 0;
  bool is_first = false;  // of the pair's conflicts
};

class Occupancy {
 public:
  Occupancy(const Graph& graph, std::size_t agent_count);

  // Replaces an agent's path; an empty path removes the agent. The table keeps the view, not a copy. No two agents may
  // end at the same location.
  void set(std::int32_t agent, PathView path);
  PathView path(std::int32_t agent) const { return paths_[static_cast<std::size_t>(agent)]; }

  // From this time on all robots rest.
  std::int32_t rest_from() const { return row_count_ - 1; }

  // The approximate number of robots with which a move (d is no_direction: a wait) that arrives at time t conflicts;
  // zero if and only if there is no conflict.
  std::int32_t count(Location from, Location to, Direction d, std::int32_t t) const;

  // Appends the conflicts of `agent`, which is not in the table, by ascending time: at most one for each robot and
  // step.
  void list(std::int32_t agent, PathView path, std::vector<Conflict>& out);

 private:
  using Link = std::uint16_t;  // an agent plus one; zero ends a list
  struct Cell {
    Link here;     // robots that are here before they rest
    Link passing;  // robots whose diagonals pass beside this cell and arrive now
  };
  struct FreeCells {
    void operator()(Cell* cells) const { std::free(cells); }
  };
  // The successors of an agent in the lists of one time: of its cell, and of both cells beside its diagonal.
  struct Links {
    Link here;
    std::array<Link, 2> passing;
  };
  // One agent's step.
  struct Step {
    Location from;
    Location to;
    bool is_diagonal;
    std::array<Location, 2> beside;

    bool is_beside(Location location) const { return is_diagonal && (location == beside[0] || location == beside[1]); }
  };

  Cell& cell(Location location, std::int32_t t) { return rows_[static_cast<std::size_t>(t)][location]; }
  const Cell& cell(Location location, std::int32_t t) const { return rows_[static_cast<std::size_t>(t)][location]; }
  bool rests_at(Location location, std::int32_t t) const { return rest_time_[static_cast<std::size_t>(location)] <= t; }
  Links& links(std::int32_t agent, std::int32_t t) {
    return links_[static_cast<std::size_t>(agent)][static_cast<std::size_t>(t)];
  }
  const Links& links(std::int32_t agent, std::int32_t t) const {
    return links_[static_cast<std::size_t>(agent)][static_cast<std::size_t>(t)];
  }
  Step step_of(PathView path, std::int32_t t) const;
  Step step_of(Location from, Location to, Direction d) const;

  bool is_quiet(const Step& step, std::int32_t t) const;
  // visit(agent)
  template <class Visit>
  void visit_here(Location location, std::int32_t t, Visit visit) const;
  template <class Visit>
  void visit_passing(Location location, std::int32_t t, Visit visit) const;
  // Calls visit(agent) for each agent that conflicts with the step that arrives at time t, possibly more than once.
  template <class Visit>
  void visit_met(const Step& step, std::int32_t t, Visit visit) const;
  bool classify(std::int32_t agent, const Step& step, std::int32_t other, std::int32_t t, Conflict& out) const;

  void add_rows(std::int32_t count);
  void put_in(std::int32_t agent, PathView path);
  void take_out(std::int32_t agent);
  void unlink_here(std::int32_t agent, Location location, std::int32_t t);
  void unlink_passing(std::int32_t agent, Location location, std::int32_t t, std::size_t side);

  const Graph& graph_;
  std::size_t location_count_;
  std::int32_t row_count_ = 0;
  std::vector<Cell*> rows_;                                 // by time; each row by location
  std::vector<std::unique_ptr<Cell[], FreeCells>> blocks_;  // memory of the rows
  std::vector<std::vector<Links>> links_;                   // by agent and time
  std::vector<std::int32_t> rest_time_;                     // by location: from when on a robot rests there
  std::vector<std::int32_t> rest_agent_;
  std::vector<PathView> paths_;
  std::vector<std::int32_t> met_at_;  // scratch of list(): by agent, the last step with a conflict
};

}  // namespace dmrp::planners::ecbs8
