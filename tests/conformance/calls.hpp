// SPDX-License-Identifier: MIT
// calls.hpp: calls of the sample library's plugins with elements of a newer host, and the ways in which a call returns.
#pragma once

#include <catch2/catch.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/conformance/sample_library.hpp"
#include "tests/support/newer_host.hpp"

namespace dmrp::test {

struct CallOutcome {
  const char* does;
  std::int32_t status;
  const char* text;
};

// Calls `call(sample)` on an instance of `id` for each way to return.
template <class Call>
void check_outcomes(const char* id, bool returns_status, Call&& call) {
  std::vector<CallOutcome> all = {{"nothing", DMRP_OK, ""},
                                  {"throw", DMRP_ERROR, "thrown on purpose"},
                                  {"throw bad_alloc", DMRP_OUT_OF_MEMORY, ""},
                                  {"throw unsupported", DMRP_UNSUPPORTED, "not for it"},
                                  {"throw number", DMRP_ERROR, "an exception that is no std::exception"}};
  if (returns_status) all.push_back({"warning", DMRP_WARNING, ""});
  if (returns_status) all.push_back({"no solution", DMRP_NO_SOLUTION, ""});
  for (const CallOutcome& outcome : all) {
    CAPTURE(id, outcome.does);
    const Sample sample(id, outcome.does);
    CHECK(call(sample) == outcome.status);
    CHECK(sample.host.error == outcome.text);
  }
}

// A path along the x axis with a waypoint a metre.
struct PathAlongX {
  explicit PathAlongX(int count) {
    for (int i = 0; i < count; ++i) waypoints.push_back({{1.0 * i, 0.0, 0.0, i, 0, 0}});
  }
  dmrp_path c() const {
    return {sizeof(dmrp_path), count_of(waypoints), sizeof(Longer<dmrp_waypoint>), 0, &waypoints.front().known};
  }
  std::vector<Longer<dmrp_waypoint>> waypoints;
};

}  // namespace dmrp::test
