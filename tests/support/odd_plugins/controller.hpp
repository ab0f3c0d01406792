// SPDX-License-Identifier: MIT
// controller.hpp: drives ahead to the goal, which lies at the same y: one robot by step(), all robots by step_all().
#pragma once

#include <dmrp/ext/annotate.h>
#include <dmrp/ext/lidar.h>
#include <dmrp/local_controller.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/support/odd_plugins/grown.hpp"
#include "tests/support/odd_plugins/instance.hpp"

namespace dmrp::test {

inline std::int32_t set_path(dmrp_instance* self, const dmrp_path_update*) {
  return self->status_of("set_path");
}

inline void drive(const dmrp_observation& now, dmrp_command& command) {
  command.v_x = std::min(0.6, now.goal->pose.x - now.pose.x);
}

// A trajectory and a note of a header that the host may not know.
inline void annotate(const dmrp_instance& self, const dmrp_observation& now) {
  const auto* extension = static_cast<const dmrp_annotate*>(self.extension(DMRP_EXT_ANNOTATE));
  if (!extension->wanted(extension)) return;
  const dmrp_pose poses[] = {now.pose, {now.pose.x + 1.0, now.pose.y, 0.0}};
  const Grown<dmrp_trajectory> trajectory({0, DMRP_ANNOTATE_PREDICTED, now.robot, 2, poses, 100'000'000},
                                          self.extra("trajectory"));
  extension->trajectory(extension, trajectory.get());
  const Grown<dmrp_note> note({0, now.robot, "as planned"}, self.extra("note"));
  extension->note(extension, note.get());
}

inline std::int32_t step(dmrp_instance* self, const dmrp_observation* now, dmrp_command* command) {
  annotate(*self, *now);
  drive(*now, *command);
  if (self->is("overrun step")) std::memset(command, 0, command->struct_size + 8);
  return self->status_of("step");
}

// What is wrong with the fleet that the host shows; "" if nothing is.
inline std::string mistake_in(const dmrp_instance& self, const dmrp_fleet& fleet) {
  if (self.robot != DMRP_NO_ROBOT) return "a central controller has no robot of its own";
  const auto* lidar = static_cast<const dmrp_lidar*>(self.extension(DMRP_EXT_LIDAR));
  if (!lidar || lidar->scan(lidar, self.world->robot_count)) return "a scan of a robot that does not exist";
  for (std::uint32_t i = 0; i < fleet.count; ++i) {
    const auto& now = *DMRP_AT(dmrp_observation, fleet.observations, fleet.observation_stride, i);
    const auto& command = *DMRP_AT_OUT(dmrp_command, fleet.commands, fleet.command_stride, i);
    if (i > 0 && now.robot <= DMRP_AT(dmrp_observation, fleet.observations, fleet.observation_stride, i - 1)->robot)
      return "robots out of order";
    if (command.struct_size < sizeof(command) || command.status != DMRP_OK || command.v_x != 0.0)
      return "a command that is not as new";
    const dmrp_scan* const scan = lidar->scan(lidar, now.robot);
    if (!scan || scan->t_ns != now.t_ns) return "no scan of now";
  }
  return "";
}

inline std::int32_t step_all(dmrp_instance* self, const dmrp_fleet* fleet) {
  if (const std::string mistake = mistake_in(*self, *fleet); !mistake.empty()) return self->error(mistake);
  std::string robots;
  for (std::uint32_t i = 0; i < fleet->count; ++i) {
    const auto& now = *DMRP_AT(dmrp_observation, fleet->observations, fleet->observation_stride, i);
    auto& command = *DMRP_AT_OUT(dmrp_command, fleet->commands, fleet->command_stride, i);
    annotate(*self, now);
    drive(now, command);
    robots += std::to_string(now.robot);
    if (self->is("brake " + std::to_string(now.robot))) command.status = DMRP_NO_SOLUTION;
    if (self->is("status " + std::to_string(now.robot))) command.status = 99;
    if (self->is("nan " + std::to_string(now.robot))) command.v_x = NAN;
  }
  self->log("drives " + robots);
  if (self->is("overrun step_all")) std::memset(fleet->commands, 0, (fleet->count + 1) * fleet->command_stride);
  return self->status_of("step_all");
}

inline constexpr dmrp_local_controller controller_table = {sizeof(dmrp_local_controller), 0, &set_path, &step, nullptr};
inline constexpr dmrp_local_controller central_table = {sizeof(dmrp_local_controller), 0, &set_path, nullptr,
                                                        &step_all};

}  // namespace dmrp::test
