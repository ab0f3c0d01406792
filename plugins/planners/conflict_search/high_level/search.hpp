// SPDX-License-Identifier: MIT
// search.hpp: conflict-based search, optimal and bounded-suboptimal: the engine of CBS, ECBS and EECBS.
//
// The high level resolves conflicts between the agents' paths by splitting on them; the low level plans one agent
// under the constraints that result. What the variants differ in are options.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "planners/conflict_search/high_level/constraint_tree.hpp"
#include "planners/conflict_search/high_level/corridor_reasoning.hpp"
#include "planners/conflict_search/high_level/node_queue.hpp"
#include "planners/conflict_search/high_level/vertex_cover.hpp"
#include "planners/conflict_search/low_level/mdd.hpp"
#include "planners/conflict_search/low_level/safe_interval_search.hpp"
#include "planners/conflict_search/low_level/space_time_search.hpp"
#include "planners/conflict_search/symmetry/rectangle.hpp"

namespace dmrp::planners {

struct ConflictSearchOptions {
  double suboptimality = 1;
  Selection selection = Selection::best_first;
  bool prioritize_conflicts = false;  // cardinal ones first (Boyarski et al. 2015)
  bool bypass = false;                // adopt a path that helps instead of splitting (Boyarski et al. 2015)
  bool target_reasoning = false;      // Li et al. 2020
  bool corridor_reasoning = false;    // likewise
  bool rectangle_reasoning = false;   // Li et al. 2019
  bool dependency_graph = false;      // the WDG heuristic (Li et al. 2019), for nodes taken for their bound
  bool safe_intervals = true;         // the low level plans over safe intervals; else over single steps
  bool disjoint_splitting = false;    // Li et al. 2019
  bool replan_in_place = false;       // before a split: agents whose new paths help as they are
  std::int32_t conflict_steps = 0;    // steps that a path may be longer for a conflict less; 0: any, within the bound
  std::int64_t restart_after = 0;     // nodes; then anew with another order of the agents (Cohen et al. 2018); 0: never
  std::int64_t node_limit = 0;        // of all restarts together
  std::uint64_t seed = 0;             // of the orders
};

struct ConflictSearchStatistics {
  double lower_bound = 0;
  std::int64_t high_level_expanded = 0;
  std::int64_t high_level_generated = 0;
  std::int64_t low_level_expanded = 0;
};

class ConflictSearch {
 public:
  enum class Result { solved, unsolvable, stopped, node_limit };

  // What is used is kept: all arguments must live as long as the search.
  ConflictSearch(const Problem& problem, const std::vector<TourTable>& tables, CorridorReasoning& corridors,
                 MddCache& mdds, const ConflictSearchOptions& options, StopSignal& stop);
  ~ConflictSearch();

  // Plans for some agents, under constraints (of theirs) from the outset.
  Result run(std::vector<std::int32_t> members, std::vector<Constraint> constraints);

  // After Result::solved: the members' paths, by agent.
  const std::vector<AgentPath>& solution() const { return paths_; }
  // After Result::unsolvable: why there is no plan.
  const std::string& obstruction() const { return obstruction_; }
  ConflictSearchStatistics statistics() const;

 private:
  // A node that is not in the tree yet.
  struct Child {
    Node node;
    std::vector<Constraint> constraints;
    std::vector<LowLevelPath> found;  // of the agents replanned; only the first `paths.size()` count
    std::vector<AgentPath> paths;
    std::vector<Conflict> conflicts;
    std::int32_t conflicting_pairs = 0;  // of the agents replanned
  };
  using Pair = std::pair<std::int32_t, std::int32_t>;

  Result search_from(const std::vector<std::int32_t>& order, const std::vector<Constraint>& constraints,
                     std::int64_t node_limit);
  bool plan_root(const std::vector<std::int32_t>& order, const std::vector<Constraint>& constraints);
  void enter(NodeId id);
  void expand(NodeId id);
  NodeId replan_in_place(NodeId id);
  bool inform(NodeId id);

  std::uint32_t choose_conflict();
  void classify(NodeConflict& conflict);
  std::optional<SymmetrySplit> find_corridor_split(const Conflict& conflict);
  std::optional<SymmetrySplit> find_rectangle_split(const Conflict& conflict);
  bool must_arrive(std::int32_t agent, Location from, Location to, std::int32_t t);
  Split split_on(const NodeConflict& conflict);
  Split plain_split(const Conflict& conflict);
  const Mdd* mdd_of(std::int32_t agent);

  bool make_child(NodeId parent, const std::vector<Constraint>& constraints, Child& child);
  bool replan_all(NodeId parent, const std::vector<std::int32_t>& agents, const std::vector<Constraint>& constraints,
                  Child& child);
  bool replan(NodeId parent, std::int32_t agent, Child& child);
  bool is_bypass(NodeId parent, const Child& child) const;
  void push(NodeId id);
  NodeId add(Child& child, NodeId parent, bool with_constraints);
  void note_errors(const Node& parent, const std::vector<const Node*>& children);
  double estimate(const Node& node) const;

  std::int32_t pair_weight(const Pair& pair);

  const AgentPath& path_of(std::int32_t agent) const { return paths_[static_cast<std::size_t>(agent)]; }

  const Problem& problem_;
  const std::vector<TourTable>& tables_;
  CorridorReasoning& corridors_;
  MddCache& mdds_;
  ConflictSearchOptions options_;
  StopSignal& stop_;

  std::vector<std::int32_t> members_;
  ConstraintTree tree_;
  NodeQueue queue_;
  SafeIntervalSearch safe_interval_search_;
  SpaceTimeSearch space_time_search_;
  ConflictSearchStatistics statistics_;
  std::int32_t conflict_steps_ = 0;
  std::int64_t expansions_of_run_ = 0;
  std::int32_t lower_bound_ = 0;  // what the searches before the last restart have proved
  std::string obstruction_;

  // Of the node that was entered last: paths by agent, conflicts by their indices in the tree, the pairs that have
  // some, who is where, and the signatures of the agents' constraints; MDDs are of the signatures beside them.
  NodeId entered_ = no_node;
  std::vector<AgentPath> paths_;
  std::vector<std::uint32_t> conflicts_;
  std::vector<Pair> pairs_;
  ConflictTable occupied_;
  std::vector<std::uint64_t> signatures_;
  struct NodeMdd {
    std::uint64_t signature = 0;
    std::shared_ptr<const Mdd> mdd;
  };
  std::vector<NodeMdd> node_mdds_;

  // Running means of what one step of the search costs more, and of how many pairs it removes fewer than one.
  double cost_error_sum_ = 0;
  double distance_error_sum_ = 0;
  std::int64_t error_count_ = 0;

  // For pair_weight(): a search of two agents, and what it found, by the agents' constraints.
  struct PairKey {
    std::int32_t a;
    std::int32_t b;
    std::uint64_t signature_a;
    std::uint64_t signature_b;
    bool operator==(const PairKey&) const = default;
  };
  struct PairKeyHash {
    std::size_t operator()(const PairKey& key) const {
      const auto agents = static_cast<std::uint64_t>(key.a) << 32 | static_cast<std::uint32_t>(key.b);
      return key.signature_a ^ (key.signature_b * 0x9E3779B97F4A7C15u) ^ (agents * 0xBF58476D1CE4E5B9u);
    }
  };
  std::unique_ptr<ConflictSearch> pair_search_;
  std::unordered_map<PairKey, std::int32_t, PairKeyHash> pair_weights_;  // never iterated over

  ConstraintTable constraint_table_;
  std::vector<Constraint> constraints_;
  std::vector<Constraint> other_constraints_;
  std::array<Child, 2> children_;
};

}  // namespace dmrp::planners
