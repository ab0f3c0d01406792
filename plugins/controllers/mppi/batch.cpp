// SPDX-License-Identifier: MIT
#include "controllers/mppi/batch.hpp"

#include <array>
#include <cmath>

namespace dmrp::controllers::mppi {

namespace {

// Where the rows of one step begin in the table of noise.
struct NoiseRows {
  std::uint32_t v_x;
  std::uint32_t v_y;
  std::uint32_t omega;
};

// The state of the samples of one block.
struct State {
  Lanes v_x, v_y, omega;
  Lanes x, y, theta;
  Lanes cosine, sine;  // of theta
};

// Euler's step as in nav2: moves along the heading before the turn.
void move(State& s, float step_s, bool holonomic) {
  s.x += s.v_x * s.cosine * step_s;
  s.y += s.v_x * s.sine * step_s;
  if (holonomic) {
    s.x -= s.v_y * s.sine * step_s;
    s.y += s.v_y * s.cosine * step_s;
  }
  // series up to the ninth power: exact to a float's precision for turns below 1 rad
  const Lanes turn = s.omega * step_s;
  const Lanes q = turn * turn;
  const Lanes sine = turn * (1.0f - q / 6.0f * (1.0f - q / 20.0f * (1.0f - q / 42.0f * (1.0f - q / 72.0f))));
  const Lanes cosine = 1.0f - q / 2.0f * (1.0f - q / 12.0f * (1.0f - q / 30.0f * (1.0f - q / 56.0f)));
  const Lanes before = s.cosine;
  s.cosine = before * cosine - s.sine * sine;
  s.sine = s.sine * cosine + before * sine;
  s.theta += turn;
}

constexpr float unbounded = -std::numeric_limits<float>::infinity();

// The next control of one axis: mean and noise, at least `least`, within reach of the velocity, which it becomes.
void choose(float mean, float deviation, const Eigen::Map<const Lanes>& noise, float reach, float least,
            Lanes& velocity, Lanes& control) {
  velocity = (mean + deviation * noise).max(least).max(velocity - reach).min(velocity + reach);
  control = velocity;
}

}  // namespace

void Batch::resize(int samples, const Model& model) {
  blocks = (samples + lanes - 1) / lanes;
  steps = model.steps;
  for (Field* field : {&v_x, &omega, &x, &y, &theta}) field->resize(blocks, steps);
  v_y.resize(model.holonomic ? blocks : 0, steps);
}

void sample(const Model& model, const Sequence& mean, const Noise& noise, std::uint32_t cycle, Velocity now,
            float theta, Batch& batch) {
  batch.now = now;
  std::array<NoiseRows, 256> rows;  // model.steps of them are used
  for (int i = 0; i < batch.steps; ++i) {
    const auto step = static_cast<std::uint32_t>(i);
    rows[static_cast<std::size_t>(i)] = {noise.row(cycle, step, 0), noise.row(cycle, step, 1),
                                         noise.row(cycle, step, 2)};
  }
  const float reach = model.limits.a_max * model.step_s;
  const float turn_reach = model.limits.alpha_max * model.step_s;
  const Velocity& deviation = model.deviation;
  const auto all = [](float value) { return Lanes::Constant(value); };
  const State start = {all(now.v_x), all(now.v_y), all(now.omega),       all(0.0f),
                       all(0.0f),    all(theta),   all(std::cos(theta)), all(std::sin(theta))};
  for (int block = 0; block < batch.blocks; ++block) {
    State s = start;
    for (int i = 0; i < batch.steps; ++i) {
      move(s, model.step_s, model.holonomic);
      batch.x.row(block, i) = s.x;
      batch.y.row(block, i) = s.y;
      batch.theta.row(block, i) = s.theta;
      const Velocity& m = mean[static_cast<std::size_t>(i)];
      const NoiseRows& row = rows[static_cast<std::size_t>(i)];
      choose(m.v_x, deviation.v_x, noise.block(row.v_x, block), reach, model.slowest_m_s, s.v_x,
             batch.v_x.row(block, i));
      choose(m.omega, deviation.omega, noise.block(row.omega, block), turn_reach, unbounded, s.omega,
             batch.omega.row(block, i));
      if (model.holonomic)
        choose(m.v_y, deviation.v_y, noise.block(row.v_y, block), reach, unbounded, s.v_y, batch.v_y.row(block, i));
    }
  }
}

}  // namespace dmrp::controllers::mppi
