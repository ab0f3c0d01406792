// SPDX-License-Identifier: MIT
#include "host/plugins/offered_extensions.hpp"

#include <dmrp/ext/annotate.h>
#include <dmrp/ext/distance_field.h>
#include <dmrp/ext/lidar.h>
#include <dmrp/ext/local_costmap.h>
#include <dmrp/ext/obstacle_clusters.h>
#include <dmrp/ext/timing.h>
#include <dmrp/ext/walking_grid.h>
#include <fmt/format.h>

#include <algorithm>

#include "host/toml/nearest_name.hpp"

namespace dmrp::host {

std::vector<std::string> offered_extensions(std::uint32_t kind) {
  switch (kind) {
    case DMRP_KIND_LOCAL_CONTROLLER:
      return {DMRP_EXT_ANNOTATE,          DMRP_EXT_LIDAR, DMRP_EXT_LOCAL_COSTMAP, DMRP_EXT_DISTANCE_FIELD,
              DMRP_EXT_OBSTACLE_CLUSTERS, DMRP_EXT_TIMING};
    case DMRP_KIND_PEDESTRIAN_MODEL:
      return {DMRP_EXT_ANNOTATE, DMRP_EXT_WALKING_GRID, DMRP_EXT_TIMING};
    case DMRP_KIND_METRIC:
      return {DMRP_EXT_WALKING_GRID, DMRP_EXT_TIMING};
    default:
      return {DMRP_EXT_ANNOTATE, DMRP_EXT_TIMING};
  }
}

std::string missing_extension(const PluginInfo& info) {
  const std::vector<std::string> offered = offered_extensions(info.kind);
  for (const std::string& id : info.needs)
    if (std::find(offered.begin(), offered.end(), id) == offered.end())
      return fmt::format("needs the extension {}, which this host does not offer to a {} (offered: {}){}", id,
                         kind_name(info.kind), join_names(offered), did_you_mean(id, offered));
  return "";
}

std::vector<std::string> doubtful_extensions(const PluginInfo& info) {
  const std::vector<std::string> offered = offered_extensions(info.kind);
  std::vector<std::string> out;
  for (const std::string& id : info.uses) {
    if (std::find(offered.begin(), offered.end(), id) != offered.end()) continue;
    if (const std::string hint = did_you_mean(id, offered); !hint.empty())
      out.push_back(fmt::format("{} uses the extension '{}', which this host does not offer to a {}{}", info.id, id,
                                kind_name(info.kind), hint));
  }
  return out;
}

}  // namespace dmrp::host
