// SPDX-License-Identifier: MIT
// lacam_search.hpp: a search over configurations of all robots that generates its successors lazily.
#pragma once

#include <cstdint>
#include <deque>
#include <unordered_map>
#include <vector>

#include "planners/pibt/pibt_step.hpp"

namespace dmrp::planners {

// LaCAM* (Okumura 2023). The high level searches configurations depth first. Each time it visits one, it lets PIBT
// generate one successor, under constraints that the low level draws from a tree: breadth first, one more robot with a
// given move at each depth. So the first visits follow PIBT, and in the end every successor is generated: the search is
// complete. After the first plan it goes on: edges between known configurations shorten the ways to them, and
// configurations that cannot lead to a cheaper plan are left out.
//
// A step costs 1 for each robot that does not rest at the end of its tour before and after it. A robot that leaves its
// goal again therefore pays less on the way than in the sum of costs. So this cost is a lower bound, the plans are
// compared by their sums of costs, and when all configurations are visited a last search over them finds the least sum.
class LacamSearch {
 public:
  enum class Result {
    optimal,     // all configurations were visited; the plan is the best
    unsolvable,  // the same; there is no plan
    limit,       // iterations or memory
    stopped,
  };
  struct Statistics {
    std::int64_t configurations = 0;  // known ones
    std::int64_t iterations = 0;      // successors that were asked for
    std::int64_t plans = 0;           // each cheaper than the one before
  };

  LacamSearch(const Problem& problem, const std::vector<TourTable>& tables, std::uint64_t seed, StopSignal& stop);

  // Searches until there is a plan, then for at most so many iterations more (-1: without a limit).
  Result run(std::int64_t further_iterations);

  bool has_plan() const { return !paths_.empty() || problem_.agents.empty(); }
  // The best plan.
  std::vector<std::vector<Location>>& paths() { return paths_; }
  const Statistics& statistics() const { return statistics_; }

 private:
  using NodeId = std::int32_t;
  static constexpr NodeId no_node = -1;

  // A constraint of the low level, with those above it in the tree: the robot at its depth in the order moves there.
  struct Branch {
    std::int32_t parent;
    std::int32_t depth;
    Location to;
  };
  struct Node {
    Configuration at;
    std::vector<std::int32_t> steps_underway;  // by agent, since it was at rest
    std::vector<std::int32_t> order;           // of the agents; made at the first visit
    std::vector<Branch> branches;
    std::size_t next_branch = 0;
    std::vector<NodeId> successors;
    NodeId parent = no_node;
    std::int64_t g = 0;  // least cost from the start so far
    std::int64_t h = 0;  // lower bound of the cost to the end
  };
  struct AtHash {
    std::size_t operator()(const Configuration* at) const;
  };
  struct SameAt {
    bool operator()(const Configuration* a, const Configuration* b) const { return *a == *b; }
  };

  NodeId add(Configuration at, NodeId parent);
  NodeId find(const Configuration& at) const;
  void grow_branches(Node& node, std::int32_t branch);
  bool generate(Node& node, std::int32_t branch);
  void connect(NodeId from, NodeId to);
  void shorten_ways(NodeId from, NodeId to, std::int64_t g);
  bool may_improve(const Node& node) const { return best_cost_ < 0 || node.g + node.h < best_cost_; }
  std::int64_t step_cost(const Node& from, const Node& to) const;
  void keep_plan(const std::vector<NodeId>& nodes);
  std::vector<NodeId> way_to(NodeId id) const;
  bool search_least_sum();
  Node& node(NodeId id) { return nodes_[static_cast<std::size_t>(id)]; }
  const Node& node(NodeId id) const { return nodes_[static_cast<std::size_t>(id)]; }

  const Problem& problem_;
  const std::vector<TourTable>& tables_;
  StopSignal& stop_;
  PibtStep pibt_;
  Priorities priorities_;
  toolkit::Stream random_;
  std::deque<Node> nodes_;  // addresses stay
  std::unordered_map<const Configuration*, NodeId, AtHash, SameAt> known_;
  std::vector<NodeId> open_;  // a stack
  NodeId goal_ = no_node;
  std::int64_t goal_g_ = -1;  // of the last plan kept by way of goal_
  std::int64_t best_cost_ = -1;
  std::size_t bytes_ = 0;  // about
  std::vector<std::vector<Location>> paths_;
  std::vector<PibtStep::Fixed> fixed_;
  Configuration generated_;
  Statistics statistics_;
};

}  // namespace dmrp::planners
