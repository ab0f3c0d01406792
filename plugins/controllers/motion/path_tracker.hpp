// SPDX-License-Identifier: MIT
// path_tracker.hpp: where a robot is on its timed path, and how far along it may go.
#ifndef DMRP_CONTROLLERS_MOTION_PATH_TRACKER_HPP
#define DMRP_CONTROLLERS_MOTION_PATH_TRACKER_HPP

#include <cstddef>
#include <cstdint>
#include <dmrp/cpp/local_controller.hpp>
#include <vector>

namespace dmrp::controllers {

// Where the robot has to come to rest for now.
struct StopPoint {
  Vec2 position = {0.0, 0.0};
  double heading = 0.0;      // NaN: any
  double tolerance_m = 0.2;  // the robot counts as there within this
  double tolerance_rad = 0.0;
  bool is_goal = false;  // false: the last released waypoint, to be passed later
};

// Follows the robot along the path. The place on the path moves forward only, and never jumps to a later part of the
// path that merely comes near (an out-and-back, a hairpin): between the old place and the new one, no waypoint may be
// much farther from the robot than both.
class PathTracker {
 public:
  // Copies the path; the place starts anew.
  void set_path(Path path);
  void clear();

  // Once a control period, before the questions below.
  void update(const Observation& now);

  bool empty() const { return points_.empty(); }

  // Arc lengths in metres from the first waypoint: of the place reached, and of where the robot must stop.
  double progress_m() const { return progress_m_; }
  double end_m() const { return end_m_; }
  double remaining_m() const { return end_m_ - progress_m_; }
  const StopPoint& stop() const { return stop_; }

  Vec2 point_at(double arc_m) const;
  double heading_at(double arc_m, double fallback) const;

  // The first point ahead on the path that is `distance_m` from `from` as the crow flies; the end where all are nearer.
  Vec2 point_at_distance(Vec2 from, double distance_m) const;

 private:
  void lead_in(const Observation& now);
  void find_end(const Observation& now);
  void advance(Vec2 robot);

  std::vector<Vec2> points_;
  std::vector<std::uint32_t> goal_of_point_;
  std::vector<double> arcs_;
  bool fresh_ = false;   // no update since set_path()
  bool led_in_ = false;  // the robot's own position was put before a path of one waypoint
  double progress_m_ = 0.0;
  double end_m_ = 0.0;
  StopPoint stop_;
};

}  // namespace dmrp::controllers

#endif
