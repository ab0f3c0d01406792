// SPDX-License-Identifier: MIT
// cost_field.hpp: what the poses of trajectories cost on the costmap and beside moving agents.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "controllers/motion/footprint_check.hpp"
#include "controllers/motion/obstacles.hpp"
#include "controllers/mppi/batch.hpp"

namespace dmrp::controllers::mppi {

// The value of each cost of a cell, 0 to 252. Poses in collision have in_contact instead.
using CostTable = std::array<float, 256>;

// More than any sum of values without a collision.
inline constexpr float in_contact = 1e12f;

class CostField {
 public:
  // The map must outlive the field; `obstacles` holds the moving agents to predict. Once per cycle.
  void look(const dmrp_costmap& map, const Footprint& footprint, double padding_m, const Pose& robot,
            const std::vector<Obstacle>& obstacles);

  // Sets the values of the sums that follow.
  void set_table(const CostTable& table);

  // For the samples of one block: the values of every stride-th pose, summed. At least in_contact where one collides.
  Lanes sum(const Batch& batch, int block, int stride, float step_s) const;

  // Whether a point is in the window of the map.
  bool contains(Vec2 point) const { return CostmapView(*map_).index_of(point) >= 0; }

  // Whether a robot whose centre is there certainly collides.
  bool is_blocked(Vec2 point) const;

  // The costs of the map decay with distance by these.
  double inflation_radius_m() const { return map_->inflation_radius_m; }
  double distance_of(std::uint8_t cost) const { return CostmapView(*map_).distance_of(cost); }
  double inscribed_radius_m() const { return map_->inscribed_radius_m; }

 private:
  // Relative to the robot's position now.
  struct MovingDisc {
    Vec2 at;
    Vec2 velocity;
    double contact_m;  // between the centres
  };

  void add_cells(const Lanes& x, const Lanes& y, Lanes& sums) const;
  void add_footprints(const Lanes& x, const Lanes& y, const Lanes& theta, Lanes& sums) const;
  void add_disc(const MovingDisc& disc, double ahead_s, const Lanes& x, const Lanes& y, Lanes& sums) const;

  const dmrp_costmap* map_ = nullptr;
  std::optional<FootprintCheck> check_;
  Vec2 robot_ = {0.0, 0.0};
  bool by_cells_ = true;          // a cell's cost decides; otherwise the footprint at the pose
  std::uint8_t surely_free_ = 0;  // up to this cost, no pose collides
  std::vector<MovingDisc> discs_;
  CostTable table_{};
  std::vector<float> values_;  // of the cells, in a border of cells for all points outside
};

}  // namespace dmrp::controllers::mppi
