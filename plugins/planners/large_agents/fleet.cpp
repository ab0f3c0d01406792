// SPDX-License-Identifier: MIT
#include "planners/large_agents/fleet.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dmrp::planners {

namespace {

std::string with_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f", value);
  return text;
}

std::string name_of(std::uint32_t robot) {
  return "robot " + std::to_string(robot);
}

// Where a robot that stands on the cell can head. It has one axis where it cannot turn and all its moves are along it.
Motion stands_on(const dmrp_grid& grid, std::size_t cell, const Body& body) {
  constexpr unsigned east_west = DMRP_EDGE_E | DMRP_EDGE_W;
  constexpr unsigned north_south = DMRP_EDGE_N | DMRP_EDGE_S;
  const unsigned edges = grid.edges[cell];
  if (body.parts.empty() || edges == 0 || !(grid.clearance[cell] < body.radius_m)) return Motion::stands_at_any_heading;
  if ((edges & ~east_west) == 0) return Motion::stands_east_west;
  if ((edges & ~north_south) == 0) return Motion::stands_north_south;
  return Motion::stands_at_any_heading;
}

std::array<std::int32_t, 2> cell_of(const dmrp_grid& grid, dmrp_vec2 point) {
  const auto number = [&](double distance, std::uint32_t count) {
    return std::clamp(static_cast<std::int32_t>(std::floor(distance / grid.resolution_m)), 0,
                      static_cast<std::int32_t>(count) - 1);
  };
  return {number(point.x - grid.origin.x, grid.width), number(point.y - grid.origin.y, grid.height)};
}

std::size_t index_of(const dmrp_grid& grid, std::int32_t column, std::int32_t row) {
  return static_cast<std::size_t>(row) * grid.width + static_cast<std::size_t>(column);
}

// The step from one place to another; the same for equal places.
template <class Place>
Motion motion_between(const Place& from, const Place& to) {
  if (to.column > from.column) return Motion::east;
  if (to.column < from.column) return Motion::west;
  if (to.row > from.row) return Motion::north;
  if (to.row < from.row) return Motion::south;
  return from.stands;
}

}  // namespace

ConflictRelation::ConflictRelation(const Body& a, const Body& b, double cell_m)
    : a_(a),
      b_(b),
      cell_m_(cell_m),
      // each may move by one cell toward the other
      reach_(static_cast<std::int32_t>(std::ceil((a.radius_m + b.radius_m) / cell_m)) + 2) {
  const auto side = static_cast<std::size_t>(2 * reach_ + 1);
  entries_.assign(side * side * motion_count * motion_count, Entry::unknown);
}

ConflictRelation::Entry ConflictRelation::look_up(std::int32_t columns, std::int32_t rows, Motion a_does,
                                                  Motion b_does) const {
  const dmrp_vec2 b_from_a = {columns * cell_m_, rows * cell_m_};
  return overlap_during(a_, a_does, b_, b_does, b_from_a, cell_m_) ? Entry::overlap : Entry::apart;
}

// ---- Fleet ----

Fleet::Fleet(const PlanningProblem& problem) : cell_m_(problem.grid.resolution_m) {
  std::vector<std::size_t> bodies;  // by robot
  for (const PlanningRobot& robot : problem.robots) bodies.push_back(body_of(robot));
  for (const Body& a : bodies_)
    for (const Body& b : bodies_) {
      relations_.emplace_back(a, b, cell_m_);
      reach_ = std::max(reach_, relations_.back().reach());
    }
  for (std::uint32_t i = 0; i < problem.robots.size(); ++i) {
    const PlanningRobot& robot = problem.robots[i];
    radii_m_.push_back(robot.robot->footprint->radius_m);
    if (robot.state == DMRP_ROBOT_ACTIVE) continue;
    const auto [column, row] = cell_of(*robot.grid, robot.start);
    const Motion stands = stands_on(*robot.grid, index_of(*robot.grid, column, row), bodies_[bodies[i]]);
    parked_.push_back({i, bodies[i], {column, row, stands}});
  }
  for (std::uint32_t i = 0; i < problem.robots.size(); ++i) {
    const PlanningRobot& robot = problem.robots[i];
    if (robot.state != DMRP_ROBOT_ACTIVE) continue;
    kind_of_.push_back(kind_of(robot, bodies[i]));
    agents.push_back(agent_on(kinds_[kind_of_.back()].graph, robot, i));
    note_ends(robot, i, bodies[i]);
  }
}

// The number of the robot's body.
std::size_t Fleet::body_of(const PlanningRobot& robot) {
  Body body(*robot.robot->footprint);
  const auto known = std::find(bodies_.begin(), bodies_.end(), body);
  const auto number = static_cast<std::size_t>(known - bodies_.begin());
  if (known == bodies_.end()) bodies_.push_back(std::move(body));
  return number;
}

std::size_t Fleet::kind_of(const PlanningRobot& robot, std::size_t body) {
  for (std::size_t i = 0; i < kinds_.size(); ++i)
    if (kinds_[i].grid == robot.grid && kinds_[i].body == body) return i;
  Kind kind{robot.grid, body, graph_around_parked(*robot.grid, body), {}};
  for (Location location = 0; location < kind.graph.location_count(); ++location) {
    const std::int32_t column = kind.graph.column(location);
    const std::int32_t row = kind.graph.row(location);
    kind.places.push_back({column, row, stands_on(*robot.grid, index_of(*robot.grid, column, row), bodies_[body])});
  }
  kinds_.push_back(std::move(kind));
  return kinds_.size() - 1;
}

// The grid without the cells and moves on which the body would touch a robot that is not active.
GridGraph Fleet::graph_around_parked(const dmrp_grid& grid, std::size_t body) const {
  const std::size_t cells = std::size_t{grid.width} * grid.height;
  std::vector<std::uint8_t> free(grid.free, grid.free + cells);
  std::vector<std::uint8_t> edges(grid.edges, grid.edges + cells);
  constexpr std::array<std::uint8_t, 4> bits = {DMRP_EDGE_E, DMRP_EDGE_N, DMRP_EDGE_W, DMRP_EDGE_S};
  for (const Parked& parked : parked_)
    for (std::int32_t row = 0; row < static_cast<std::int32_t>(grid.height); ++row)
      for (std::int32_t column = 0; column < static_cast<std::int32_t>(grid.width); ++column) {
        if (std::abs(parked.place.column - column) > reach_ || std::abs(parked.place.row - row) > reach_) continue;
        const std::size_t cell = index_of(grid, column, row);
        const Place place = {column, row, stands_on(grid, cell, bodies_[body])};
        if (exclude(body, place, parked.body, parked.place)) free[cell] = 0;
        for (std::size_t d = 0; d < bits.size(); ++d)
          if (touch(body, place, static_cast<Motion>(d), parked.body, parked.place, parked.place.stands))
            edges[cell] = static_cast<std::uint8_t>(edges[cell] & ~bits[d]);
      }
  dmrp_grid around = grid;
  around.free = free.data();
  around.edges = edges.data();
  return GridGraph(around);
}

bool Fleet::exclude(std::size_t body_a, const Place& a, std::size_t body_b, const Place& b) const {
  return (a.column == b.column && a.row == b.row) || touch(body_a, a, a.stands, body_b, b, b.stands);
}

bool Fleet::exclude(AgentIndex a, Location at_a, AgentIndex b, Location at_b) const {
  return exclude(kind(a).body, kind(a).places[index(at_a)], kind(b).body, kind(b).places[index(at_b)]);
}

bool Fleet::touch_on_way(AgentIndex a, Location a0, Location a1, AgentIndex b, Location b0, Location b1) const {
  const Place& from_a = kind(a).places[index(a0)];
  const Place& to_a = kind(a).places[index(a1)];
  const Place& from_b = kind(b).places[index(b0)];
  const Place& to_b = kind(b).places[index(b1)];
  const auto same_cell = [](const Place& p, const Place& q) { return p.column == q.column && p.row == q.row; };
  if (same_cell(from_a, to_b) && same_cell(to_a, from_b)) return true;
  return touch(kind(a).body, from_a, motion_between(from_a, to_a), kind(b).body, from_b, motion_between(from_b, to_b));
}

// Also of robots that are not active: they begin and end where they are.
void Fleet::note_ends(const PlanningRobot& robot, std::uint32_t number, std::size_t body) {
  const auto place_at = [&](dmrp_vec2 point) {
    const auto [column, row] = cell_of(*robot.grid, point);
    return Place{column, row, stands_on(*robot.grid, index_of(*robot.grid, column, row), bodies_[body])};
  };
  const dmrp_pose& goal = robot.goals().back().pose;
  ends_.push_back({number, body, place_at(robot.start), place_at({goal.x, goal.y})});
}

std::optional<std::string> Fleet::find_overlap() const {
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    const Ends& a = ends_[i];
    for (const Parked& b : parked_) {
      if (exclude(a.body, a.start, b.body, b.place)) return describe(a.robot, a.start, "starts", b.robot, b.place);
      if (exclude(a.body, a.goal, b.body, b.place)) return describe(a.robot, a.goal, "ends", b.robot, b.place);
    }
    for (std::size_t j = i + 1; j < ends_.size(); ++j) {
      const Ends& b = ends_[j];
      if (exclude(a.body, a.start, b.body, b.start)) return describe(a.robot, a.start, "starts", b.robot, b.start);
      if (exclude(a.body, a.goal, b.body, b.goal)) return describe(a.robot, a.goal, "ends", b.robot, b.goal);
    }
  }
  return std::nullopt;
}

std::string Fleet::describe(std::uint32_t robot_a, const Place& a, const char* verb, std::uint32_t robot_b,
                            const Place& b) const {
  const double distance_m = cell_m_ * std::hypot(a.column - b.column, a.row - b.row);
  return name_of(robot_a) + " (radius " + with_digits(radii_m_[robot_a]) + " m) " + verb + " " +
         with_digits(distance_m) + " m from " + name_of(robot_b) + " (radius " + with_digits(radii_m_[robot_b]) +
         " m): their outlines overlap";
}

// ---- before and after a search ----

double PreparedFleet::lower_bound() const {
  double sum = 0;
  for (std::size_t i = 0; i < tables.size(); ++i) sum += tables[i].distance(0, fleet.agents[i].start);
  return sum;
}

std::optional<PreparedFleet> prepare_fleet(const PlanningProblem& problem, StopSignal& stop) {
  PreparedFleet out{Fleet(problem), {}, {}};
  if (auto overlap = out.fleet.find_overlap()) {
    out.obstruction = std::move(*overlap);
    return out;
  }
  for (AgentIndex i = 0; i < out.fleet.size(); ++i) {
    const Agent& agent = out.fleet.agents[static_cast<std::size_t>(i)];
    out.tables.emplace_back(out.fleet.graph(i), agent);
    if (stop.poll_now()) return std::nullopt;
    if (agent.start != nowhere && out.tables.back().distance(0, agent.start) < TourTable::unreachable) continue;
    out.obstruction = name_of(agent.robot) + " cannot reach its goal";
    return out;
  }
  return out;
}

void write_paths(const PlanningProblem& problem, const Fleet& fleet, const std::vector<PathView>& paths,
                 PlanSink& sink) {
  for (AgentIndex i = 0; i < fleet.size(); ++i)
    write_path(problem, fleet.graph(i), fleet.agents[static_cast<std::size_t>(i)], paths[static_cast<std::size_t>(i)],
               sink);
  write_resting_robots(problem, sink);
}

}  // namespace dmrp::planners
