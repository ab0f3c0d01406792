// SPDX-License-Identifier: MIT
#include "host/check/rehearsal/grown_extensions.hpp"

#include <dmrp/ext/annotate.h>
#include <dmrp/ext/distance_field.h>
#include <dmrp/ext/lidar.h>
#include <dmrp/ext/local_costmap.h>
#include <dmrp/ext/walking_grid.h>

namespace dmrp::host {

template <auto function, class Table, class Result, class Argument>
const void* GrownExtensions::wrapped(const Result* (*Table::*)(const Table*, Argument), const void* extension) {
  Table* const copy = tables_.one(*static_cast<const Table*>(extension));
  copy->context = &origins_.emplace_back(Origin{extension, this});
  copy->*function = [](const Table* self, Argument argument) -> const Result* {
    const Origin& origin = *static_cast<const Origin*>(self->context);
    const auto* const table = static_cast<const Table*>(origin.table);
    const Result* const result = (table->*function)(table, argument);
    return result ? origin.self->longer(*result) : nullptr;
  };
  return copy;
}

const dmrp_obstacle_cluster_list* GrownExtensions::longer(const dmrp_obstacle_cluster_list& list) {
  dmrp_obstacle_cluster_list* const copy = results_.one(list);
  copy->clusters = results_.array(list.clusters, list.count);
  copy->stride = results_.stride<dmrp_obstacle_cluster>();
  return copy;
}

const void* GrownExtensions::grown(std::string_view id, const void* extension) {
  if (!extension) return nullptr;
  if (id == DMRP_EXT_LIDAR) return wrapped<&dmrp_lidar::scan>(&dmrp_lidar::scan, extension);
  if (id == DMRP_EXT_LOCAL_COSTMAP)
    return wrapped<&dmrp_local_costmap::costmap>(&dmrp_local_costmap::costmap, extension);
  if (id == DMRP_EXT_DISTANCE_FIELD)
    return wrapped<&dmrp_distance_field::field>(&dmrp_distance_field::field, extension);
  if (id == DMRP_EXT_OBSTACLE_CLUSTERS)
    return wrapped<&dmrp_obstacle_clusters::clusters>(&dmrp_obstacle_clusters::clusters, extension);
  if (id == DMRP_EXT_WALKING_GRID) return wrapped<&dmrp_walking_grid::grid>(&dmrp_walking_grid::grid, extension);
  if (id == DMRP_EXT_ANNOTATE) return tables_.one(*static_cast<const dmrp_annotate*>(extension));
  return extension;
}

}  // namespace dmrp::host
