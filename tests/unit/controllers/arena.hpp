// SPDX-License-Identifier: MIT
// arena.hpp: a small world in which one controller drives one robot, in closed loop through the C ABI.
//
// A unicycle with acceleration limits at 50 Hz, control at 10 Hz, a costmap rasterised from the shapes and people
// themselves (surfaces within range, as if seen from everywhere), progress and arrival as a host judges them.
#pragma once

#include <dmrp/ext/local_costmap.h>
#include <dmrp/local_controller.h>
#include <dmrp/world.h>

#include <cstdint>
#include <dmrp/toolkit/distance_transform.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "../plugin_under_test.hpp"

namespace dmrp::test {

struct Box {
  dmrp_vec2 lower;
  dmrp_vec2 upper;
};

// A disc that is where `at` says; moves through everything.
struct Walker {
  double radius_m = 0.3;
  std::function<dmrp_vec2(double t_s, dmrp_vec2 robot)> at;
};

Walker standing(dmrp_vec2 at);
Walker walking(dmrp_vec2 from, dmrp_vec2 to, double speed, double start_s = 0.0);  // then stands

struct Course {
  std::vector<Box> boxes;
  std::vector<Walker> walkers;
  std::vector<dmrp_vec2> path;  // the goal is its end
  dmrp_pose start = {0.0, 0.0, 0.0};
  double goal_heading = NAN;
  double time_limit_s = 120.0;
  bool costmap = true;
  // Called before each control period: may add boxes or walkers, change the path (and then raise `revision`), set
  // `released`.
  std::function<void(Course&, double t_s, const dmrp_pose&)> change;
  std::uint64_t revision = 1;
  std::uint32_t released = UINT32_MAX;
};

struct Drive {
  bool arrived = false;
  double time_s = 0.0;
  dmrp_pose end = {0.0, 0.0, 0.0};
  double goal_distance_m = 0.0;
  double static_clearance_m = 1e9;      // least, between the outlines; negative: contact
  double walker_clearance_m = 1e9;      // likewise
  double own_walker_clearance_m = 1e9;  // while the robot was moving toward it
  double path_deviation_m = 0.0;        // greatest
  double turned_rad = 0.0;              // sum of all turning
  double longest_no_solution_s = 0.0;
  std::vector<std::string> breaches;  // of limits, finiteness, status
  std::vector<dmrp_pose> poses;       // at control periods
  std::vector<dmrp_command> commands;
};

// One instance on one course, a control period at a time.
class Trip {
 public:
  Trip(const std::string& controller, Course course, ParamOverrides overrides = {});
  ~Trip();
  Trip(const Trip&) = delete;
  Trip& operator=(const Trip&) = delete;

  // Starts over on the same instance.
  void start();
  bool finished() const;
  void control_period();
  const Drive& result() const { return drive_; }

 private:
  void send_path();
  void observe();
  void command();
  void drive_on();
  void judge();
  void build_costmap();
  double static_clearance(dmrp_vec2 at) const;

  Course original_;
  Course course_;
  std::unique_ptr<PluginUnderTest> plugin_;
  Drive drive_;
  dmrp_world world_{};
  dmrp_robot robot_{};
  dmrp_limits limits_{};
  dmrp_footprint footprint_{};
  dmrp_goal goal_{};
  dmrp_grid grid_{};
  dmrp_local_costmap extension_{};
  dmrp_costmap costmap_{};
  dmrp_observation observation_{};
  dmrp_command command_{};
  std::vector<dmrp_waypoint> waypoints_;
  std::vector<double> arcs_;
  std::vector<std::uint8_t> costs_;
  std::vector<std::uint8_t> lethal_;
  toolkit::DistanceTransform transform_;
  std::uint64_t sent_revision_ = 0;
  std::int64_t t_ns_ = 0;
  dmrp_pose pose_{};
  dmrp_twist velocity_{};
  std::int64_t settled_ns_ = 0;
  double no_solution_s_ = 0.0;
};

// Drives until the goal or the course's time limit.
Drive run(const std::string& controller, const Course& course, const ParamOverrides& overrides = {});

// Waypoints a metre apart along the corners, all but the first corner's own kept.
std::vector<dmrp_vec2> metre_path(const std::vector<dmrp_vec2>& corners);

}  // namespace dmrp::test
