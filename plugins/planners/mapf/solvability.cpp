// SPDX-License-Identifier: MIT
#include "planners/mapf/solvability.hpp"

#include <algorithm>
#include <cassert>

namespace dmrp::planners {

namespace {

// A connected part of the graph (by moves in either direction) and the agents that start in it.
struct Component {
  std::vector<Location> locations;
  std::vector<std::size_t> agents;
  bool branches = false;  // some location has more than two neighbors
};

// The neighbor by a move in either direction, or nowhere.
template <Direction connectivity>
Location linked(const BasicGridGraph<connectivity>& graph, Location location, Direction d) {
  const Location to = graph.neighbor(location, d);
  return to != nowhere ? to : graph.predecessor(location, graph.opposite(d));
}

template <Direction connectivity>
int degree(const BasicGridGraph<connectivity>& graph, Location location) {
  int count = 0;
  for (Direction d = 0; d < connectivity; ++d) count += linked(graph, location, d) != nowhere ? 1 : 0;
  return count;
}

// How far to follow a component.
enum class Extent { whole, until_branch };

template <Direction connectivity>
Component component_of(const BasicGridGraph<connectivity>& graph, Location start,
                       std::vector<std::int32_t>& component_at, std::int32_t number, Extent extent) {
  Component component;
  component.locations.push_back(start);
  component_at[static_cast<std::size_t>(start)] = number;
  for (std::size_t i = 0; i < component.locations.size(); ++i) {
    component.branches = component.branches || degree(graph, component.locations[i]) > 2;
    if (component.branches && extent == Extent::until_branch) return component;
    for (Direction d = 0; d < connectivity; ++d) {
      const Location to = linked(graph, component.locations[i], d);
      if (to == nowhere) continue;
      std::int32_t& known = component_at[static_cast<std::size_t>(to)];
      if (known >= 0 && known != number)
        component.branches = true;  // another part of a component that stopped at a branch
      if (known >= 0) continue;
      known = number;
      component.locations.push_back(to);
    }
  }
  return component;
}

// With Extent::until_branch, a component that branches can appear as several parts.
template <Direction connectivity>
std::vector<Component> components_with_agents(const BasicProblem<connectivity>& problem, Extent extent) {
  std::vector<std::int32_t> component_at(static_cast<std::size_t>(problem.graph.location_count()), -1);
  std::vector<Component> components;
  for (std::size_t i = 0; i < problem.agents.size(); ++i) {
    const Location start = problem.agents[i].start;
    std::int32_t number = component_at[static_cast<std::size_t>(start)];
    if (number < 0) {
      number = static_cast<std::int32_t>(components.size());
      components.push_back(component_of(problem.graph, start, component_at, number, extent));
    }
    components[static_cast<std::size_t>(number)].agents.push_back(i);
  }
  return components;
}

// The locations in order if the component is a corridor without a branch; otherwise empty.
template <Direction connectivity>
std::vector<Location> as_corridor(const BasicGridGraph<connectivity>& graph, const Component& component) {
  if (component.branches) return {};
  Location end = nowhere;
  for (const Location location : component.locations)
    if (degree(graph, location) <= 1) end = location;
  if (end == nowhere) return {};  // a ring
  std::vector<Location> ordered = {end};
  for (Location before = nowhere;;) {
    Location next = nowhere;
    for (Direction d = 0; d < connectivity; ++d)
      if (const Location to = linked(graph, ordered.back(), d); to != before && to != nowhere) next = to;
    if (next == nowhere) return ordered;
    before = ordered.back();
    ordered.push_back(next);
  }
}

// All joint positions that the agents of a component can reach. A state is the agents' places in component.locations,
// packed into one number.
template <Direction connectivity>
class JointReachability {
 public:
  JointReachability(const BasicProblem<connectivity>& problem, const Component& component)
      : problem_(problem), component_(component), place_of_(static_cast<std::size_t>(problem.graph.location_count())) {
    for (std::size_t i = 0; i < component.locations.size(); ++i)
      place_of_[static_cast<std::size_t>(component.locations[i])] = i;
    std::size_t states = 1;
    for (std::size_t i = 0; i < component.agents.size(); ++i) states *= component.locations.size();
    visited_.assign(states, false);
    for (const std::size_t agent : component.agents) missing_.push_back(problem.agents[agent].goals);
  }

  // Whether the agents can be at their last goals together, and each at its other goals at some time.
  bool goals_can_be_reached(StopSignal& stop) {
    from_ = positions([](const Agent& agent) { return agent.start; });
    const std::vector<Location> ends = positions([](const Agent& agent) { return agent.last_goal(); });
    to_ = from_;
    direction_.assign(from_.size(), connectivity);
    add_reached();
    for (std::size_t next = 0; next < queue_.size(); ++next) {
      if (stop.raised()) return true;
      unpack(queue_[next]);
      end_reached_ = end_reached_ || from_ == ends;
      note_goals();
      if (end_reached_ && std::all_of(missing_.begin(), missing_.end(), [](const auto& m) { return m.empty(); }))
        return true;
      move_agent(0, stop);
    }
    return false;
  }

 private:
  template <class Where>
  std::vector<Location> positions(Where where) const {
    std::vector<Location> out;
    for (const std::size_t agent : component_.agents) out.push_back(where(problem_.agents[agent]));
    return out;
  }

  void add_reached() {
    std::size_t state = 0;
    for (const Location location : to_)
      state = state * component_.locations.size() + place_of_[static_cast<std::size_t>(location)];
    if (visited_[state]) return;
    visited_[state] = true;
    queue_.push_back(state);
  }

  void unpack(std::size_t state) {
    for (std::size_t i = from_.size(); i-- > 0; state /= component_.locations.size())
      from_[i] = component_.locations[state % component_.locations.size()];
  }

  void note_goals() {
    for (std::size_t i = 0; i < from_.size(); ++i) std::erase(missing_[i], from_[i]);
  }

  // Tries all moves of the agents from i on that do not conflict with the moves of the agents before.
  void move_agent(std::size_t i, StopSignal& stop) {
    if (stop.poll()) return;
    if (i == from_.size()) return add_reached();
    for (Direction d = 0; d <= connectivity; ++d) {
      to_[i] = d == connectivity ? from_[i] : problem_.graph.neighbor(from_[i], d);
      direction_[i] = d;
      if (to_[i] != nowhere && !conflicts_with_earlier(i)) move_agent(i + 1, stop);
    }
  }

  bool conflicts_with_earlier(std::size_t i) const {
    for (std::size_t j = 0; j < i; ++j)
      if (to_[j] == to_[i] || (to_[j] == from_[i] && to_[i] == from_[j]) || passes(i, j) || passes(j, i)) return true;
    return false;
  }

  // Whether the move of i is a diagonal and j begins or ends the step on a cell beside it.
  bool passes(std::size_t i, std::size_t j) const {
    if (direction_[i] == connectivity || !problem_.graph.is_diagonal(direction_[i])) return false;
    for (const Location beside : problem_.graph.beside(from_[i], direction_[i]))
      if (from_[j] == beside || to_[j] == beside) return true;
    return false;
  }

  const BasicProblem<connectivity>& problem_;
  const Component& component_;
  std::vector<std::size_t> place_of_;
  std::vector<bool> visited_;
  std::vector<std::size_t> queue_;
  std::vector<std::vector<Location>> missing_;  // by agent: goals that it has not reached in any state
  std::vector<Location> from_;
  std::vector<Location> to_;
  std::vector<Direction> direction_;  // of the moves; `connectivity` where there is none
  bool end_reached_ = false;
};

template <Direction connectivity>
std::string name(const BasicProblem<connectivity>& problem, std::size_t agent) {
  return "robot " + std::to_string(problem.agents[agent].robot);
}

}  // namespace

template <Direction connectivity>
std::optional<std::string> find_obvious_obstruction(const BasicProblem<connectivity>& problem) {
  assert(std::none_of(problem.agents.begin(), problem.agents.end(),
                      [](const Agent& agent) { return agent.goals.empty() || agent.last_goal() == nowhere; }));
  for (std::size_t a = 0; a < problem.agents.size(); ++a)
    for (std::size_t b = a + 1; b < problem.agents.size(); ++b) {
      if (problem.agents[a].start == problem.agents[b].start)
        return name(problem, a) + " and " + name(problem, b) + " start on the same cell";
      if (problem.agents[a].last_goal() == problem.agents[b].last_goal())
        return name(problem, a) + " and " + name(problem, b) + " end on the same cell";
    }

  std::vector<std::size_t> order(static_cast<std::size_t>(problem.graph.location_count()));
  for (const Component& component : components_with_agents(problem, Extent::until_branch)) {
    const std::vector<Location> corridor = as_corridor(problem.graph, component);
    for (std::size_t i = 0; i < corridor.size(); ++i) order[static_cast<std::size_t>(corridor[i])] = i;
    if (corridor.empty()) continue;
    for (const std::size_t a : component.agents)
      for (const std::size_t b : component.agents) {
        const auto at = [&](Location location) { return order[static_cast<std::size_t>(location)]; };
        if (at(problem.agents[a].start) < at(problem.agents[b].start) &&
            at(problem.agents[a].last_goal()) > at(problem.agents[b].last_goal()))
          return name(problem, a) + " and " + name(problem, b) + " would have to pass each other in a corridor";
      }
  }
  return std::nullopt;
}

template <Direction connectivity>
std::optional<std::string> find_joint_obstruction(const BasicProblem<connectivity>& problem, std::size_t state_limit,
                                                  StopSignal& stop) {
  for (const Component& component : components_with_agents(problem, Extent::whole)) {
    std::size_t states = 1;
    for (std::size_t i = 0; i < component.agents.size() && states <= state_limit; ++i)
      states *= component.locations.size();
    if (states > state_limit || JointReachability(problem, component).goals_can_be_reached(stop)) continue;
    return "no joint motion takes the robots around " + name(problem, component.agents.front()) + " to their goals";
  }
  return std::nullopt;
}

template std::optional<std::string> find_obvious_obstruction(const BasicProblem<4>&);
template std::optional<std::string> find_obvious_obstruction(const BasicProblem<8>&);
template std::optional<std::string> find_joint_obstruction(const BasicProblem<4>&, std::size_t, StopSignal&);
template std::optional<std::string> find_joint_obstruction(const BasicProblem<8>&, std::size_t, StopSignal&);

}  // namespace dmrp::planners
