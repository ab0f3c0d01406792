// SPDX-License-Identifier: MIT
#include "planners/conflict_search/symmetry/corridor.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace dmrp::planners {

namespace {

// The search for another way gives up at that many steps more than the agent's path has.
constexpr std::int32_t longest_detour = 64;

std::array<Location, GridGraph::direction_count> neighbors_of(const GridGraph& graph, Location location) {
  std::array<Location, GridGraph::direction_count> neighbors;
  for (Direction d = 0; d < GridGraph::direction_count; ++d)
    neighbors[static_cast<std::size_t>(d)] = graph.neighbor(location, d);
  return neighbors;
}

bool has_two_neighbors(const GridGraph& graph, Location location) {
  const auto neighbors = neighbors_of(graph, location);
  return std::count(neighbors.begin(), neighbors.end(), nowhere) == GridGraph::direction_count - 2;
}

}  // namespace

Corridors::Corridors(const GridGraph& graph)
    : is_symmetric_(graph.is_symmetric()),
      corridor_of_(static_cast<std::size_t>(graph.location_count()), -1),
      position_(corridor_of_.size(), 0) {
  if (!is_symmetric_) return;
  for (Location end = 0; end < graph.location_count(); ++end) {
    if (!graph.is_open(end) || has_two_neighbors(graph, end)) continue;
    for (const Location first : neighbors_of(graph, end))
      if (first != nowhere && has_two_neighbors(graph, first) && inside(first) == nullptr) follow(graph, end, first);
  }
}

// Adds the corridor that begins with `end` and `first`, unless it leads back to its start.
void Corridors::follow(const GridGraph& graph, Location end, Location first) {
  std::vector<Location> cells = {end, first};
  while (cells.back() != end && has_two_neighbors(graph, cells.back())) {
    const auto neighbors = neighbors_of(graph, cells.back());
    const Location before = cells[cells.size() - 2];
    cells.push_back(
        *std::find_if(neighbors.begin(), neighbors.end(), [&](Location n) { return n != nowhere && n != before; }));
  }
  if (cells.back() == end) return;
  for (std::size_t i = 1; i + 1 < cells.size(); ++i) {
    corridor_of_[static_cast<std::size_t>(cells[i])] = static_cast<std::int32_t>(corridors_.size());
    position_[static_cast<std::size_t>(cells[i])] = static_cast<std::int32_t>(i);
  }
  corridors_.push_back({std::move(cells)});
}

namespace {

// The way of an agent in a corridor from time t on, towards the corridor's last location if `to_last`, otherwise
// towards its first. Nothing if the path goes elsewhere.
std::optional<Passage::Way> way_through(const Corridors& corridors, const Corridors::Corridor& corridor, PathView path,
                                        std::int32_t t, bool to_last) {
  Passage::Way way{corridor.end(to_last), to_last ? corridor.cells[corridor.cells.size() - 2] : corridor.cells[1],
                   corridor.length(), 0};
  for (auto at = static_cast<std::size_t>(t); at < path.size(); ++at) {
    if (path[at] == way.exit) return way;
    if (path[at] != corridor.end(!to_last) && corridors.inside(path[at]) != &corridor) return std::nullopt;
  }
  if (corridors.inside(path.back()) != &corridor) return std::nullopt;  // it ends at the entrance
  const std::int32_t position = corridors.position(path.back());
  way.length = to_last ? position : corridor.length() - position;
  way.beyond = corridor.length() - way.length;
  return way;
}

// Whether both agents start inside and have already passed each other.
bool have_passed(const Corridors& corridors, const Corridors::Corridor& corridor, PathView path_a, PathView path_b,
                 bool a_to_last) {
  const Location a = path_a.front();
  const Location b = path_b.front();
  if (corridors.inside(a) != &corridor || corridors.inside(b) != &corridor) return false;
  return (corridors.position(a) > corridors.position(b)) == a_to_last;
}

// The agents' ways if the passage is the whole corridor.
std::optional<Passage::Ways> whole_ways(const Corridors& corridors, const Corridors::Corridor& corridor, std::int32_t t,
                                        PathView path_a, PathView path_b) {
  for (const bool a_to_last : {false, true}) {
    const auto way_a = way_through(corridors, corridor, path_a, t, a_to_last);
    const auto way_b = way_through(corridors, corridor, path_b, t, !a_to_last);
    if (!way_a || !way_b || way_a->length + way_b->length <= corridor.length()) continue;
    if (!have_passed(corridors, corridor, path_a, path_b, a_to_last)) return Passage::Ways{*way_a, *way_b};
  }
  return std::nullopt;
}

constexpr std::int32_t never = std::numeric_limits<std::int32_t>::max();

// By position in the corridor: the first time at which the path is there, or never.
std::vector<std::int32_t> first_times(const Corridors& corridors, const Corridors::Corridor& corridor, PathView path) {
  std::vector<std::int32_t> times(corridor.cells.size(), never);
  for (std::size_t t = path.size(); t-- > 0;) {
    const auto at = static_cast<std::int32_t>(t);
    if (corridors.inside(path[t]) == &corridor) times[static_cast<std::size_t>(corridors.position(path[t]))] = at;
    if (path[t] == corridor.end(false)) times.front() = at;
    if (path[t] == corridor.end(true)) times.back() = at;
  }
  return times;
}

// The way of an agent to a position through the part of the corridor that begins `length` steps before it. Nothing if
// the path never goes that way, or first reaches the position by another way.
std::optional<Passage::Way> way_to(const Corridors::Corridor& corridor, PathView path,
                                   const std::vector<std::int32_t>& times, std::int32_t position, bool ascending,
                                   std::int32_t length) {
  const auto at = static_cast<std::size_t>(position);
  if (times[at] == never || times[at] == 0) return std::nullopt;
  const Location before = corridor.cells[ascending ? at - 1 : at + 1];
  if (path[static_cast<std::size_t>(times[at]) - 1] != before) return std::nullopt;
  return Passage::Way{corridor.cells[at], before, length, 0};
}

// The longest part of the corridor in which both paths are at the same time, in opposite directions according to their
// first times.
std::optional<Passage::Ways> partial_ways(const Corridors& corridors, const Corridors::Corridor& corridor,
                                          PathView path_a, PathView path_b) {
  const std::vector<std::int32_t> times_a = first_times(corridors, corridor, path_a);
  const std::vector<std::int32_t> times_b = first_times(corridors, corridor, path_b);
  for (std::int32_t length = corridor.length(); length > 0; --length)
    for (std::int32_t low = 0; low + length <= corridor.length(); ++low)
      for (const bool a_to_last : {false, true}) {
        const std::int32_t exit_a = a_to_last ? low + length : low;
        const std::int32_t exit_b = a_to_last ? low : low + length;
        const auto way_a = way_to(corridor, path_a, times_a, exit_a, a_to_last, length);
        const auto way_b = way_to(corridor, path_b, times_b, exit_b, !a_to_last, length);
        if (!way_a || !way_b || have_passed(corridors, corridor, path_a, path_b, a_to_last)) continue;
        const std::int32_t apart =
            times_a[static_cast<std::size_t>(exit_a)] - times_b[static_cast<std::size_t>(exit_b)];
        if (std::abs(apart) <= length) return Passage::Ways{*way_a, *way_b};
      }
  return std::nullopt;
}

std::optional<Passage> passage_in(const Corridors& corridors, const Corridors::Corridor& corridor, std::int32_t t,
                                  PathView path_a, PathView path_b) {
  const auto whole = whole_ways(corridors, corridor, t, path_a, path_b);
  const auto partial = partial_ways(corridors, corridor, path_a, path_b);
  if (whole) return Passage{*whole, partial};
  if (partial) return Passage{*partial, std::nullopt};
  return std::nullopt;
}

// The time at which the path leaves the passage or, if its way ends inside, comes to rest.
std::int32_t arrival_of(PathView path, const Passage::Way& way) {
  if (way.ends_inside()) return cost_of(path);
  return static_cast<std::int32_t>(std::find(path.begin(), path.end(), way.exit) - path.begin());
}

// Whether all paths of the MDD visit the location before time t.
bool must_be_there_before(const GridGraph& graph, const Mdd& mdd, Location location, std::int32_t t) {
  std::vector<Location> before;  // nodes of paths that have not visited it
  std::vector<Location> here;
  for (std::int32_t at = 0; at < t && at <= mdd.cost(); ++at) {
    here.clear();
    for (const Mdd::Node& node : mdd.level(at)) {
      if (node.location == location) continue;
      const bool is_reached = at == 0 || std::any_of(before.begin(), before.end(), [&](Location from) {
                                if (from == node.location) return true;
                                const auto neighbors = neighbors_of(graph, from);
                                return std::find(neighbors.begin(), neighbors.end(), node.location) != neighbors.end();
                              });
      if (is_reached) here.push_back(node.location);
    }
    if (here.empty()) return true;
    before.swap(here);
  }
  return false;
}

std::optional<std::int32_t> arrival_at_exit(const CorridorAgent& agent, const Passage::Way& way, bool around,
                                            std::int32_t latest, EarliestArrival& search) {
  return search.search(
      {agent.agent, agent.table, agent.constraints, way.exit, around ? way.last_before_exit : nowhere, latest});
}

// The earliest time at which an agent can be at its exit (or at rest inside) by another way, at most `limit`. To rest
// inside it may also take its way, leave for the other agent to enter, and return: that takes two steps.
std::optional<std::int32_t> arrival_around(const CorridorAgent& agent, const Passage::Way& way, std::int32_t limit,
                                           EarliestArrival& search) {
  std::int32_t latest = limit - 1 - way.beyond;
  if (way.ends_inside()) {
    const auto through = arrival_at_exit(agent, way, false, latest, search);
    if (!through) return std::nullopt;
    latest = std::min(latest, *through + 1);
  }
  const auto around = arrival_at_exit(agent, way, true, latest, search);
  if (!around) return std::nullopt;
  return *around + way.beyond;
}

// The times before which one agent or the other must not be at its exit (or rest inside).
std::optional<std::array<std::int32_t, 2>> find_not_before(const Passage::Ways& ways,
                                                           const std::array<const CorridorAgent*, 2>& agents,
                                                           EarliestArrival& search) {
  std::array<std::int32_t, 2> of_path{};
  std::array<std::int32_t, 2> not_before{};
  for (std::size_t i = 0; i < 2; ++i) of_path[i] = arrival_of(agents[i]->path, ways[i]);
  // After the other agent ...
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t other = 1 - i;
    if (ways[other].ends_inside()) {  // and comes to rest
      not_before[i] = of_path[i] + longest_detour;
      continue;
    }
    const auto other_is_out = arrival_at_exit(*agents[other], ways[other], false, of_path[other] - 1, search);
    if (!other_is_out) return std::nullopt;
    not_before[i] = *other_is_out + 1 + ways[i].length;
    if (of_path[i] >= not_before[i]) return std::nullopt;
  }
  // ... or by another way.
  for (std::size_t i = 0; i < 2; ++i) {
    const auto around = arrival_around(*agents[i], ways[i], not_before[i], search);
    if (!around || *around <= of_path[i]) return std::nullopt;
    not_before[i] = *around;
  }
  return not_before;
}

}  // namespace

std::optional<Passage> find_passage(const Corridors& corridors, const Conflict& conflict, PathView path_a,
                                    PathView path_b) {
  const std::int32_t t = conflict.t;
  if (!corridors.is_symmetric() || t == 0 || t > cost_of(path_a) || t > cost_of(path_b)) return std::nullopt;
  const Corridors::Corridor* here = corridors.inside(conflict.location);
  if (here == nullptr && conflict.from != nowhere) {
    here = corridors.inside(conflict.from);
    if (here == nullptr)
      return Passage{{{{conflict.location, conflict.from, 1, 0}, {conflict.from, conflict.location, 1, 0}}},
                     std::nullopt};
  }
  if (here != nullptr) return passage_in(corridors, *here, t, path_a, path_b);
  // At an end of a corridor one agent leaves it while the other is about to enter.
  for (const PathView path : {path_a, path_b}) {
    const Corridors::Corridor* left = corridors.inside(path[static_cast<std::size_t>(t - 1)]);
    if (left == nullptr) continue;
    if (const auto passage = passage_in(corridors, *left, t, path_a, path_b)) return passage;
  }
  return std::nullopt;
}

std::optional<SymmetrySplit> find_corridor(const GridGraph& graph, const Passage& passage, const Conflict& conflict,
                                           const CorridorAgent& a, const CorridorAgent& b,
                                           EarliestArrival& earliest_arrival) {
  const std::array<const CorridorAgent*, 2> agents = {&a, &b};
  Passage::Ways ways = passage.ways;
  auto not_before = find_not_before(ways, agents, earliest_arrival);
  if (!not_before && passage.shorter) {
    ways = *passage.shorter;
    not_before = find_not_before(ways, agents, earliest_arrival);
  }
  if (!not_before) return std::nullopt;
  SymmetrySplit split;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::int32_t agent = i == 0 ? conflict.a : conflict.b;
    const std::int32_t t = (*not_before)[i];
    if (ways[i].ends_inside()) {
      split.constraints[i] = {finish_after(agent, agents[i]->agent.last_goal(), t - 1)};
      split.raises_cost[i] = true;
    } else {
      split.constraints[i] = {avoid_vertex_range(agent, ways[i].exit, 0, t)};
      split.raises_cost[i] = must_be_there_before(graph, agents[i]->mdd, ways[i].exit, t);
    }
  }
  return split;
}

std::optional<Passage> CorridorReasoning::find_passage(const Conflict& conflict, PathView path_a, PathView path_b) {
  if (!corridors_) corridors_.emplace(problem_.graph);
  return planners::find_passage(*corridors_, conflict, path_a, path_b);
}

std::optional<SymmetrySplit> CorridorReasoning::find_split(const Passage& passage, const Conflict& conflict,
                                                           const Party& a, const Party& b) {
  if (!scratch_) scratch_.emplace(problem_.graph, stop_);
  const auto known_of = [this](const Party& party, ConstraintTable& table) {
    const auto index = static_cast<std::size_t>(party.agent);
    table.fill(problem_.agents[index], party.constraints);
    return CorridorAgent{problem_.agents[index], tables_[index], table, party.mdd, party.path};
  };
  return find_corridor(problem_.graph, passage, conflict, known_of(a, scratch_->tables[0]),
                       known_of(b, scratch_->tables[1]), scratch_->earliest_arrival);
}

}  // namespace dmrp::planners
