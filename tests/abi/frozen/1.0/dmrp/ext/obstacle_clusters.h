/* SPDX-License-Identifier: MIT */
// ext/obstacle_clusters.h: the obstacles of the local costmap as few convex shapes, for controllers that measure
// distances to obstacles rather than read costs. An extension of the host for local controllers.
#ifndef DMRP_EXT_OBSTACLE_CLUSTERS_H
#define DMRP_EXT_OBSTACLE_CLUSTERS_H

#include "../values.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DMRP_EXT_OBSTACLE_CLUSTERS "dmrp.obstacle_clusters/1"

// A convex shape that covers connected lethal cells. Array element.
typedef struct dmrp_obstacle_cluster {
  uint32_t vertex_count;  // 1: a point; 2: a segment; more: a convex polygon, counter-clockwise
  uint32_t reserved;
  const dmrp_vec2* vertices;  // world frame; centres of lethal cells
} dmrp_obstacle_cluster;

// Every lethal cell's centre lies within tolerance_m of a cluster, and no point of a cluster is farther than
// tolerance_m from the centre of a lethal cell: the corner of a room becomes two segments, never a triangle across it.
// Cells covered by an agent of the observation are excluded: the controller knows agents with their velocity.
typedef struct dmrp_obstacle_cluster_list {
  uint32_t struct_size;
  uint32_t count;
  uint32_t stride;  // of clusters
  uint32_t reserved;
  int64_t t_ns;  // of the scan that they were computed from
  double tolerance_m;
  const dmrp_obstacle_cluster* clusters;
} dmrp_obstacle_cluster_list;

typedef struct dmrp_obstacle_clusters dmrp_obstacle_clusters;
struct dmrp_obstacle_clusters {
  uint32_t struct_size;
  uint32_t reserved;
  void* context;  // the host's own

  // The clusters around a robot, computed on demand, at most once per scan. Valid until the current call of step() or
  // step_all() returns. NULL for a robot that the instance does not drive.
  // [step]
  const dmrp_obstacle_cluster_list* (*clusters)(const dmrp_obstacle_clusters* extension, uint32_t robot);
};

DMRP_ASSERT_SIZE(dmrp_obstacle_cluster, 16);
DMRP_ASSERT_SIZE(dmrp_obstacle_cluster_list, 40);
DMRP_ASSERT_SIZE(dmrp_obstacle_clusters, 24);

#ifdef __cplusplus
}
#endif

#endif
