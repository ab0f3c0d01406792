// SPDX-License-Identifier: MIT
// arena_sensors.hpp: the sensors of a robot in the arena, as the extensions of dmrp-host.
#pragma once

#include <dmrp/ext/annotate.h>
#include <dmrp/ext/distance_field.h>
#include <dmrp/ext/lidar.h>
#include <dmrp/ext/local_costmap.h>
#include <dmrp/ext/obstacle_clusters.h>

#include <cstdint>
#include <dmrp/toolkit/distance_transform.hpp>
#include <memory>
#include <string>
#include <vector>

#include "core/sensors/costmap.hpp"
#include "core/sensors/lidar.hpp"
#include "core/sensors/obstacle_clusters.hpp"
#include "tests/unit/plugin_under_test.hpp"

namespace dmrp::test {

struct Box {
  dmrp_vec2 lower;
  dmrp_vec2 upper;
};

enum class Sight {
  everywhere,  // the costmap contains the complete surface of all bodies in its window
  scan,        // the costmap is built by marking and clearing, from the lidar
};

// Offers lidar, costmap, distance field and obstacle clusters.
class ArenaSensors {
 public:
  ArenaSensors(Sight sight, double inscribed_radius_m);
  ArenaSensors(const ArenaSensors&) = delete;
  ArenaSensors& operator=(const ArenaSensors&) = delete;

  void offer(FakeHost& host) const;

  // Resets all state at the start of a trial.
  void reset();

  // Sets the static obstacles. Before look() and sees().
  void set_boxes(const std::vector<Box>& boxes);

  // Once per control period. `agents`: those of the observation; the clusters omit them.
  void look(const dmrp_pose& pose, std::int64_t t_ns, const std::vector<core::Disc>& bodies,
            const std::vector<dmrp_agent>& agents);

  // Whether no box is in between.
  bool sees(dmrp_vec2 from, dmrp_vec2 to) const { return geometry_->line_of_sight(from, to); }

 private:
  template <class Extension>
  static const ArenaSensors& of(const Extension* extension) {
    return *static_cast<const ArenaSensors*>(extension->context);
  }
  // The robot's data: there is one robot.
  template <class Data>
  static const Data* given(std::uint32_t robot, const Data& data) {
    return robot == 0 ? &data : nullptr;
  }
  void see_everywhere(const dmrp_pose& pose, std::int64_t t_ns, const std::vector<core::Disc>& bodies);

  Sight sight_;
  double inscribed_radius_m_;
  std::vector<Box> boxes_;
  std::shared_ptr<const core::StaticGeometry> geometry_;
  std::unique_ptr<core::Lidar> lidar_;
  std::vector<float> ranges_;
  core::LocalCostmap rolling_;  // under Sight::scan
  std::vector<std::uint8_t> costs_;
  std::vector<std::uint8_t> lethal_;
  toolkit::DistanceTransform transform_;
  core::ObstacleClusters cluster_finder_;

  dmrp_scan scan_{};
  dmrp_costmap costmap_{};
  dmrp_field field_{};
  dmrp_obstacle_cluster_list clusters_{};
  dmrp_lidar lidar_extension_{};
  dmrp_local_costmap costmap_extension_{};
  dmrp_distance_field field_extension_{};
  dmrp_obstacle_clusters clusters_extension_{};
};

// Records the annotations of a plugin (dmrp.annotate/1).
class ArenaNotes {
 public:
  struct Trajectory {
    std::uint32_t role;  // DMRP_ANNOTATE_*
    std::int64_t step_ns;
    std::vector<dmrp_pose> poses;
  };

  ArenaNotes();
  ArenaNotes(const ArenaNotes&) = delete;
  ArenaNotes& operator=(const ArenaNotes&) = delete;

  void offer(FakeHost& host) const { host.extensions[DMRP_EXT_ANNOTATE] = &extension_; }

  // Since the start.
  std::vector<Trajectory> trajectories;
  std::vector<std::string> notes;

 private:
  dmrp_annotate extension_{};
};

}  // namespace dmrp::test
