// SPDX-License-Identifier: MIT
// The memory that IBTR needs: it may grow with the encounters of robots, not with the duration of a trial.
#include <malloc.h>

#include <catch2/catch.hpp>

#include "tests/unit/metrics/synthetic_trial.hpp"

namespace ibtr_memory_test {

using namespace dmrp::test;

// What the C library has handed out, also as mappings of their own. (Sanitizers replace it and report 0.)
std::size_t bytes_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

// Bytes that the metric keeps for 100,000 samples of two robots that are this far apart.
std::size_t bytes_kept(double apart_m) {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}}, {{apart_m, 0}}});
  trial.sample(0.0, {at(0, 0, 0.5), at(apart_m, 0, 0.5)});
  trial.end(0.0);
  PluginUnderTest plugin("libdmrp_metrics.so", "dmrp.metric.ibtr");
  const dmrp_metric& metric = plugin.as<dmrp_metric>();
  const dmrp_world world = trial.world();
  const dmrp_metric_trial beginning = {sizeof(dmrp_metric_trial), 0, trial.first_plan()};
  REQUIRE(plugin.start(world) == DMRP_OK);
  REQUIRE(metric.begin(plugin.self(), &beginning) == DMRP_OK);

  const std::size_t before = bytes_in_use();
  int refused = 0;
  trial.for_each_sample([&](dmrp_sample sample) {
    for (int i = 0; i < 100'000; ++i) {
      refused += metric.observe(plugin.self(), &sample) != DMRP_OK;
      sample.dt_ns = 20'000'000;
      sample.t_ns += sample.dt_ns;
    }
  });
  REQUIRE(refused == 0);
  return bytes_in_use() - before;
}

TEST_CASE("IBTR keeps nothing of robots that are far from each other") {
  CHECK(bytes_kept(50.0) < 4096);
}

}  // namespace ibtr_memory_test
