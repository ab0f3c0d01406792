// SPDX-License-Identifier: MIT
// draws.hpp: how many random cases a property is tried on.
#pragma once

namespace dmrp::test {

// A quarter, at least one: most faults show in the first draws, as does what sanitizers look for, which depends on the
// lines that run. All in .ci/nightly, with and without sanitizers.
template <class Count>
constexpr Count draws(Count all) {
#ifdef DMRP_FEWER_DRAWS
  return (all + 3) / 4;
#else
  return all;
#endif
}

}  // namespace dmrp::test
