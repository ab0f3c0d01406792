// SPDX-License-Identifier: MIT
#include "controllers/mppi/cost_field.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers::mppi {

namespace {

// A robot that an agent has come too close to may move as long as it comes no closer than this.
constexpr double closer_m = 0.01;

}  // namespace

void CostField::look(const dmrp_costmap& map, const Footprint& footprint, double padding_m, const Pose& robot,
                     const std::vector<Obstacle>& obstacles) {
  map_ = &map;
  const CostmapView view(map);
  check_.emplace(view, footprint, padding_m, robot);
  robot_ = toolkit::position(robot);
  by_cells_ = footprint.part_count == 0 && !check_->starts_too_close();
  const double outer_m = footprint.part_count > 0 ? footprint.radius_m : footprint.inscribed_radius_m;
  surely_free_ = view.highest_cost_at(outer_m + padding_m);
  discs_.clear();
  for (const Obstacle& agent : obstacles) {
    const Vec2 at = agent.center - robot_;
    const double contact_m = footprint.radius_m + agent.radius_m + padding_m;
    discs_.push_back({at, agent.velocity, std::min(contact_m, toolkit::norm(at) - closer_m)});
  }
}

void CostField::set_table(const CostTable& table) {
  table_ = table;
  if (!by_cells_) return;
  CostTable by_cost = table;
  for (std::size_t cost = surely_free_ + std::size_t{1}; cost < by_cost.size(); ++cost) by_cost[cost] = in_contact;
  const std::size_t width = map_->width, height = map_->height;
  values_.assign((width + 2) * (height + 2), by_cost[DMRP_COST_FREE]);
  for (std::size_t row = 0; row < height; ++row)
    for (std::size_t column = 0; column < width; ++column)
      values_[(row + 1) * (width + 2) + column + 1] = by_cost[map_->costs[row * width + column]];
}

Lanes CostField::sum(const Batch& batch, int block, int stride, float step_s) const {
  Lanes sums = Lanes::Zero();
  for (int i = 0; i < batch.steps; i += stride) {
    const Lanes& x = batch.x.row(block, i);
    const Lanes& y = batch.y.row(block, i);
    if (by_cells_)
      add_cells(x, y, sums);
    else
      add_footprints(x, y, batch.theta.row(block, i), sums);
    const double ahead_s = static_cast<double>(step_s) * (i + 1);
    for (const MovingDisc& disc : discs_) add_disc(disc, ahead_s, x, y, sums);
  }
  return sums;
}

void CostField::add_cells(const Lanes& x, const Lanes& y, Lanes& sums) const {
  const auto left = static_cast<float>(map_->origin.x - robot_.x);
  const auto bottom = static_cast<float>(map_->origin.y - robot_.y);
  const auto cells_per_m = static_cast<float>(1.0 / map_->resolution_m);
  const auto width = static_cast<std::int32_t>(map_->width) + 2;  // with the border, which takes NaN too
  const auto height = static_cast<std::int32_t>(map_->height) + 2;
  const Lanes column = Lanes::Zero().max((x - left) * cells_per_m + 1.0f).min(static_cast<float>(width - 1));
  const Lanes row = Lanes::Zero().max((y - bottom) * cells_per_m + 1.0f).min(static_cast<float>(height - 1));
  Eigen::Array<std::int32_t, lanes, 1> cell;
  for (int l = 0; l < lanes; ++l)
    cell[l] = static_cast<std::int32_t>(row[l]) * width + static_cast<std::int32_t>(column[l]);
  for (int l = 0; l < lanes; ++l) sums[l] += values_[static_cast<std::size_t>(cell[l])];
}

// For polygons, and for a robot that already stands too close to an obstacle.
void CostField::add_footprints(const Lanes& x, const Lanes& y, const Lanes& theta, Lanes& sums) const {
  const CostmapView view(*map_);
  for (int l = 0; l < lanes; ++l) {
    const Vec2 at = robot_ + Vec2{static_cast<double>(x[l]), static_cast<double>(y[l])};
    const std::uint8_t cost = view.cost(at);
    if (cost <= surely_free_) {
      sums[l] += table_[cost];
      continue;
    }
    const int checked = check_->cost(directed(at, static_cast<double>(theta[l])));
    sums[l] += checked == in_collision ? in_contact : table_[static_cast<std::size_t>(checked)];
  }
}

// An agent inflates like every obstacle.
void CostField::add_disc(const MovingDisc& disc, double ahead_s, const Lanes& x, const Lanes& y, Lanes& sums) const {
  const Vec2 at = disc.at + ahead_s * disc.velocity;
  const double reach_m = disc.contact_m + map_->inflation_radius_m - map_->inscribed_radius_m;
  const Lanes squared = (x - static_cast<float>(at.x)).square() + (y - static_cast<float>(at.y)).square();
  if (squared.minCoeff() > reach_m * reach_m) return;
  const CostmapView view(*map_);
  for (int l = 0; l < lanes; ++l) {
    const double gap_m = std::sqrt(static_cast<double>(squared[l])) - disc.contact_m;
    if (gap_m <= 0.0)
      sums[l] += in_contact;
    else
      sums[l] += table_[view.highest_cost_at(map_->inscribed_radius_m + gap_m)];
  }
}

bool CostField::is_blocked(Vec2 point) const {
  return CostmapView(*map_).cost(point) >= DMRP_COST_INSCRIBED;
}

}  // namespace dmrp::controllers::mppi
