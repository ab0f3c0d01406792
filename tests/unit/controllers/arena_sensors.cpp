// SPDX-License-Identifier: MIT
#include "tests/unit/controllers/arena_sensors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::test {

namespace {

constexpr std::uint32_t window_cells = 120;
constexpr double resolution_m = 0.05;
constexpr double cost_scaling = 5.0;
constexpr double inflated_beyond_m = 0.3;
constexpr double field_cap_m = 6.0;

std::uint8_t cost_at(double distance, double robot_radius_m) {
  if (distance <= 0.0) return DMRP_COST_LETHAL;
  if (distance < robot_radius_m - 1e-6) return DMRP_COST_INSCRIBED;
  if (distance > robot_radius_m + inflated_beyond_m + 1e-6) return DMRP_COST_FREE;
  return static_cast<std::uint8_t>(std::min(252.0, 252.0 * std::exp(-cost_scaling * (distance - robot_radius_m))));
}

core::Scenario scenario_of(const std::vector<Box>& boxes) {
  core::Scenario scenario;
  scenario.lower = {-100.0, -100.0};
  scenario.upper = {100.0, 100.0};
  for (const Box& box : boxes) {
    core::Shape shape;
    shape.name = "box";
    shape.vertices = {box.lower, {box.upper.x, box.lower.y}, box.upper, {box.lower.x, box.upper.y}};
    scenario.shapes.push_back(shape);
  }
  return scenario;
}

bool same(const Box& a, const Box& b) {
  return a.lower == b.lower && a.upper == b.upper;
}

}  // namespace

ArenaSensors::ArenaSensors(Sight sight, double inscribed_radius_m)
    : sight_(sight), inscribed_radius_m_(inscribed_radius_m), rolling_(core::CostmapSettings{}, inscribed_radius_m) {
  lidar_extension_ = {sizeof(dmrp_lidar), 0, this, [](const dmrp_lidar* self, std::uint32_t robot) {
                        return of(self).given(robot, of(self).scan_);
                      }};
  costmap_extension_ = {sizeof(dmrp_local_costmap), 0, this, [](const dmrp_local_costmap* self, std::uint32_t robot) {
                          return of(self).given(robot, of(self).costmap_);
                        }};
  field_extension_ = {sizeof(dmrp_distance_field), 0, this, [](const dmrp_distance_field* self, std::uint32_t robot) {
                        return of(self).given(robot, of(self).field_);
                      }};
  clusters_extension_ = {sizeof(dmrp_obstacle_clusters), 0, this,
                         [](const dmrp_obstacle_clusters* self, std::uint32_t robot) {
                           return of(self).given(robot, of(self).clusters_);
                         }};
}

void ArenaSensors::offer(FakeHost& host) const {
  host.extensions[DMRP_EXT_LIDAR] = &lidar_extension_;
  host.extensions[DMRP_EXT_LOCAL_COSTMAP] = &costmap_extension_;
  host.extensions[DMRP_EXT_DISTANCE_FIELD] = &field_extension_;
  host.extensions[DMRP_EXT_OBSTACLE_CLUSTERS] = &clusters_extension_;
}

void ArenaSensors::reset() {
  rolling_.reset();
}

void ArenaSensors::set_boxes(const std::vector<Box>& boxes) {
  if (geometry_ && std::equal(boxes.begin(), boxes.end(), boxes_.begin(), boxes_.end(), same)) return;
  boxes_ = boxes;
  geometry_ = std::make_shared<const core::StaticGeometry>(scenario_of(boxes));
  lidar_ = std::make_unique<core::Lidar>(core::LidarSettings{}, geometry_);
  ranges_.resize(lidar_->beams());
}

void ArenaSensors::look(const dmrp_pose& pose, std::int64_t t_ns, const std::vector<core::Disc>& bodies,
                        const std::vector<dmrp_agent>& agents) {
  lidar_->scan(pose, bodies, {}, ranges_);
  scan_ = lidar_->describe(t_ns, ranges_);
  if (sight_ == Sight::scan) {
    rolling_.update(pose, scan_);
    costmap_ = rolling_.costmap();
    field_ = rolling_.distance_field();
  } else {
    see_everywhere(pose, t_ns, bodies);
  }
  clusters_ = cluster_finder_.derive(costmap_, agents);
}

void ArenaSensors::see_everywhere(const dmrp_pose& pose, std::int64_t t_ns, const std::vector<core::Disc>& bodies) {
  // the surfaces of boxes and bodies, on the world's lattice
  const auto corner = [](double centre) {
    return (std::floor(centre / resolution_m) - window_cells / 2) * resolution_m;
  };
  costmap_ = {sizeof(costmap_),
              window_cells,
              window_cells,
              0,
              t_ns,
              resolution_m,
              {corner(pose.x), corner(pose.y)},
              inscribed_radius_m_,
              inscribed_radius_m_ + inflated_beyond_m,
              cost_scaling,
              nullptr};
  lethal_.assign(window_cells * window_cells, 0);
  const auto mark = [&](dmrp_vec2 at) {
    const auto column = static_cast<std::int64_t>(std::floor((at.x - costmap_.origin.x) / resolution_m));
    const auto row = static_cast<std::int64_t>(std::floor((at.y - costmap_.origin.y) / resolution_m));
    if (column >= 0 && row >= 0 && column < window_cells && row < window_cells)
      lethal_[static_cast<std::size_t>(row * window_cells + column)] = 1;
  };
  const auto mark_line = [&](dmrp_vec2 from, dmrp_vec2 to) {
    const int steps = 1 + static_cast<int>(toolkit::distance(from, to) / 0.02);
    for (int i = 0; i <= steps; ++i) mark(toolkit::lerp(from, to, static_cast<double>(i) / steps));
  };
  for (const Box& box : boxes_) {
    const dmrp_vec2 a = box.lower, c = box.upper, b = {c.x, a.y}, d = {a.x, c.y};
    mark_line(a, b), mark_line(b, c), mark_line(c, d), mark_line(d, a);
  }
  for (const core::Disc& body : bodies)
    for (int i = 0; i < 120; ++i) mark(body.center + body.radius_m * toolkit::from_angle(i * toolkit::pi / 60.0));

  const std::vector<float>& distances =
      transform_.compute(window_cells, window_cells, resolution_m, lethal_.data(), field_cap_m);
  costs_.resize(lethal_.size());
  std::transform(distances.begin(), distances.end(), costs_.begin(),
                 [this](float d) { return cost_at(d, inscribed_radius_m_); });
  costmap_.costs = costs_.data();
  field_ = {sizeof(field_),  window_cells, window_cells,    0, t_ns, resolution_m,
            costmap_.origin, field_cap_m,  distances.data()};
}

ArenaNotes::ArenaNotes() {
  extension_.struct_size = sizeof(extension_);
  extension_.context = this;
  extension_.wanted = [](const dmrp_annotate*) -> std::int32_t { return 1; };
  extension_.trajectory = [](const dmrp_annotate* self, const dmrp_trajectory* said) {
    if (said->robot != 0) return;
    static_cast<ArenaNotes*>(self->context)
        ->trajectories.push_back({said->role, said->step_ns, {said->poses, said->poses + said->count}});
  };
  extension_.note = [](const dmrp_annotate* self, const dmrp_note* said) {
    if (said->robot == 0) static_cast<ArenaNotes*>(self->context)->notes.push_back(said->text);
  };
}

}  // namespace dmrp::test
