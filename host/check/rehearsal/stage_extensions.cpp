// SPDX-License-Identifier: MIT
#include "host/check/rehearsal/stage_extensions.hpp"

#include <dmrp/ext/annotate.h>
#include <dmrp/ext/distance_field.h>
#include <dmrp/ext/lidar.h>
#include <dmrp/ext/local_costmap.h>
#include <dmrp/ext/walking_grid.h>

#include <algorithm>

namespace dmrp::host {

namespace {

std::vector<std::shared_ptr<RobotSensors>> sensors_of(core::Sight& sight, core::Lidar& lidar, std::uint32_t robots) {
  std::vector<std::shared_ptr<RobotSensors>> sensors;
  for (std::uint32_t i = 0; i < robots; ++i) sensors.push_back(std::make_shared<RobotSensors>(sight, i, lidar, 1));
  return sensors;
}

bool requires_extension(const PluginInfo& info, std::string_view id) {
  return std::find(info.needs.begin(), info.needs.end(), id) != info.needs.end();
}

}  // namespace

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

StageExtensions::StageExtensions(Instance& instance, const PluginInfo& info, Stage& stage, std::uint32_t robots)
    : guard_(instance.guard()),
      info_(info),
      stage_(stage),
      annotations_(annotated_, 0),
      sight_(stage.world),
      lidar_(stage.variant.types.standard().lidar, stage.variant.geometry),
      sensors_(sensors_of(sight_, lidar_, robots)),
      sensor_readings_(readings_of(sensors_)),
      grown_(stage.settings.grown_extension_bytes) {
  instance.offer([this](std::string_view id) { return find(id); });
}

const void* StageExtensions::find(std::string_view id) {
  if (!requires_extension(info_, id) && !stage_.settings.offers_extensions) return nullptr;
  return stage_.settings.grown_extension_bytes > 0 ? grown_.grown(id, own(id)) : own(id);
}

const void* StageExtensions::own(std::string_view id) {
  if (id == DMRP_EXT_ANNOTATE) return info_.kind == DMRP_KIND_METRIC ? nullptr : annotations_.extension();
  if (id == DMRP_EXT_WALKING_GRID)
    return info_.kind == DMRP_KIND_PEDESTRIAN_MODEL || info_.kind == DMRP_KIND_METRIC
               ? stage_.variant.walking_grids->extension(&guard_)
               : nullptr;
  return info_.kind == DMRP_KIND_LOCAL_CONTROLLER ? sensor_readings_.extension(id) : nullptr;
}

}  // namespace dmrp::host
