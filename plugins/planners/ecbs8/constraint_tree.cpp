// SPDX-License-Identifier: MIT
#include "planners/ecbs8/constraint_tree.hpp"

#include <algorithm>

namespace dmrp::planners::ecbs8 {

NodeId ConstraintTree::add(Node node, const std::vector<AgentPath>& paths, const std::vector<Conflict>& conflicts) {
  node.paths.begin = static_cast<std::uint32_t>(paths_.size());
  for (const AgentPath& path : paths) {
    paths_.push_back(path);
    paths_.back().locations = store(path.locations);
  }
  node.paths.end = static_cast<std::uint32_t>(paths_.size());
  node.conflicts.begin = static_cast<std::uint32_t>(conflicts_.size());
  conflicts_.insert(conflicts_.end(), conflicts.begin(), conflicts.end());
  node.conflicts.end = static_cast<std::uint32_t>(conflicts_.size());
  nodes_.push_back(node);
  return static_cast<NodeId>(nodes_.size()) - 1;
}

PathView ConstraintTree::store(PathView path) {
  if (block_used_ + path.size() > block_size_) {
    block_size_ = std::max<std::size_t>(path.size(), 1 << 14);
    blocks_.emplace_back(new Location[block_size_]);
    block_used_ = 0;
  }
  Location* const begin = blocks_.back().get() + block_used_;
  std::copy(path.begin(), path.end(), begin);
  block_used_ += path.size();
  return {begin, path.size()};
}

void ConstraintTree::gather_paths(NodeId id, std::vector<AgentPath>& out) {
  out.resize(replaced_.size());
  ++walk_;
  std::size_t missing = replaced_.size();
  for (; id >= 0 && missing > 0; id = node(id).parent)
    for (std::uint32_t i = node(id).paths.begin; i < node(id).paths.end; ++i) {
      const auto agent = static_cast<std::size_t>(paths_[i].agent);
      if (replaced_[agent] == walk_) continue;
      replaced_[agent] = walk_;
      out[agent] = paths_[i];
      --missing;
    }
}

void ConstraintTree::gather_constraints(NodeId id, std::int32_t agent, std::vector<Constraint>& out) const {
  out.clear();
  for (; id >= 0; id = node(id).parent)
    if (node(id).constrained_agent == agent) out.push_back(node(id).constraint);
}

void ConstraintTree::gather_conflicts(NodeId id, std::vector<std::uint32_t>& out) {
  out.clear();
  ++walk_;
  const auto was_replaced = [this](std::int32_t agent) { return replaced_[static_cast<std::size_t>(agent)] == walk_; };
  for (; id >= 0; id = node(id).parent) {
    for (std::uint32_t i = node(id).conflicts.begin; i < node(id).conflicts.end; ++i)
      if (!was_replaced(conflicts_[i].a) && !was_replaced(conflicts_[i].b)) out.push_back(i);
    for (std::uint32_t i = node(id).paths.begin; i < node(id).paths.end; ++i)
      replaced_[static_cast<std::size_t>(paths_[i].agent)] = walk_;
  }
}

}  // namespace dmrp::planners::ecbs8
