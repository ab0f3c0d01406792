// SPDX-License-Identifier: MIT
#include "planners/lacam/lacam_search.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <queue>
#include <tuple>
#include <utility>

#include "planners/mapf/stop_signal.hpp"

namespace dmrp::planners {

namespace {

// The way with the least sum of costs in a graph of configurations.
//
// The cost of a robot is the time from which it rests for good. That depends on what comes later, so the search goes
// back in time, from the goal: its states are a configuration and the set of robots that do not rest any more. Each
// step back costs one for each robot in the set. A* with the cost from the start in which rest that is broken later
// costs nothing: it is never higher.
class LeastSum {
 public:
  struct Place {
    std::int64_t least_before = 0;    // lower bound of the cost from the start to here
    std::vector<bool> is_underway;    // by robot: not at the end of its tour
    std::vector<std::int32_t> after;  // places one step later
  };

  // Looks for ways that cost less than `limit`.
  LeastSum(std::int64_t limit, StopSignal& stop) : limit_(limit), stop_(stop) {}

  // Place 0 is the start.
  void add(Place place) { places_.push_back(std::move(place)); }

  // The places from the start to the goal; empty if no way costs less than the limit, or if `stop` was raised.
  std::vector<std::int32_t> run(std::int32_t goal);

 private:
  struct State {
    std::int32_t place;
    std::vector<bool> underway;  // robots that move or wait at some time from here on
    std::int64_t cost;           // from here to the goal
    std::int32_t next;           // the state one step later, or -1
  };
  using Key = std::pair<std::int32_t, std::vector<bool>>;

  void reach(std::int32_t place, std::vector<bool> underway, std::int64_t cost, std::int32_t next);

  std::int64_t limit_;
  StopSignal& stop_;
  std::vector<Place> places_;
  std::vector<State> states_;
  std::map<Key, std::int32_t> known_;
  std::vector<std::pair<std::int64_t, std::int32_t>> open_;  // a heap by cost in all
};

// Nodes of the search take at most about so many bytes.
constexpr std::size_t memory_limit = std::size_t{2} << 30;

// After a known configuration was found again, the search continues there; once in so many times at the start.
constexpr std::uint64_t rare_restart = 1000;

void LeastSum::reach(std::int32_t place, std::vector<bool> underway, std::int64_t cost, std::int32_t next) {
  const std::int64_t in_all = cost + places_[static_cast<std::size_t>(place)].least_before;
  if (in_all >= limit_) return;
  const auto id = static_cast<std::int32_t>(states_.size());
  const auto [known, is_new] = known_.try_emplace({place, underway}, id);
  if (!is_new) {
    if (states_[static_cast<std::size_t>(known->second)].cost <= cost) return;
    known->second = id;
  }
  states_.push_back({place, std::move(underway), cost, next});
  open_.emplace_back(in_all, id);
  std::push_heap(open_.begin(), open_.end(), std::greater<>());
}

std::vector<std::int32_t> LeastSum::run(std::int32_t goal) {
  std::vector<std::vector<std::int32_t>> before(places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i)
    for (const std::int32_t after : places_[i].after)
      before[static_cast<std::size_t>(after)].push_back(static_cast<std::int32_t>(i));

  reach(goal, std::vector<bool>(places_[static_cast<std::size_t>(goal)].is_underway.size(), false), 0, -1);
  while (!open_.empty() && !stop_.poll()) {
    std::pop_heap(open_.begin(), open_.end(), std::greater<>());
    std::int32_t id = open_.back().second;
    open_.pop_back();
    const State state = states_[static_cast<std::size_t>(id)];
    if (known_.at({state.place, state.underway}) != id) continue;  // a cheaper one is known
    if (state.place == 0) {
      std::vector<std::int32_t> way;
      for (; id >= 0; id = states_[static_cast<std::size_t>(id)].next)
        way.push_back(states_[static_cast<std::size_t>(id)].place);
      return way;
    }
    const Place& here = places_[static_cast<std::size_t>(state.place)];
    for (const std::int32_t earlier : before[static_cast<std::size_t>(state.place)]) {
      const Place& from = places_[static_cast<std::size_t>(earlier)];
      std::vector<bool> underway = state.underway;
      std::int64_t step = 0;
      for (std::size_t i = 0; i < underway.size(); ++i) {
        underway[i] = underway[i] || here.is_underway[i] || from.is_underway[i];
        step += underway[i] ? 1 : 0;
      }
      reach(earlier, std::move(underway), state.cost + step, id);
    }
  }
  return {};
}

}  // namespace

LacamSearch::LacamSearch(const Problem& problem, const std::vector<TourTable>& tables, std::uint64_t seed,
                         StopSignal& stop)
    : problem_(problem),
      tables_(tables),
      stop_(stop),
      pibt_(problem, tables),
      priorities_(problem, tables),
      random_(seed, "lacam") {}

std::size_t LacamSearch::AtHash::operator()(const Configuration* at) const {
  std::uint64_t hash = 0;
  const auto mix = [&hash](std::int32_t value) {
    hash = (hash ^ static_cast<std::uint32_t>(value)) * 0x9E3779B97F4A7C15u;
    hash ^= hash >> 32;
  };
  for (const Location location : at->locations) mix(location);
  for (const std::int32_t leg : at->legs) mix(leg);
  return hash;
}

LacamSearch::Result LacamSearch::run(std::int64_t further_iterations) {
  open_.push_back(add(start_configuration(problem_), no_node));
  std::int64_t plan_at = 0;  // iterations until the first plan
  while (!open_.empty()) {
    if (stop_.poll_now()) return Result::stopped;
    const NodeId id = open_.back();
    Node& from = node(id);
    if (from.h == 0 && (goal_ == no_node || from.g < goal_g_)) {
      if (goal_ == no_node) plan_at = statistics_.iterations;
      goal_ = id;
      goal_g_ = from.g;
      keep_plan(way_to(id));
    }
    if (from.h == 0 || from.next_branch == from.branches.size() || !may_improve(from)) {
      open_.pop_back();
      continue;
    }
    const bool is_enough =
        has_plan() && further_iterations >= 0 && statistics_.iterations - plan_at >= further_iterations;
    if (is_enough || bytes_ > memory_limit) return Result::limit;
    ++statistics_.iterations;
    const auto branch = static_cast<std::int32_t>(from.next_branch++);
    grow_branches(from, branch);
    if (!generate(from, branch)) continue;
    NodeId to = find(generated_);
    const bool is_known = to != no_node;
    if (!is_known) to = add(std::move(generated_), id);
    connect(id, to);
    if (is_known && random_.below(rare_restart) == 0) to = 0;
    if (may_improve(node(to))) open_.push_back(to);
  }
  if (!has_plan()) return Result::unsolvable;
  return search_least_sum() ? Result::optimal : Result::stopped;
}

LacamSearch::NodeId LacamSearch::add(Configuration at, NodeId parent) {
  const auto id = static_cast<NodeId>(nodes_.size());
  Node& added = nodes_.emplace_back();
  added.at = std::move(at);
  added.steps_underway.resize(problem_.agents.size());
  for (std::size_t i = 0; i < added.steps_underway.size(); ++i) {
    const std::int32_t left = pibt_.distance(added.at, static_cast<std::int32_t>(i));
    added.h += left;
    added.steps_underway[i] = left == 0 || parent == no_node ? 0 : node(parent).steps_underway[i] + 1;
  }
  added.branches.push_back({-1, -1, nowhere});
  added.parent = parent;
  if (parent != no_node) added.g = node(parent).g + step_cost(node(parent), added);
  known_.emplace(&added.at, id);
  bytes_ += sizeof(Node) + 4 * sizeof(std::int32_t) * problem_.agents.size();
  ++statistics_.configurations;
  return id;
}

LacamSearch::NodeId LacamSearch::find(const Configuration& at) const {
  const auto found = known_.find(&at);
  return found == known_.end() ? no_node : found->second;
}

// The low level: below a branch, every move of the next robot in the order.
void LacamSearch::grow_branches(Node& node, std::int32_t branch) {
  if (node.order.empty()) priorities_.sort(node.steps_underway, node.order);
  const std::int32_t depth = node.branches[static_cast<std::size_t>(branch)].depth + 1;
  if (depth == static_cast<std::int32_t>(node.order.size())) return;
  const Location here = node.at.locations[static_cast<std::size_t>(node.order[static_cast<std::size_t>(depth)])];
  std::array<Location, GridGraph::direction_count + 1> moves{here};
  std::size_t count = 1;
  for (Direction d = 0; d < GridGraph::direction_count; ++d)
    if (const Location to = problem_.graph.neighbor(here, d); to != nowhere) moves[count++] = to;
  for (std::size_t i = count; i > 1; --i) std::swap(moves[i - 1], moves[random_.below(i)]);
  for (std::size_t i = 0; i < count; ++i) node.branches.push_back({branch, depth, moves[i]});
  bytes_ += count * sizeof(Branch);
}

// A successor under the constraints of the branch.
bool LacamSearch::generate(Node& node, std::int32_t branch) {
  fixed_.clear();
  for (std::int32_t at = branch; at > 0; at = node.branches[static_cast<std::size_t>(at)].parent) {
    const Branch& constraint = node.branches[static_cast<std::size_t>(at)];
    fixed_.push_back({node.order[static_cast<std::size_t>(constraint.depth)], constraint.to});
  }
  return pibt_.step(node.at, node.order, fixed_, random_, generated_);
}

void LacamSearch::connect(NodeId from, NodeId to) {
  std::vector<NodeId>& successors = node(from).successors;
  if (std::find(successors.begin(), successors.end(), to) != successors.end()) return;
  successors.push_back(to);
  const std::int64_t through = node(from).g + step_cost(node(from), node(to));
  if (through < node(to).g) shorten_ways(from, to, through);
}

// Lowers the cost of a node to which another one leads at less cost, and of those after it (Dijkstra), and opens them
// again. When the search is stopped, so is this: the ways known by then are right, if not the shortest.
void LacamSearch::shorten_ways(NodeId from, NodeId to, std::int64_t g) {
  struct Entry {
    std::int64_t g;
    NodeId from;
    NodeId to;
    bool operator>(const Entry& other) const { return std::tie(g, from, to) > std::tie(other.g, other.from, other.to); }
  };
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (queue.push({g, from, to}); !queue.empty() && !stop_.poll();) {
    const Entry entry = queue.top();
    queue.pop();
    Node& shortened = node(entry.to);
    if (entry.g >= shortened.g) continue;
    shortened.g = entry.g;
    shortened.parent = entry.from;
    if (may_improve(shortened)) open_.push_back(entry.to);
    for (const NodeId next : shortened.successors)
      if (const std::int64_t through = entry.g + step_cost(shortened, node(next)); through < node(next).g)
        queue.push({through, entry.to, next});
  }
}

// One for each robot that does not rest before and after.
std::int64_t LacamSearch::step_cost(const Node& from, const Node& to) const {
  std::int64_t cost = 0;
  for (std::int32_t agent = 0; agent < static_cast<std::int32_t>(problem_.agents.size()); ++agent)
    cost += pibt_.rests(from.at, agent) && pibt_.rests(to.at, agent) ? 0 : 1;
  return cost;
}

std::vector<LacamSearch::NodeId> LacamSearch::way_to(NodeId id) const {
  std::vector<NodeId> way;
  for (; id != no_node; id = node(id).parent) way.push_back(id);
  std::reverse(way.begin(), way.end());
  return way;
}

// Keeps the plan if its sum of costs is the least so far.
void LacamSearch::keep_plan(const std::vector<NodeId>& nodes) {
  std::vector<const Configuration*> configurations;
  for (const NodeId id : nodes) configurations.push_back(&node(id).at);
  std::vector<std::vector<Location>> paths = paths_of(configurations, tables_);
  const std::int64_t cost = sum_of_costs(paths);
  if (best_cost_ >= 0 && cost >= best_cost_) return;
  best_cost_ = cost;
  paths_ = std::move(paths);
  ++statistics_.plans;
}

// When all configurations are known that can be part of a cheaper plan: the least sum of costs. False if stopped.
bool LacamSearch::search_least_sum() {
  LeastSum search(best_cost_, stop_);
  for (const Node& from : nodes_) {
    LeastSum::Place place{from.g, {}, from.successors};
    for (std::int32_t agent = 0; agent < static_cast<std::int32_t>(problem_.agents.size()); ++agent)
      place.is_underway.push_back(!pibt_.rests(from.at, agent));
    search.add(std::move(place));
  }
  const auto way = search.run(goal_);
  if (stop_.raised()) return false;
  if (!way.empty()) keep_plan(way);
  return true;
}

}  // namespace dmrp::planners
