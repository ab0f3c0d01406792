// SPDX-License-Identifier: MIT
// arena.hpp: a small world in which controllers drive robots in closed loop through the C ABI.
//
// A robot with acceleration limits at 50 Hz, control at 10 Hz, progress and arrival as in a host, the sensors of
// arena_sensors.hpp. One robot per Trip; several Trips can share a world (drive_together).
#pragma once

#include <dmrp/local_controller.h>
#include <dmrp/world.h>

#include <array>
#include <cstdint>
#include <dmrp/toolkit/rectangle.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/unit/controllers/arena_sensors.hpp"
#include "tests/unit/controllers/robot_body.hpp"
#include "tests/unit/plugin_under_test.hpp"

namespace dmrp::test {

// A disc at the position that `at` returns; it moves through everything.
struct Walker {
  double radius_m = 0.3;
  std::function<dmrp_vec2(double t_s, dmrp_vec2 robot)> at;
  std::uint32_t kind = DMRP_AGENT_PERSON;
  std::function<dmrp_vec2()> velocity = nullptr;  // if empty: from differences of `at`
};

Walker standing(dmrp_vec2 at);
Walker walking(dmrp_vec2 from, dmrp_vec2 to, double speed, double start_s = 0.0);  // then stands

// What drives. No corners: a disc.
struct Body {
  std::uint32_t kinematics = DMRP_KINEMATICS_DIFFERENTIAL;
  dmrp_limits limits = differential_limits(0.0, 0.8, 1.0, 1.0, 1.0);
  std::vector<dmrp_vec2> corners = {};  // of a convex polygon about the origin, counter-clockwise
  double radius_m = 0.25;               // of the disc, or of the circle that contains the polygon
  double inscribed_radius_m = 0.25;
};

// An axis-aligned rectangle about the origin, `behind_m` of it behind.
Body with_rectangle(Body body, double ahead_m, double behind_m, double half_width_m);

struct Course {
  Body body;
  std::vector<Box> boxes;
  std::vector<Walker> walkers;
  std::vector<dmrp_vec2> path;  // the goal is its end
  dmrp_pose start = {0.0, 0.0, 0.0};
  double goal_heading = NAN;
  double goal_tolerance_m = 0.2;
  double time_limit_s = 120.0;
  bool tracking = true;  // walkers whose centres the robot sees within 10 m are agents of the observation
  Sight sight = Sight::everywhere;
  bool costmap = true;    // false: no lidar, costmap, field or clusters
  bool annotate = false;  // true: Trip::notes() keeps the annotations
  // Called before each control period: may add boxes or walkers, change the path (and then raise `revision`), set
  // `released`.
  std::function<void(Course&, double t_s, const dmrp_pose&)> change;
  std::uint64_t revision = 1;
  std::uint32_t released = UINT32_MAX;  // the waypoint at which the controller's path ends
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

  // Starts again with the same instance.
  void start();
  bool finished() const;
  void control_period();
  const Drive& result() const { return drive_; }
  const ArenaNotes& notes() const { return notes_; }
  const dmrp_pose& pose() const { return pose_; }
  dmrp_vec2 velocity() const;  // world frame; zero once finished

  // The two halves of control_period(), for several robots in one world: the command, then five steps of the physics.
  void decide();
  void drive_on();

 private:
  void draw_path();
  void hand_path();
  void observe();
  void track();
  void command();
  void end_step();
  void judge();
  void demand_ability(std::int32_t status);
  double clearance_from(const toolkit::Rectangle& box) const;
  double static_clearance() const;

  Course original_;
  Course course_;
  ArenaSensors sensors_;
  ArenaNotes notes_;
  std::unique_ptr<PluginUnderTest> plugin_;
  Drive drive_;
  dmrp_world world_{};
  dmrp_robot robot_{};
  dmrp_limits limits_{};
  dmrp_polygon part_{};
  dmrp_footprint footprint_{};
  dmrp_goal goal_{};
  dmrp_grid grid_{};
  dmrp_observation observation_{};
  dmrp_command command_{};
  std::vector<dmrp_waypoint> waypoints_;
  std::vector<double> arcs_;
  std::vector<core::Disc> bodies_;
  std::vector<dmrp_agent> agents_;
  std::uint64_t drawn_revision_ = 0;  // of the course
  std::uint32_t handed_ = 0;          // waypoints that the controller has; 0: none of this revision
  std::uint64_t update_ = 0;
  std::int64_t t_ns_ = 0;
  dmrp_pose pose_{};
  dmrp_twist velocity_{};
  double steering_rad_ = 0.0;
  std::int64_t settled_ns_ = 0;
  double no_solution_s_ = 0.0;
};

// Drives until the goal or the course's time limit.
Drive run(const std::string& controller, const Course& course, const ParamOverrides& overrides = {});

// Drives the robots of one world, each with an instance of its own and the others among its walkers, until each has
// arrived or reached its time limit.
std::vector<Drive> drive_together(const std::string& controller, std::vector<Course> courses,
                                  const ParamOverrides& overrides = {});

// The same for two.
std::array<Drive, 2> drive_two(const std::string& controller, Course one, Course other,
                               const ParamOverrides& overrides = {});

// Waypoints one metre apart along the corners, all but the first corner's own kept.
std::vector<dmrp_vec2> metre_path(const std::vector<dmrp_vec2>& corners);

}  // namespace dmrp::test
