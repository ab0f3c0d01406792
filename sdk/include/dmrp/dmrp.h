/* SPDX-License-Identifier: MIT */
// dmrp.h: includes the whole C contract.
#ifndef DMRP_DMRP_H
#define DMRP_DMRP_H

#include "entry.h"
#include "ext/annotate.h"
#include "ext/distance_field.h"
#include "ext/lidar.h"
#include "ext/local_costmap.h"
#include "ext/obstacle_clusters.h"
#include "global_planner.h"
#include "local_controller.h"
#include "metric.h"
#include "pedestrian_model.h"
#include "person.h"

#endif
