// SPDX-License-Identifier: MIT
// Sampling, weighting and smoothing of MPPI.
#include "controllers/mppi/optimizer.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

namespace optimizer_test {

using namespace dmrp::controllers::mppi;

Model model(bool holonomic = false) {
  Model m;
  m.steps = 30;
  m.step_s = 0.1f;
  m.holonomic = holonomic;
  m.deviation = {0.2f, 0.2f, 0.4f};
  m.limits = {-0.2f, 0.8f, 0.5f, 1.0f, 1.0f, 1.0f};
  return m;
}

Batch sampled(const Model& m, const Sequence& mean, std::uint64_t seed, std::int32_t robot, std::uint32_t cycle,
              int samples = 2000) {
  Noise noise;
  noise.start(seed, robot);
  Batch batch;
  batch.resize(samples, m);
  sample(m, mean, noise, cycle, {0.3f, 0.1f, 0.2f}, 0.5f, batch);
  return batch;
}

bool same_bits(const Batch& a, const Batch& b) {
  for (int s = 0; s < a.samples(); ++s)
    for (int i = 0; i < a.steps; ++i) {
      const float va = a.v_x.at(s, i);
      const float vb = b.v_x.at(s, i);
      if (std::memcmp(&va, &vb, sizeof(float)) != 0) return false;
    }
  return true;
}

TEST_CASE("MPPI's samples are named by seed, robot and cycle") {
  const Model m = model();
  const Sequence mean(30);
  const Batch batch = sampled(m, mean, 7, 2, 5);
  CHECK(same_bits(batch, sampled(m, mean, 7, 2, 5)));
  CHECK_FALSE(same_bits(batch, sampled(m, mean, 8, 2, 5)));
  CHECK_FALSE(same_bits(batch, sampled(m, mean, 7, 3, 5)));
  CHECK_FALSE(same_bits(batch, sampled(m, mean, 7, 2, 6)));
}

TEST_CASE("MPPI's noise is standard normal in every row") {
  Noise noise;
  noise.start(1, 0);
  for (const std::uint32_t step : {0u, 1u, 55u}) {
    const std::uint32_t row = noise.row(3, step, 2);
    double sum = 0.0, squares = 0.0;
    const int blocks = 500;
    for (int block = 0; block < blocks; ++block)
      for (int l = 0; l < lanes; ++l) {
        const auto value = static_cast<double>(noise.block(row, block)[l]);
        sum += value;
        squares += value * value;
      }
    const double count = blocks * lanes;
    CHECK(std::abs(sum / count) < 4.0 / std::sqrt(count));
    CHECK(squares / count == Approx(1.0).margin(4.0 * std::sqrt(2.0 / count)));
  }
}

TEST_CASE("MPPI's trajectories are those of their controls, within the accelerations") {
  const bool holonomic = GENERATE(false, true);
  const Model m = model(holonomic);
  const Batch batch = sampled(m, Sequence(30, {0.4f, -0.1f, 0.3f}), 1, 0, 1, 64);
  for (int s = 0; s < batch.samples(); ++s) {
    double v_x = 0.3f, v_y = holonomic ? 0.1f : 0.0f, omega = 0.2f, x = 0.0, y = 0.0, theta = 0.5;
    for (int i = 0; i < batch.steps; ++i) {
      x += 0.1 * (v_x * std::cos(theta) - v_y * std::sin(theta));
      y += 0.1 * (v_x * std::sin(theta) + v_y * std::cos(theta));
      theta += 0.1 * omega;
      REQUIRE(batch.x.at(s, i) == Approx(x).margin(1e-5));
      REQUIRE(batch.y.at(s, i) == Approx(y).margin(1e-5));
      REQUIRE(batch.theta.at(s, i) == Approx(theta).margin(1e-5));
      REQUIRE(std::abs(batch.v_x.at(s, i) - v_x) < 0.1 + 1e-6);
      REQUIRE(std::abs(batch.omega.at(s, i) - omega) < 0.1 + 1e-6);
      v_x = batch.v_x.at(s, i);
      omega = batch.omega.at(s, i);
      if (holonomic) v_y = batch.v_y.at(s, i);
    }
  }
}

TEST_CASE("MPPI's samples have the bits of a sample computed alone") {
  const bool holonomic = GENERATE(false, true);
  Model m = model(holonomic);
  m.slowest_m_s = 0.0f;
  const Velocity mean = {0.1f, -0.1f, 0.3f};
  const Batch batch = sampled(m, Sequence(30, mean), 1, 0, 1, 64);
  Noise noise;
  noise.start(1, 0);
  for (int s = 0; s < batch.samples(); ++s) {
    const auto next = [&](float about, float deviation, int step, std::uint32_t axis, float least, float before) {
      const std::uint32_t row = noise.row(1, static_cast<std::uint32_t>(step), axis);
      const float wanted = std::max(about + deviation * noise.block(row, s / lanes)[s % lanes], least);
      return std::min(std::max(wanted, before - 1.0f * m.step_s), before + 1.0f * m.step_s);
    };
    Velocity v = batch.now;
    float x = 0.0f, y = 0.0f, theta = 0.5f, cosine = std::cos(0.5f), sine = std::sin(0.5f);
    for (int i = 0; i < batch.steps; ++i) {
      x += v.v_x * cosine * m.step_s;
      y += v.v_x * sine * m.step_s;
      if (holonomic) {
        x -= v.v_y * sine * m.step_s;
        y += v.v_y * cosine * m.step_s;
      }
      const float turn = v.omega * m.step_s;
      const float q = turn * turn;
      const float sin = turn * (1.0f - q / 6.0f * (1.0f - q / 20.0f * (1.0f - q / 42.0f * (1.0f - q / 72.0f))));
      const float cos = 1.0f - q / 2.0f * (1.0f - q / 12.0f * (1.0f - q / 30.0f * (1.0f - q / 56.0f)));
      const float before = cosine;
      cosine = before * cos - sine * sin;
      sine = sine * cos + before * sin;
      theta += turn;
      v.v_x = next(mean.v_x, m.deviation.v_x, i, 0, 0.0f, v.v_x);
      v.omega = next(mean.omega, m.deviation.omega, i, 2, -INFINITY, v.omega);
      if (holonomic) v.v_y = next(mean.v_y, m.deviation.v_y, i, 1, -INFINITY, v.v_y);
      REQUIRE(batch.x.at(s, i) == x);
      REQUIRE(batch.y.at(s, i) == y);
      REQUIRE(batch.theta.at(s, i) == theta);
      REQUIRE(batch.v_x.at(s, i) == v.v_x);
      REQUIRE(batch.omega.at(s, i) == v.omega);
      if (holonomic) REQUIRE(batch.v_y.at(s, i) == v.v_y);
    }
  }
}

TEST_CASE("MPPI averages controls with weights that fall by e per temperature of cost") {
  Model m = model();
  m.steps = 8;  // too short to be smoothed
  Optimizer optimizer;
  optimizer.start(m, {0.5f, 0.0f});
  Batch batch;
  batch.resize(lanes, m);
  std::vector<float> costs(lanes, 1000.0f);
  costs[0] = 3.0f;
  costs[1] = 3.5f;
  for (int i = 0; i < m.steps; ++i) batch.v_x.at(0, i) = 0.2f;
  for (int i = 0; i < m.steps; ++i) batch.v_x.at(1, i) = 0.6f;
  optimizer.update(batch, costs);
  const double weight = 1.0 / (1.0 + std::exp(-1.0));
  CHECK(optimizer.sequence()[3].v_x == Approx(weight * 0.2 + (1.0 - weight) * 0.6).epsilon(1e-5));

  optimizer.shift(2);
  CHECK(optimizer.sequence().size() == 8);
  CHECK(optimizer.sequence().back().v_x == optimizer.sequence().front().v_x);
}

TEST_CASE("MPPI's control cost prefers samples near rest") {
  Model m = model();
  Optimizer optimizer;
  optimizer.start(m, {0.3f, 0.4f});
  Batch batch;
  batch.resize(lanes, m);
  for (int s = 0; s < lanes; ++s)
    for (int i = 0; i < m.steps; ++i) batch.v_x.at(s, i) = 0.1f;
  std::vector<float> costs(lanes, 0.0f);
  optimizer.update(batch, costs);  // the sequence is 0.1 m/s now
  for (int i = 0; i < m.steps; ++i) batch.v_x.at(0, i) = 0.2f;
  costs.assign(lanes, 0.0f);
  optimizer.update(batch, costs);
  // gamma / deviation^2 * sum of (control - mean) * mean; the weights tell
  const double cost = 0.4 / 0.04 * 30 * 0.1 * 0.1;
  CHECK(costs[0] / costs[1] == Approx(std::exp(-cost / 0.3)).epsilon(1e-3));
}

TEST_CASE("MPPI's sequence keeps the limits and the accelerations") {
  Model m = model();
  Optimizer optimizer;
  optimizer.start(m, {0.3f, 0.0f});
  Batch batch;
  batch.resize(lanes, m);
  for (int s = 0; s < lanes; ++s)
    for (int i = 0; i < m.steps; ++i) batch.v_x.at(s, i) = i < 2 ? 2.0f : -2.0f;
  std::vector<float> costs(lanes, 0.0f);
  optimizer.update(batch, costs);
  CHECK(optimizer.sequence()[0].v_x == 0.8f);
  CHECK(optimizer.sequence()[2].v_x == Approx(0.7));
  CHECK(optimizer.sequence()[29].v_x == -0.2f);
}

TEST_CASE("MPPI's smoothing keeps straight lines and removes jitter") {
  Model m = model();
  Optimizer optimizer;
  optimizer.start(m, {0.3f, 0.0f});
  Batch batch;
  batch.resize(lanes, m);
  for (int s = 0; s < lanes; ++s)
    for (int i = 0; i < m.steps; ++i)
      batch.v_x.at(s, i) = 0.01f * static_cast<float>(i) + (i % 2 == 0 ? 0.02f : -0.02f);
  std::vector<float> costs(lanes, 0.0f);
  optimizer.update(batch, costs);
  optimizer.smooth();
  // of alternating jitter, a quadratic filter over nine points leaves 41/231
  for (std::size_t i = 4; i < 25; ++i) {
    const double left = (i % 2 == 0 ? -0.02 : 0.02) * 41.0 / 231.0;
    CHECK(optimizer.sequence()[i].v_x == Approx(0.01 * static_cast<double>(i) + left).margin(1e-5));
  }
}

}  // namespace optimizer_test
