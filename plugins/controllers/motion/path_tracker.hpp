// SPDX-License-Identifier: MIT
// path_tracker.hpp: the robot's position on its timed path, and the point where it has to stop.
#pragma once

#include <cstdint>
#include <dmrp/cpp/local_controller.hpp>
#include <vector>

namespace dmrp::controllers {

// Where the robot has to stop next.
struct StopPoint {
  Vec2 position = {0.0, 0.0};
  double heading = 0.0;      // NaN: any
  double tolerance_m = 0.2;  // the robot has arrived within this distance
  double tolerance_rad = 0.0;
  bool is_goal = false;  // false: the end of a partial path, which the robot passes once it is handed more
};

// Tracks the robot's progress along the path. Progress never decreases and never jumps to a later part of the path that
// passes nearby (an out-and-back, a hairpin): no waypoint between the old position and the new one may be much farther
// from the robot than both.
class PathTracker {
 public:
  // Copies the path and resets the progress.
  void set_path(Path path);
  void clear();

  // Once per control period, before the queries below.
  void update(const Observation& now);

  bool empty() const { return points_.empty(); }

  // Arc lengths from the first waypoint: of the position reached, and of the stop point.
  double progress_m() const { return progress_m_; }
  double end_m() const { return end_m_; }
  double remaining_m() const { return end_m_ - progress_m_; }
  const StopPoint& stop() const { return stop_; }

  Vec2 point_at(double arc_m) const;
  double heading_at(double arc_m, double fallback) const;

  // The first point ahead on the path at the straight-line distance `distance_m` from `from`; the end if all are
  // closer.
  Vec2 point_at_distance(Vec2 from, double distance_m) const;

 private:
  void lead_in(const Observation& now);
  void find_end(const Observation& now);
  void advance(Vec2 robot);

  std::vector<Vec2> points_;
  std::vector<double> arcs_;
  bool leads_to_goal_ = false;  // the path is not partial
  bool fresh_ = false;          // no update() since set_path()
  bool led_in_ = false;         // the robot's position was prepended to a path of one waypoint
  double progress_m_ = 0.0;
  double end_m_ = 0.0;
  StopPoint stop_;
};

}  // namespace dmrp::controllers
