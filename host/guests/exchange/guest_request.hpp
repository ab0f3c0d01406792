// SPDX-License-Identifier: MIT
// guest_request.hpp: what the judge asks of a guest, and what a guest asks of the judge meanwhile. All pointers lie in the
// guest's arena; outputs in the part of it that the guest can write to.
#pragma once

#include <dmrp/global_planner.h>
#include <dmrp/local_controller.h>
#include <dmrp/pedestrian_model.h>
#include <dmrp/trial_end.h>
#include <dmrp/world.h>

#include <cstdint>

#include "host/world/walking_grids.hpp"

namespace dmrp::host {

// The detail of a fault: an answer that no call of a plugin gives.
inline constexpr const char* wrote_into_shared_memory = "wrote into the memory that it shares with the host";

enum class GuestTask : std::uint32_t {
  load,         // the library: no input
  probe,        // load, init(), deinit() -> text: JSON of a Probe; nothing else can follow
  begin_trial,  // BeginInput; of no instance
  create,       // text: JSON {"plugin", "parameters", "robot"}
  start,        // StartInput
  control_all,  // ControlInput -> ControlAnswer, one each; CallAnswer if one instance drives all
  move_people,  // PeopleInput -> CallAnswer, and dmrp_motion, one each
  plan,         // PlanInput -> text: JSON, and the waypoints
  end_trial,    // dmrp_trial_end
  measure,      // MeasureInput -> text: JSON of a MetricResult
  timing,       // -> text: JSON of the TimingReasons since the trial began; of no instance
  destroy,      // of all instances: no input
  unload,       // the library: no input
};

struct GuestRequest {
  GuestTask task{};
  std::uint32_t instance = 0;
  std::int64_t step = 0;       // physics steps since the trial's start
  std::int64_t budget_ns = 0;  // of each call
  const void* input = nullptr;
  void* output = nullptr;
  std::uint32_t annotated = 0;  // 1: the trace takes annotations
};

struct BeginInput {
  std::uint64_t trial;
  std::int64_t step_ns;
};

// The static geometry of a world, as long as the guest lives, and walking grids that the judge has made of it.
struct SentScene {
  const dmrp_world* world;
  std::uint32_t grid_count;
  const WalkingGrids::Known* grids;
};

struct StartInput {
  const dmrp_world* world;
  SentScene scene;
  std::uint64_t seed;
  std::uint32_t first_robot;  // those that a controller drives
  std::uint32_t robot_count;
};

// Readings of a robot's sensors that its controller read in its last call: sent with the next observation, they cost no
// question.
struct SentReadings {
  static constexpr std::uint32_t kinds = 5;
  const void* of[kinds];  // by GuestQuestion::Kind; nullptr: ask for it
};

struct CallAnswer {
  std::int32_t status;
  std::int64_t duration_ns;
};
struct ControlAnswer {
  CallAnswer call;
  dmrp_command command;
  std::uint32_t read;  // bits 1u << GuestQuestion::Kind
};

// One robot at a control tick.
struct ControlItem {
  std::uint32_t instance;          // that drives it
  const dmrp_path_update* update;  // nullptr: it keeps its path
  SentReadings readings;
};
struct ControlInput {
  std::uint32_t count;
  const ControlItem* items;
  const dmrp_observation* observations;  // parallel to items
  ControlAnswer* answers;                // output, parallel to items
};

struct PeopleInput {
  dmrp_crowd crowd;
  dmrp_motion* motions;  // output
};

// The paths come one after the other, each with as many waypoints as the answer's text says.
struct PlanInput {
  const dmrp_planning_problem* problem;
  dmrp_waypoint* waypoints;  // output
  std::uint64_t room;        // for waypoints
};

struct MeasureInput {
  SentScene scene;            // without a world: that of the trace
  const std::uint8_t* trace;  // all records; nullptr: they are in the guest's spool
  std::uint64_t trace_bytes;
  std::uint64_t seed;
  std::uint32_t index;  // goes into the result
};

// A controller asks for a reading of a robot that it drives.
struct GuestQuestion {
  enum Kind : std::uint32_t { subscribe_to_costmap, scan, costmap, distance_field, clusters } kind;
  std::uint32_t instance;
  std::uint32_t robot;
};

}  // namespace dmrp::host
