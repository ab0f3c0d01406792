// SPDX-License-Identifier: MIT
// draws.hpp: how many random cases a property is tried on.
#pragma once

namespace dmrp::test {

// All; in .ci/run under sanitizers a quarter, at least one: instrumented code takes ten times as long, and what the
// sanitizers look for depends on which lines run, which the first draws decide. .ci/nightly tries all under sanitizers.
template <class Count>
constexpr Count draws(Count all) {
#ifdef DMRP_FEWER_DRAWS
  return (all + 3) / 4;
#else
  return all;
#endif
}

}  // namespace dmrp::test
