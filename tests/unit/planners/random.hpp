// SPDX-License-Identifier: MIT
// Reproducible random numbers for test cases (SplitMix64).
#pragma once

#include <cstdint>

namespace dmrp::test {

class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  int below(int n) {
    uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return static_cast<int>((z ^ (z >> 31)) % static_cast<uint64_t>(n));
  }
  bool one_in(int n) { return below(n) == 0; }

 private:
  uint64_t state_;
};

}  // namespace dmrp::test
