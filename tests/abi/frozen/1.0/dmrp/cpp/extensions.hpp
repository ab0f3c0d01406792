// SPDX-License-Identifier: MIT
// cpp/extensions.hpp: the id of each extension struct, for Plugin::extension<T>(). For an extension of your own:
//
//   template <>
//   struct dmrp::ExtensionId<my_extension> { static constexpr const char* value = "..."; };
#pragma once

#include "../ext/annotate.h"
#include "../ext/distance_field.h"
#include "../ext/lidar.h"
#include "../ext/local_costmap.h"
#include "../ext/obstacle_clusters.h"
#include "../ext/timing.h"
#include "../ext/walking_grid.h"

namespace dmrp {

template <class Extension>
struct ExtensionId {
  static_assert(sizeof(Extension) == 0, "this extension has no id: specialise dmrp::ExtensionId for it");
  DMRP_LOCAL static constexpr const char* value = "";
};

template <>
struct ExtensionId<dmrp_annotate> {
  DMRP_LOCAL static constexpr const char* value = DMRP_EXT_ANNOTATE;
};
template <>
struct ExtensionId<dmrp_distance_field> {
  DMRP_LOCAL static constexpr const char* value = DMRP_EXT_DISTANCE_FIELD;
};
template <>
struct ExtensionId<dmrp_lidar> {
  DMRP_LOCAL static constexpr const char* value = DMRP_EXT_LIDAR;
};
template <>
struct ExtensionId<dmrp_local_costmap> {
  DMRP_LOCAL static constexpr const char* value = DMRP_EXT_LOCAL_COSTMAP;
};
template <>
struct ExtensionId<dmrp_obstacle_clusters> {
  DMRP_LOCAL static constexpr const char* value = DMRP_EXT_OBSTACLE_CLUSTERS;
};
template <>
struct ExtensionId<dmrp_timing> {
  DMRP_LOCAL static constexpr const char* value = DMRP_EXT_TIMING;
};
template <>
struct ExtensionId<dmrp_walking_grid> {
  DMRP_LOCAL static constexpr const char* value = DMRP_EXT_WALKING_GRID;
};

}  // namespace dmrp
