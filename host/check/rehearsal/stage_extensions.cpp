// SPDX-License-Identifier: MIT
#include "host/check/rehearsal/stage_extensions.hpp"

#include <algorithm>

namespace dmrp::host {

namespace {

std::vector<std::shared_ptr<RobotSensors>> sensors_of(Stage& stage, core::Lidar& lidar, std::uint32_t robots) {
  std::vector<std::shared_ptr<RobotSensors>> sensors;
  for (std::uint32_t i = 0; i < robots; ++i)
    sensors.push_back(std::make_shared<RobotSensors>(stage.world, i, lidar, 1));
  return sensors;
}

bool requires_extension(const PluginInfo& info, std::string_view id) {
  return std::find(info.needs.begin(), info.needs.end(), id) != info.needs.end();
}

}  // namespace

StageExtensions::StageExtensions(Instance& instance, const PluginInfo& info, Stage& stage, std::uint32_t robots)
    : info_(info),
      stage_(stage),
      annotations_(annotated_, 0),
      lidar_(stage.variant.types.standard().lidar, stage.variant.geometry),
      sensors_(sensors_of(stage, lidar_, robots)),
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
               ? stage_.variant.walking_grids->extension()
               : nullptr;
  return info_.kind == DMRP_KIND_LOCAL_CONTROLLER ? sensor_readings_.extension(id) : nullptr;
}

}  // namespace dmrp::host
