// SPDX-License-Identifier: MIT
// conflict_search.hpp: conflict-based search for large agents: MC-CBS (Li et al. 2019) with target reasoning (Li et al.
// 2020), and with a factor its variant with focal search on both levels (Barer et al. 2014).
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

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

  // The first conflict of two agents, a < b; their steps arrive at time t.
  struct Conflict {
    AgentIndex a;
    AgentIndex b;
    Clash clash;
    std::int32_t t;
  };
  struct Node {
    NodeId parent = -1;
    std::vector<Ban> bans;  // without those of its ancestors
    std::vector<Path> paths;
    std::vector<Conflict> conflicts;
    std::int64_t cost = 0;
    std::int64_t bound = 0;  // no plan below this node costs less
  };

  bool make_root();
  void expand(NodeId id);
  void add_child(NodeId parent, std::vector<Ban> bans);
  bool replan(Node& node, AgentIndex agent);
  void add_to_queues(Node node);
  void advance();
  void gather_bans(const Node& node);
  std::optional<Conflict> find_conflict(const Node& node, AgentIndex a, AgentIndex b) const;
  bool obeys(const Node& node, AgentIndex agent) const;
  std::int32_t rests_from(const Node& node, AgentIndex agent) const;
  const Conflict& choose(const Node& node) const;

  const PreparedFleet& prepared_;
  const Fleet& fleet_;
  double suboptimality_;
  std::int64_t node_limit_;
  StopSignal& stop_;
  SingleSearch low_level_;
  BanTable table_;
  std::vector<Ban> bans_;                                          // of the node at hand and its ancestors
  std::deque<Node> nodes_;                                         // they do not move
  std::set<std::pair<std::int64_t, NodeId>> open_;                 // by bound
  std::set<std::tuple<std::size_t, std::int64_t, NodeId>> focal_;  // by conflicts, then cost
  std::set<std::pair<std::int64_t, NodeId>> beyond_;               // too dear for FOCAL so far, by cost
  std::int64_t bound_ = 0;
  std::int64_t expanded_ = 0;
  NodeId solved_ = -1;
};

}  // namespace dmrp::planners
