// SPDX-License-Identifier: MIT
#include "constraint_tree.hpp"

#include <algorithm>

namespace dmrp::planners {

namespace {

template <class Array>
std::uint32_t size_of(const Array& array) {
  return static_cast<std::uint32_t>(array.size());
}

}  // namespace

NodeId ConstraintTree::add(Node node, const std::vector<AgentPath>& paths, const std::vector<Constraint>& constraints,
                           const std::vector<Conflict>& conflicts) {
  node.paths.begin = size_of(paths_);
  for (const AgentPath& path : paths) paths_.push_back({path.agent, store(path.locations)});
  node.paths.end = size_of(paths_);

  node.constraints.begin = size_of(constraints_);
  constraints_.insert(constraints_.end(), constraints.begin(), constraints.end());
  node.constraints.end = size_of(constraints_);

  node.conflicts.begin = size_of(conflicts_);
  for (const Conflict& conflict : conflicts) conflicts_.push_back({conflict, Cardinality::unknown});
  node.conflicts.end = size_of(conflicts_);

  nodes_.push_back(node);
  return static_cast<NodeId>(nodes_.size()) - 1;
}

PathView ConstraintTree::store(PathView path) {
  if (block_used_ + path.size() > block_size_) {
    block_size_ = std::max<std::size_t>(path.size(), 1 << 16);
    blocks_.push_back(std::make_unique<Location[]>(block_size_));
    block_used_ = 0;
  }
  Location* const begin = blocks_.back().get() + block_used_;
  std::copy(path.begin(), path.end(), begin);
  block_used_ += path.size();
  return {begin, path.size()};
}

void ConstraintTree::gather_paths(NodeId id, std::vector<PathView>& out) const {
  out.assign(agent_count_, {});
  for (; id >= 0; id = node(id).parent)
    for (std::uint32_t i = node(id).paths.begin; i < node(id).paths.end; ++i) {
      PathView& path = out[static_cast<std::size_t>(paths_[i].agent)];
      if (path.empty()) path = paths_[i].locations;
    }
}

void ConstraintTree::gather_constraints(NodeId id, std::int32_t agent, std::vector<Constraint>& out) const {
  out.clear();
  for (; id >= 0; id = node(id).parent)
    for (std::uint32_t i = node(id).constraints.begin; i < node(id).constraints.end; ++i)
      if (constraints_[i].agent == agent) out.push_back(constraints_[i]);
}

void ConstraintTree::gather_conflicts(NodeId id, std::vector<std::uint32_t>& out) {
  out.clear();
  ++walk_;
  const auto was_replaced = [this](std::int32_t agent) { return replaced_[static_cast<std::size_t>(agent)] == walk_; };
  for (; id >= 0; id = node(id).parent) {
    for (std::uint32_t i = node(id).conflicts.begin; i < node(id).conflicts.end; ++i)
      if (!was_replaced(conflicts_[i].conflict.a) && !was_replaced(conflicts_[i].conflict.b)) out.push_back(i);
    for (std::uint32_t i = node(id).paths.begin; i < node(id).paths.end; ++i)
      replaced_[static_cast<std::size_t>(paths_[i].agent)] = walk_;
  }
}

}  // namespace dmrp::planners
