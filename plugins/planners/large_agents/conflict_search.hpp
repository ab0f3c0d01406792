// SPDX-License-Identifier: MIT
// conflict_search.hpp: conflict-based search for large agents: MC-CBS (Li et al. 2019) with target reasoning (Li et al.
// 2020), and with a factor its variant with focal search on both levels (Barer et al. 2014).
//
// The optimal variant looks ahead: it tries the children of all conflicts of a node, splits on the one that raises the
// cost most (cardinal conflicts, Boyarski et al. 2015), takes the least rises of disjoint pairs as a heuristic (Felner et
// al. 2018), and adopts a child's paths that cost no more and have fewer conflicts instead of splitting (bypass). A pair
// that conflicts again and again is solved as a pair (pair_search.hpp).
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "planners/large_agents/pair_search.hpp"
#include "planners/large_agents/single_search.hpp"

namespace dmrp::planners {

class LargeAgentSearch {
 public:
  enum class Result { solved, unsolvable, stopped, node_limit };

  // The fleet must have no obstruction. The cost of the plan is at most `suboptimality` times the least.
  LargeAgentSearch(const PreparedFleet& prepared, double suboptimality, std::int64_t node_limit, StopSignal& stop);

  Result run();

  // After Result::solved: one path for each agent.
  std::vector<PathView> solution() const;

  double lower_bound() const { return static_cast<double>(bound_); }
  std::int64_t expanded() const { return expanded_; }
  std::int64_t generated() const { return static_cast<std::int64_t>(nodes_.size()); }
  std::int64_t low_level_expanded() const { return low_level_.expanded(); }

 private:
  using NodeId = std::int32_t;
  using Path = std::shared_ptr<const SinglePath>;

  // A child of a split: its bans, and the agent in conflict that has to obey them.
  struct Side {
    AgentIndex agent;
    std::vector<Ban> bans;
  };
  // Every plan without the conflict obeys one of the two sides.
  struct Split {
    Side first;
    Side second;
  };
  // The first conflict of two agents, a < b; their steps arrive at time t.
  struct Conflict {
    AgentIndex a;
    AgentIndex b;
    Clash clash;
    std::int32_t t;
    std::int32_t rise = -1;      // the two agents' costs rise by at least this; -1: not known yet
    std::int32_t greatest = 0;   // the greater rise of the two children
    std::size_t best_split = 0;  // of splits_of()
    Path path_a{};               // of the cheapest pair of paths, if that is known
    Path path_b{};
  };
  struct Node {
    NodeId parent = -1;
    std::vector<Ban> bans;  // without those of its ancestors
    std::vector<Path> paths;
    std::vector<Conflict> conflicts;
    std::int64_t cost = 0;
    std::int64_t bound = 0;  // no plan below this node costs less
    bool looked_ahead = false;

    // What FOCAL compares with the bound.
    std::int64_t dearness() const { return std::max(cost, bound); }
  };

  bool make_root();
  void advance();
  bool look_ahead(NodeId id);
  bool raise_bound(NodeId id);
  void expand(NodeId id);
  void solve_pair(const Node& node, Conflict& conflict);
  std::optional<Node> with_pair(const Node& node, const Conflict& conflict) const;
  void find_conflicts(Node& node, const std::vector<Conflict>& before, const std::vector<bool>& is_new) const;
  std::vector<Split> splits_of(const Node& node, const Conflict& conflict) const;
  std::int32_t rise_of(const Node& node, const Side& side);
  std::optional<Node> make_child(NodeId parent, std::vector<Ban> bans);
  bool replan(Node& node, AgentIndex agent);
  void insert(Node node);
  void gather_bans(const Node& node);
  std::optional<Conflict> find_conflict(const Node& node, AgentIndex a, AgentIndex b) const;
  bool obeys(const Node& node, AgentIndex agent) const;
  std::int32_t rests_from(const Node& node, AgentIndex agent) const;
  Conflict& choose(Node& node) const;

  const PreparedFleet& prepared_;
  const Fleet& fleet_;
  double suboptimality_;
  std::int64_t node_limit_;
  StopSignal& stop_;
  SingleSearch low_level_;
  PairSearch pair_search_;
  BanTable table_;
  std::vector<Ban> bans_;                                          // of the node at hand and its ancestors
  std::deque<Node> nodes_;                                         // they do not move
  std::set<std::pair<std::int64_t, NodeId>> open_;                 // by bound
  std::set<std::tuple<std::size_t, std::int64_t, NodeId>> focal_;  // by conflicts, then dearness
  std::set<std::pair<std::int64_t, NodeId>> beyond_;               // too dear for FOCAL so far, by cost
  std::vector<std::int32_t> splits_;                               // by pair of agents
  std::int64_t bound_ = 0;
  std::int64_t expanded_ = 0;
  NodeId solved_ = -1;
};

}  // namespace dmrp::planners
