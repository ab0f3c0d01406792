// SPDX-License-Identifier: MIT
#include "controllers/mppi/optimizer.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace dmrp::controllers::mppi {

namespace {

// A quadratic Savitzky-Golay filter over nine controls.
constexpr std::array<float, 9> smoothing = {-21.0f / 231.0f, 14.0f / 231.0f, 39.0f / 231.0f,
                                            54.0f / 231.0f,  59.0f / 231.0f, 54.0f / 231.0f,
                                            39.0f / 231.0f,  14.0f / 231.0f, -21.0f / 231.0f};
constexpr std::size_t half_width = 4;

// Shorter sequences are not smoothed.
constexpr std::size_t least_smoothed = 21;

float weighted_mean(const Field& controls, const Batch& batch, int step, const std::vector<float>& weights) {
  Lanes sums = Lanes::Zero();
  for (int block = 0; block < batch.blocks; ++block)
    sums += Eigen::Map<const Lanes>(weights.data() + block * lanes) * controls.row(block, step);
  return std::accumulate(sums.begin(), sums.end(), 0.0f);  // one after the other
}

float within(float value, float around, float reach) {
  return std::clamp(value, around - reach, around + reach);
}

}  // namespace

void Optimizer::start(const Model& model, const OptimizerSettings& settings) {
  model_ = model;
  settings_ = settings;
  reset();
}

void Optimizer::reset() {
  sequence_.assign(static_cast<std::size_t>(model_.steps), Velocity{});
  unsmoothed_ = sequence_;
  history_ = {};
}

void Optimizer::update(const Batch& batch, std::vector<float>& costs) {
  add_control_costs(batch, costs);
  const float least = *std::min_element(costs.begin(), costs.end());
  float sum = 0.0f;
  for (float& cost : costs) {
    cost = std::exp((least - cost) / settings_.temperature);
    sum += cost;
  }
  for (float& cost : costs) cost /= sum;  // from here on the weights
  for (int i = 0; i < model_.steps; ++i) {
    Velocity& mean = sequence_[static_cast<std::size_t>(i)];
    mean.v_x = weighted_mean(batch.v_x, batch, i, costs);
    mean.omega = weighted_mean(batch.omega, batch, i, costs);
    if (model_.holonomic) mean.v_y = weighted_mean(batch.v_y, batch, i, costs);
  }
  clamp_to_limits();
}

void Optimizer::add_control_costs(const Batch& batch, std::vector<float>& costs) const {
  const auto scale = [this](float deviation) {
    return deviation > 0.0f ? settings_.gamma / (deviation * deviation) : 0.0f;
  };
  const Velocity scales = {scale(model_.deviation.v_x), scale(model_.deviation.v_y), scale(model_.deviation.omega)};
  for (int block = 0; block < batch.blocks; ++block) {
    Eigen::Map<Lanes> cost(costs.data() + block * lanes);
    for (int i = 0; i < model_.steps; ++i) {
      const Velocity& mean = sequence_[static_cast<std::size_t>(i)];
      cost += scales.v_x * mean.v_x * (batch.v_x.row(block, i) - mean.v_x);
      cost += scales.omega * mean.omega * (batch.omega.row(block, i) - mean.omega);
      if (model_.holonomic) cost += scales.v_y * mean.v_y * (batch.v_y.row(block, i) - mean.v_y);
    }
  }
}

void Optimizer::clamp_to_limits() {
  const Limits& limits = model_.limits;
  const float reach = limits.a_max * model_.step_s;
  const float turn_reach = limits.alpha_max * model_.step_s;
  for (std::size_t i = 0; i < sequence_.size(); ++i) {
    Velocity& v = sequence_[i];
    v.v_x = std::clamp(v.v_x, limits.v_min, limits.v_max);
    v.v_y = std::clamp(v.v_y, -limits.v_y_max, limits.v_y_max);
    v.omega = std::clamp(v.omega, -limits.omega_max, limits.omega_max);
    if (i == 0) continue;
    const Velocity& before = sequence_[i - 1];
    v = {within(v.v_x, before.v_x, reach), within(v.v_y, before.v_y, reach), within(v.omega, before.omega, turn_reach)};
  }
}

void Optimizer::smooth() {
  if (sequence_.size() < least_smoothed) return;
  unsmoothed_ = sequence_;
  const auto at = [this](std::size_t place) {  // the history, then the sequence, whose last control goes on
    if (place < half_width) return history_[place];
    return unsmoothed_[std::min(place - half_width, unsmoothed_.size() - 1)];
  };
  for (std::size_t i = 0; i + 1 < sequence_.size(); ++i) {
    Velocity sum;
    for (std::size_t k = 0; k < smoothing.size(); ++k) {
      const Velocity v = at(i + k);
      sum.v_x += smoothing[k] * v.v_x;
      sum.v_y += smoothing[k] * v.v_y;
      sum.omega += smoothing[k] * v.omega;
    }
    sequence_[i] = sum;
  }
}

void Optimizer::shift(int steps) {
  const auto count = std::min(static_cast<std::size_t>(steps), sequence_.size() - 1);
  for (std::size_t i = 0; i < count; ++i) {
    std::rotate(history_.begin(), history_.begin() + 1, history_.end());
    history_.back() = sequence_[i];
  }
  const Velocity last = sequence_.back();
  std::rotate(sequence_.begin(), sequence_.begin() + static_cast<std::ptrdiff_t>(count), sequence_.end());
  std::fill(sequence_.end() - static_cast<std::ptrdiff_t>(count), sequence_.end(), last);
}

}  // namespace dmrp::controllers::mppi
