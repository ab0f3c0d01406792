// SPDX-License-Identifier: MIT
#include "planners/conflict_search/high_level/constraint_tree.hpp"

#include <algorithm>

namespace dmrp::planners {

namespace {

constexpr std::size_t first_block_size = std::size_t{1} << 12;
constexpr std::size_t block_size = std::size_t{1} << 16;

template <class Element, class Elements>
Range append(std::vector<Element>& array, const Elements& elements) {
  const auto begin = static_cast<std::uint32_t>(array.size());
  for (const auto& element : elements) array.push_back(Element{element});
  return {begin, static_cast<std::uint32_t>(array.size())};
}

}  // namespace

void ConstraintTree::reset(std::size_t agent_count, std::vector<std::int32_t> members) {
  members_ = std::move(members);
  nodes_.clear();
  paths_.clear();
  constraints_.clear();
  conflicts_.clear();
  splits_.clear();
  if (blocks_.size() > 1) blocks_.resize(1);
  block_used_ = 0;
  block_size_ = 0;
  met_.assign(agent_count, 0);
  walk_ = 0;
}

NodeId ConstraintTree::add(Node node, std::span<const AgentPath> paths, std::span<const Constraint> constraints,
                           std::span<const Conflict> conflicts) {
  node.paths.begin = static_cast<std::uint32_t>(paths_.size());
  for (const AgentPath& path : paths) paths_.push_back({path.agent, path.lower_bound, store(path.locations)});
  node.paths.end = static_cast<std::uint32_t>(paths_.size());
  node.constraints = append(constraints_, constraints);
  node.conflicts = append(conflicts_, conflicts);
  nodes_.push_back(node);
  return static_cast<NodeId>(nodes_.size()) - 1;
}

std::uint32_t ConstraintTree::add_split(Split split) {
  splits_.push_back(std::move(split));
  return static_cast<std::uint32_t>(splits_.size()) - 1;
}

PathView ConstraintTree::store(PathView path) {
  if (block_used_ + path.size() > block_size_) {
    // The first block is kept from one search to the next, so its size is always the same.
    if (blocks_.empty()) blocks_.push_back(std::make_unique_for_overwrite<Location[]>(first_block_size));
    if (blocks_.size() == 1 && block_used_ == 0 && path.size() <= first_block_size) {
      block_size_ = first_block_size;
    } else {
      block_size_ = std::max(path.size(), block_size);
      blocks_.push_back(std::make_unique_for_overwrite<Location[]>(block_size_));
    }
    block_used_ = 0;
  }
  Location* const begin = blocks_.back().get() + block_used_;
  std::copy(path.begin(), path.end(), begin);
  block_used_ += path.size();
  return {begin, path.size()};
}

void ConstraintTree::gather_paths(NodeId id, std::vector<AgentPath>& out) {
  ++walk_;
  std::size_t missing = members_.size();
  for (; missing > 0; id = node(id).parent)
    for (std::uint32_t i = node(id).paths.begin; i < node(id).paths.end; ++i) {
      const auto who = static_cast<std::size_t>(paths_[i].agent);
      if (met_[who] == walk_) continue;
      met_[who] = walk_;
      out[who] = paths_[i];
      --missing;
    }
}

void ConstraintTree::gather_constraints(NodeId id, std::int32_t agent, std::vector<Constraint>& out) const {
  out.clear();
  for (; id != no_node; id = node(id).parent)
    for (std::uint32_t i = node(id).constraints.begin; i < node(id).constraints.end; ++i) {
      if (constraints_[i].agent == agent)
        out.push_back(constraints_[i]);
      else if (constraints_[i].binds_others())
        out.push_back(constraints_[i].for_another(agent));
    }
}

// Sums, so that order does not matter; what binds others is summed once for all of them.
void ConstraintTree::gather_signatures(NodeId id, std::vector<std::uint64_t>& out) const {
  for (const std::int32_t agent : members_) out[static_cast<std::size_t>(agent)] = 0;
  std::uint64_t for_all = 0;
  for (; id != no_node; id = node(id).parent)
    for (std::uint32_t i = node(id).constraints.begin; i < node(id).constraints.end; ++i) {
      const Constraint& c = constraints_[i];
      std::uint64_t& own = out[static_cast<std::size_t>(c.agent)];
      own += hash_of(c);
      if (!c.binds_others()) continue;
      const std::uint64_t for_others = hash_of(c.for_another(-1));
      for_all += for_others;
      own -= for_others;
    }
  for (const std::int32_t agent : members_) out[static_cast<std::size_t>(agent)] += for_all;
}

void ConstraintTree::gather_conflicts(NodeId id, std::vector<std::uint32_t>& out) {
  out.clear();
  ++walk_;
  const auto was_replaced = [this](std::int32_t agent) { return met_[static_cast<std::size_t>(agent)] == walk_; };
  for (; id != no_node; id = node(id).parent) {
    for (std::uint32_t i = node(id).conflicts.begin; i < node(id).conflicts.end; ++i)
      if (!was_replaced(conflicts_[i].conflict.a) && !was_replaced(conflicts_[i].conflict.b)) out.push_back(i);
    for (std::uint32_t i = node(id).paths.begin; i < node(id).paths.end; ++i)
      met_[static_cast<std::size_t>(paths_[i].agent)] = walk_;
  }
}

}  // namespace dmrp::planners
