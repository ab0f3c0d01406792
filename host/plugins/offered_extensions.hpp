// SPDX-License-Identifier: MIT
// offered_extensions.hpp: the extensions that this host offers to each kind of plugin.
#pragma once

#include <dmrp/descriptor.h>
#include <dmrp/ext/annotate.h>
#include <dmrp/ext/distance_field.h>
#include <dmrp/ext/lidar.h>
#include <dmrp/ext/local_costmap.h>
#include <dmrp/ext/obstacle_clusters.h>

#include <cstdint>
#include <string>
#include <vector>

namespace dmrp::host {

// The ids for a DMRP_KIND_*.
inline std::vector<std::string> offered_extensions(std::uint32_t kind) {
  if (kind == DMRP_KIND_METRIC) return {};
  std::vector<std::string> ids = {DMRP_EXT_ANNOTATE};
  if (kind == DMRP_KIND_LOCAL_CONTROLLER)
    ids.insert(ids.end(),
               {DMRP_EXT_LIDAR, DMRP_EXT_LOCAL_COSTMAP, DMRP_EXT_DISTANCE_FIELD, DMRP_EXT_OBSTACLE_CLUSTERS});
  return ids;
}

}  // namespace dmrp::host
