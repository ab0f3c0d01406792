// SPDX-License-Identifier: MIT
// The edge-weighted vertex cover, against trying all values.
#include "planners/conflict_search/high_level/vertex_cover.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/planners/mapf/problem_case.hpp"
#include "tests/unit/planners/random.hpp"

namespace vertex_cover_test {

using namespace dmrp::test;
using namespace dmrp::planners;

// By trying all values up to the greatest weight.
int least_cover_by_trying(const std::vector<DependentPair>& pairs, int agents, int most) {
  std::vector<int> value(static_cast<std::size_t>(agents), 0);
  int best = agents * most;
  for (std::size_t i = 0; i < value.size();) {
    const bool covers = std::all_of(pairs.begin(), pairs.end(), [&](const DependentPair& pair) {
      return value[static_cast<std::size_t>(pair.a)] + value[static_cast<std::size_t>(pair.b)] >= pair.weight;
    });
    if (covers) best = std::min(best, std::accumulate(value.begin(), value.end(), 0));
    for (i = 0; i < value.size() && ++value[i] > most; ++i) value[i] = 0;
  }
  return best;
}

TEST_CASE("a weighted vertex cover is minimal") {
  for (uint64_t seed = 0; seed < 1500; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const int agents = 2 + random.below(4);
    const int most = 1 + random.below(4);
    std::vector<DependentPair> pairs;
    for (int a = 0; a < agents; ++a)
      for (int b = a + 1; b < agents; ++b)
        if (random.one_in(2)) pairs.push_back({10 * a, 10 * b, 1 + random.below(most)});
    std::vector<DependentPair> numbered = pairs;
    for (DependentPair& pair : numbered) pair.a /= 10, pair.b /= 10;
    REQUIRE(least_edge_weighted_cover(pairs, never()) == least_cover_by_trying(numbered, agents, most));
  }
}

TEST_CASE("where the least weighted vertex cover takes too long, a lower bound replaces it") {
  std::vector<DependentPair> all;
  for (int a = 0; a < 40; ++a)
    for (int b = a + 1; b < 40; ++b) all.push_back({a, b, 1 + (a * 7 + b * 3) % 4});
  const int cover = least_edge_weighted_cover(all, never());
  CHECK(cover >= 4 * 10);  // of pairs without a common agent
  CHECK(cover <= 40 * 2);  // two for each agent cover all pairs
}

}  // namespace vertex_cover_test
