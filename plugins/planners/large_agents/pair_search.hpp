// SPDX-License-Identifier: MIT
// pair_search.hpp: the least sum of costs of two agents under their bans, by A* over their joint positions. As in
// CBSH2 (Li et al. 2019) it tells what the conflicts of a pair cost at least, and as in MA-CBS (Sharon et al. 2012) its
// paths replace those of a pair that conflicts again and again.
#pragma once

#include <array>
#include <unordered_map>
#include <vector>

#include "planners/large_agents/ban.hpp"

namespace dmrp::planners {

class PairSearch {
 public:
  enum class Result { found, none, too_large, stopped };

  struct Member {
    AgentIndex agent;
    const TourTable& table;
    const BanTable& bans;
  };

  explicit PairSearch(const Fleet& fleet) : fleet_(fleet) {}

  // After Result::found: the paths of both, without conflicts between them. Gives up after `most_nodes`.
  Result search(const Member& a, const Member& b, std::size_t most_nodes, StopSignal& stop,
                std::array<std::vector<Location>, 2>& paths);

 private:
  struct Place {
    Location location;
    std::int32_t leg;
    bool rests;  // has come to rest; its cost does not grow any more
  };
  struct Node {
    std::array<Place, 2> places;
    std::int32_t t;
    std::int32_t cost;
    std::int64_t parent;
  };
  // An order in one number (least estimate, then latest), and the node.
  using Entry = std::pair<std::int64_t, std::int64_t>;

  void list_steps(std::size_t member, const Place& from, std::int32_t t, std::vector<Place>& steps) const;
  bool may_rest(std::size_t member, const Place& place, std::int32_t t) const;
  std::int32_t estimate(std::size_t member, const Place& place, std::int32_t t) const;
  void offer(const Node& node);
  std::uint64_t key_of(const Node& node) const;
  void write(std::int64_t id, std::array<std::vector<Location>, 2>& paths) const;

  const Fleet& fleet_;
  std::array<const Member*, 2> members_{};
  std::int32_t horizon_ = 0;  // from here on times are not distinguished
  std::vector<Node> nodes_;
  std::vector<Entry> open_;                               // a heap
  std::unordered_map<std::uint64_t, std::int32_t> best_;  // cost by joint position and time; never iterated over
};

}  // namespace dmrp::planners
