// SPDX-License-Identifier: MIT
#include "core/sensors/sensor_noise.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>
#include <vector>

namespace sensor_noise_test {

using namespace dmrp;
using namespace dmrp::core;

constexpr float nothing = std::numeric_limits<float>::infinity();

TEST_CASE("ranges get normal noise within the lidar's range, and beams drop out") {
  LidarSettings settings;
  settings.beams = 20000;
  settings.range_min_m = 0.5;
  settings.noise_sd_m = 0.1;
  const std::vector<float> exact(settings.beams, 4.0f);
  std::vector<float> ranges = exact;
  disturb_scan(settings, {3, 1, 700}, ranges);
  double sum = 0.0;
  double squares = 0.0;
  for (const float range : ranges) {
    const double error = static_cast<double>(range) - 4.0;
    sum += error;
    squares += error * error;
  }
  CHECK(std::abs(sum / settings.beams) < 0.003);
  CHECK(std::sqrt(squares / settings.beams) == Approx(0.1).margin(0.003));

  // drop-outs change no other beam
  const std::vector<float> noisy = ranges;
  settings.dropout_share = 0.25;
  ranges = exact;
  disturb_scan(settings, {3, 1, 700}, ranges);
  int dropped = 0;
  int changed = 0;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (std::isinf(ranges[i])) {
      ++dropped;
    } else if (ranges[i] != noisy[i]) {
      ++changed;
    }
  }
  CHECK(dropped == Approx(5000).margin(250));
  CHECK(changed == 0);

  // another time, another robot: other noise
  settings.dropout_share = 0.0;
  for (const Reading& other : {Reading{3, 1, 701}, Reading{3, 2, 700}, Reading{4, 1, 700}}) {
    ranges = exact;
    disturb_scan(settings, other, ranges);
    CHECK(ranges != noisy);
  }

  // hits stay hits, misses misses
  ranges = {0.5f, 10.0f, nothing};
  settings.noise_sd_m = 5.0;
  disturb_scan(settings, {3, 1, 700}, ranges);
  for (int i : {0, 1}) CHECK((ranges[i] >= 0.5f && ranges[i] <= 10.0f));
  CHECK(ranges[2] == nothing);

  ranges = exact;
  disturb_scan(LidarSettings{}, {3, 1, 700}, ranges);
  CHECK(ranges == exact);
}

TEST_CASE("an agent's velocity noise does not depend on other agents") {
  const auto agent = [](std::uint64_t id, std::uint32_t kind) {
    dmrp_agent made{};
    made.id = id;
    made.kind = kind;
    made.velocity = {1.0, -0.5};
    return made;
  };
  std::vector<dmrp_agent> few = {agent(2, DMRP_AGENT_PERSON)};
  std::vector<dmrp_agent> many = {agent(2, DMRP_AGENT_ROBOT), agent(1, DMRP_AGENT_PERSON), agent(2, DMRP_AGENT_PERSON)};
  disturb_agents(0.1, {1, 0, 50}, few);
  disturb_agents(0.1, {1, 0, 50}, many);
  CHECK(few[0].velocity == many[2].velocity);
  CHECK(few[0].velocity != dmrp_vec2{1.0, -0.5});
  CHECK(many[0].velocity != many[2].velocity);
  CHECK(many[1].velocity != many[2].velocity);

  double squares = 0.0;
  for (std::int64_t t = 0; t < 5000; ++t) {
    std::vector<dmrp_agent> one = {agent(1, DMRP_AGENT_PERSON)};
    disturb_agents(0.1, {1, 0, t}, one);
    squares += toolkit::squared_distance(one[0].velocity, {1.0, -0.5});
  }
  CHECK(std::sqrt(squares / 10000.0) == Approx(0.1).margin(0.004));
  disturb_agents(0.0, {1, 0, 50}, few);
  CHECK(few[0].velocity == many[2].velocity);
}

}  // namespace sensor_noise_test
