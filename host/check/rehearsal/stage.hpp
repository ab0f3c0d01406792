// SPDX-License-Identifier: MIT
// stage.hpp: a small world in which a case tries a plugin: a hall with two shelves, robots that cross it from left to
// right, people who walk both ways.
#pragma once

#include <cstdint>

#include "core/world/world.hpp"
#include "host/experiment/experiment.hpp"
#include "host/plans/planning.hpp"
#include "host/plugins/plugin_info.hpp"
#include "host/world/variant_world.hpp"

namespace dmrp::host {

struct StageSettings {
  std::uint32_t robots = 3;
  std::uint32_t people = 8;
  std::uint32_t driven = 0;  // the robot that a controller's instance drives
  double corner_m = 0.0;     // both coordinates of the hall's lower left corner
  bool is_large = false;     // 60 x 50 m instead of 16 x 12 m
  bool goals_have_headings = false;
  bool starts_at_goal = false;              // the first robot; its path is one waypoint
  bool touching = false;                    // robots start 1 cm apart
  bool unknown_kinds = false;               // constants that no header has, where readers skip what they do not know
  bool by_waypoint = false;                 // controllers get one waypoint at a time
  bool walled_off = false;                  // a wall between the robots and their goals; nobody walks
  bool offers_extensions = true;            // those that plugins use; required ones are there anyway
  bool fails_to_plan = false;               // metrics: a trial without a plan
  std::uint32_t grown_bytes = 0;            // by which structs and array elements are longer than this host's
  std::uint32_t grown_extension_bytes = 0;  // and extensions, with what they return
  std::uint32_t ticks = 25;                 // control ticks of a trial
};

class Stage {
 public:
  // The robots have a drive that the plugin, if it is a controller, can drive.
  Stage(const PluginInfo& info, const StageSettings& settings, std::uint64_t seed);
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  // A plan that drives all robots straight to their goals, a waypoint in each cell.
  Plan straight_plan() const;

  // One physics step in which people go on as they do.
  std::span<const dmrp_contact> step();

  const StageSettings settings;

 private:
  Experiment experiment_;

 public:
  const VariantWorld variant;
  core::World world;
};

// Wall time for a call: much, so that only should_stop() of a case ends a call early.
inline constexpr std::int64_t stage_budget_ns = 600'000'000'000;

}  // namespace dmrp::host
