/* SPDX-License-Identifier: MIT */
// dmrp.h: includes the whole C contract.
//
// What it leaves for later: messages between robots come as an extension (until then a central controller, or an
// extension of a plugin's own), velocities at waypoints as appended fields (path.h), a third dimension with v2.
#ifndef DMRP_DMRP_H
#define DMRP_DMRP_H

#include "entry.h"
#include "ext/annotate.h"
#include "ext/distance_field.h"
#include "ext/lidar.h"
#include "ext/local_costmap.h"
#include "ext/obstacle_clusters.h"
#include "ext/timing.h"
#include "ext/walking_grid.h"
#include "global_planner.h"
#include "local_controller.h"
#include "metric.h"
#include "pedestrian_model.h"

#endif
