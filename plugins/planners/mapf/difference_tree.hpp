// SPDX-License-Identifier: MIT
// difference_tree.hpp: a constraint tree whose nodes store only their differences from their parents.
//
// The paths and conflicts of a node follow from what it and its ancestors store:
//   paths        an agent's path is the first one on the way up to the root
//   conflicts    all on the way up, except where one of the two agents has another path further down
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "planners/mapf/problem.hpp"

namespace dmrp::planners {

using NodeId = std::int32_t;
constexpr NodeId no_node = -1;

// A contiguous part of an array.
struct Range {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

// Appends copies of the elements to an array; they may be of another type.
template <class Element, class Elements>
Range append(std::vector<Element>& array, const Elements& elements) {
  const auto begin = static_cast<std::uint32_t>(array.size());
  for (const auto& element : elements) array.push_back(Element{element});
  return {begin, static_cast<std::uint32_t>(array.size())};
}

// Copies of paths, in blocks. They do not move until clear().
class PathStore {
 public:
  PathView add(PathView path) {
    if (used_ + path.size() > size_) add_block(path.size());
    Location* const begin = blocks_.back().get() + used_;
    std::copy(path.begin(), path.end(), begin);
    used_ += path.size();
    return {begin, path.size()};
  }

  // Keeps the first block for reuse.
  void clear() {
    if (blocks_.size() > 1) blocks_.resize(1);
    used_ = 0;
    size_ = first_size_;
  }

 private:
  void add_block(std::size_t at_least) {
    const std::size_t usual = std::size_t{1} << (blocks_.empty() ? 12 : 16);
    size_ = std::max(at_least, usual);
    if (blocks_.empty()) first_size_ = size_;
    blocks_.push_back(std::make_unique_for_overwrite<Location[]>(size_));
    used_ = 0;
  }

  std::vector<std::unique_ptr<Location[]>> blocks_;
  std::size_t used_ = 0;  // of the last block
  std::size_t size_ = 0;  // of the last block
  std::size_t first_size_ = 0;
};

// A Node has `parent` and the ranges `paths` and `conflicts`, an AgentPath `agent` and `locations`, a Conflict the
// agents `a` and `b`.
template <class Node, class AgentPath, class Conflict>
class DifferenceTree {
 public:
  // Empties the tree. Its nodes are about `members` agents, whose numbers are below `agent_count`.
  void reset(std::size_t agent_count, std::size_t members) {
    members_ = members;
    nodes_.clear();
    paths_.clear();
    conflicts_.clear();
    locations_.clear();
    met_.assign(agent_count, 0);
    walk_ = 0;
  }

  // Adds a node and copies its paths. Fills in its ranges only; the other fields are the caller's.
  template <class Conflicts>
  NodeId add(Node node, std::span<const AgentPath> paths, const Conflicts& conflicts) {
    assert(node.parent < node_count());
    node.paths = append(paths_, paths);
    for (std::uint32_t i = node.paths.begin; i < node.paths.end; ++i)
      paths_[i].locations = locations_.add(paths_[i].locations);
    node.conflicts = append(conflicts_, conflicts);
    nodes_.push_back(node);
    return static_cast<NodeId>(nodes_.size()) - 1;
  }

  Node& node(NodeId id) { return nodes_[static_cast<std::size_t>(id)]; }
  const Node& node(NodeId id) const { return nodes_[static_cast<std::size_t>(id)]; }
  std::int64_t node_count() const { return static_cast<std::int64_t>(nodes_.size()); }

  Conflict& conflict(std::uint32_t index) { return conflicts_[index]; }
  const Conflict& conflict(std::uint32_t index) const { return conflicts_[index]; }

  // The members' paths in a node, by agent. They do not move until reset().
  void gather_paths(NodeId id, std::vector<AgentPath>& out) {
    assert(id < node_count() && out.size() >= met_.size());
    ++walk_;
    for (std::size_t missing = members_; missing > 0; id = node(id).parent)
      for (std::uint32_t i = node(id).paths.begin; i < node(id).paths.end; ++i) {
        const auto agent = static_cast<std::size_t>(paths_[i].agent);
        if (met_[agent] == walk_) continue;
        met_[agent] = walk_;
        out[agent] = paths_[i];
        --missing;
      }
  }

  // Indices for conflict(), nearest nodes first, those of one node in the order in which they were added.
  void gather_conflicts(NodeId id, std::vector<std::uint32_t>& out) {
    out.clear();
    ++walk_;
    const auto was_replanned = [this](std::int32_t agent) { return met_[static_cast<std::size_t>(agent)] == walk_; };
    for (; id != no_node; id = node(id).parent) {
      for (std::uint32_t i = node(id).conflicts.begin; i < node(id).conflicts.end; ++i)
        if (!was_replanned(conflicts_[i].a) && !was_replanned(conflicts_[i].b)) out.push_back(i);
      for (std::uint32_t i = node(id).paths.begin; i < node(id).paths.end; ++i)
        met_[static_cast<std::size_t>(paths_[i].agent)] = walk_;
    }
  }

 private:
  std::size_t members_ = 0;
  std::vector<Node> nodes_;
  std::vector<AgentPath> paths_;
  std::vector<Conflict> conflicts_;
  PathStore locations_;
  std::vector<std::uint32_t> met_;  // by agent: the last walk up the tree that met a path of it
  std::uint32_t walk_ = 0;
};

}  // namespace dmrp::planners
