// SPDX-License-Identifier: MIT
// stage.hpp: a small world in which a case tries a plugin: a hall with two shelves, robots that cross it from left to
// right, people who walk both ways.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/world/world.hpp"
#include "host/experiment/experiment.hpp"
#include "host/plans/planning.hpp"
#include "host/plugins/plugin_info.hpp"
#include "host/world/variant_world.hpp"

namespace dmrp::host {

// The groups of people, as a pedestrian model sees them.
enum class Groups { as_drawn, none, one_each };

struct StageSettings {
  std::uint32_t robots = 3;
  std::uint32_t people = 8;
  std::uint32_t driven = 0;         // the robot that a controller's instance drives
  std::uint32_t kinematics = 0;     // of the robots; 0: the first that a controller drives
  double corner_m = 0.0;            // both coordinates of the hall's lower left corner
  std::uint32_t quarter_turns = 0;  // of the hall, to the left
  bool is_large = false;            // 60 x 50 m instead of 16 x 12 m
  std::uint32_t ticks = 25;         // control ticks of a trial
  std::uint32_t first_goal = 0;     // the index of the goal that robots head for
  bool goals_have_headings = false;
  bool starts_at_goal = false;                         // the first robot; its path is one waypoint
  bool touching = false;                               // robots start 1 cm apart
  bool is_fast = false;                                // robots and people move several times as fast as they may
  bool at_one_place = false;                           // two people
  bool is_pressed = false;                             // people: all within a metre, at every call
  std::uint32_t reaction = DMRP_REACTION_UNSPECIFIED;  // of every other person
  Groups groups = Groups::as_drawn;
  bool unknown_kinds = false;               // constants that no header has, where readers skip what they do not know
  bool by_waypoint = false;                 // controllers get one waypoint at a time
  bool walled_off = false;                  // a wall between the robots and their goals; nobody walks
  bool offers_extensions = true;            // those that plugins use; required ones are there anyway
  bool fails_to_plan = false;               // metrics: a trial without a plan
  bool shows_all = false;                   // metrics: also what they do not declare
  std::uint32_t window_steps = 0;           // planners: of each plan
  bool one_fails = false;                   // planners: a robot, before the last plan
  bool goals_grow = false;                  // planners: the first robot gets a second goal
  std::uint32_t grown_bytes = 0;            // by which structs and array elements are longer than this host's
  std::uint32_t grown_extension_bytes = 0;  // and extensions, with what they return
};

class Stage {
 public:
  // The robots have a drive that the plugin, if it is a controller, can drive.
  Stage(const PluginInfo& info, const StageSettings& settings, std::uint64_t seed);
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  // A plan that drives all robots straight to their goals, a waypoint in each cell.
  Plan straight_plan() const;

  // The people, and agents of the world, as a plugin gets to see them.
  std::vector<dmrp_person> people() const;
  std::vector<dmrp_agent> agents(std::span<const dmrp_agent> agents) const;

  // One physics step in which people go on as they do.
  std::span<const dmrp_contact> step();

  const StageSettings settings;

  // The waypoint of straight_plan() at which the paths of controllers end now; they get them anew whenever it changes.
  std::uint32_t path_end = whole_path;
  static constexpr std::uint32_t whole_path = 0xffffffff;

 private:
  Experiment experiment_;

 public:
  const VariantWorld variant;
  core::World world;
};

inline constexpr std::uint32_t usual_ticks = StageSettings{}.ticks;

// Returns how many calls a trial has: `wanted`, or a part of it for plugins whose calls take long.
std::uint32_t most_ticks(std::uint32_t wanted);
// Shortens all rehearsals of this process in proportion: those of 25 ticks get `most`, from 1 to 25.
void limit_ticks(std::uint32_t most);

// Wall time for a call: much, so that only should_stop() of a case ends a call early.
inline constexpr std::int64_t stage_budget_ns = 600'000'000'000;

}  // namespace dmrp::host
