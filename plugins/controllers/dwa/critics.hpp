// SPDX-License-Identifier: MIT
// critics.hpp: the cost of an arc, and the search for the arc of lowest cost.
#pragma once

#include <dmrp/cpp/local_controller.hpp>
#include <optional>

#include "controllers/dwa/velocity_window.hpp"
#include "controllers/dwa/wave_front.hpp"
#include "controllers/motion/footprint_check.hpp"

namespace dmrp::controllers::dwa {

// Prevents a robot from moving back and forth on the spot.
//
// After the robot has reversed its driving direction, or its turning or sideways direction while it hardly drives
// ahead, only the new direction is allowed until it has moved by `reset_distance_m` or turned by `reset_angle_rad` since
// the reversal. allows() changes nothing: the state is the history of the robot's commands, not of the samples tried.
class OscillationGuard {
 public:
  void reset() { *this = OscillationGuard(); }

  bool allows(const Sample& sample) const {
    return (only_drive_ == 0 || sample.v * only_drive_ >= 0.0) &&
           (only_turn_ == 0 || sample.omega * only_turn_ >= 0.0) &&
           (only_strafe_ == 0 || sample.v_y * only_strafe_ >= 0.0);
  }

  // Both once per control period: release() with the current pose, then record() with the command.
  void release(const Pose& now, double reset_distance_m, double reset_angle_rad);
  void record(const Pose& now, const Sample& command);

 private:
  int drive_ = 0;  // the last commanded direction: 1, -1, or 0 if there is none
  int turn_ = 0;
  int strafe_ = 0;
  int only_drive_ = 0;  // the only direction allowed; 0: both
  int only_turn_ = 0;
  int only_strafe_ = 0;
  Pose since_ = {0.0, 0.0, 0.0};
};

// The robot's current velocity and its acceleration limits. Samples that the robot cannot reach within one control
// period (use_dwa off) begin with an acceleration phase.
struct Ramp {
  Sample now;
  double a_max = 0.0;      // m/s^2
  double alpha_max = 0.0;  // rad/s^2
};

// Names and defaults as upstream; dwa.hpp documents them.
struct Tuning {
  double sim_time = 1.7;
  double sim_granularity = 0.025;
  double angular_sim_granularity = 0.1;
  double path_distance_bias = 0.6;
  double goal_distance_bias = 0.8;
  double occdist_scale = 0.01;
  double twirling_scale = 0.0;
  double forward_point_distance = 0.325;
  double scaling_speed = 0.25;
  double max_scaling_factor = 0.2;
};

// The input of the critics in one control period. Does not own what it refers to.
struct Scene {
  Pose pose;
  double v_max = 0.0;
  const CostmapView& map;
  const Terrain& terrain;
  const WaveFront& path;        // from the path in the window
  const WaveFront& goal;        // from the local goal
  const WaveFront& goal_front;  // from a point in front of the local goal ...
  double front_length_m = 0.0;  // ... at this distance: the nose's length, or less if that is not free
  bool follow = true;           // whether to apply the path critics
  bool align = true;            // whether to apply the alignment critic
  const OscillationGuard& oscillation;
  const Ramp* ramp = nullptr;  // NULL: velocities are constant along arcs
  // Not NULL: the robot leaves an obstacle, and arcs that end too close to one by this check cost stay_cost.
  const FootprintCheck* room = nullptr;
};

// The same scene with another heading of the robot and another oscillation history.
Scene with_heading(const Scene& scene, double heading, const OscillationGuard& oscillation);

inline constexpr double rejected = -1.0;

// More than the critics of any two arcs can differ by.
inline constexpr double stay_cost = 1e4;

// A robot that moves away from an obstacle which came too close may be this far from the free cells.
inline constexpr std::int32_t escape_reach_cells = 8;

// Equal steps along the arc of a sample.
class Rollout {
 public:
  Rollout(const Sample& sample, const Scene& scene, double duration_s, int steps)
      : ramp_(scene.ramp),
        sample_(sample),
        now_(scene.ramp ? scene.ramp->now : sample),
        dt_s_(duration_s / steps),
        constant_(sample.v, sample.v_y, sample.omega, dt_s_) {}

  void step(DirectedPoint& at) {
    if (!ramp_) return constant_.step(at);
    const Vec2 v = toward(Vec2{now_.v, now_.v_y}, Vec2{sample_.v, sample_.v_y}, ramp_->a_max * dt_s_);
    now_.v = v.x;
    now_.v_y = v.y;
    now_.omega = toward(now_.omega, sample_.omega, ramp_->alpha_max * dt_s_);
    ArcStepper(now_.v, now_.v_y, now_.omega, dt_s_).step(at);
  }

 private:
  const Ramp* ramp_;
  Sample sample_;
  Sample now_;
  double dt_s_;
  ArcStepper constant_;
};

// The number of poses checked along an arc.
int simulation_steps(const Sample& sample, const Tuning& tuning);

// The sum of all critics, or `rejected`. Once the partial sum exceeds `best`, returns the partial sum.
double score(const Sample& sample, const Scene& scene, const Tuning& tuning, FootprintCheck& footprint, double best);

// The sample of lowest cost, the first of several; nothing if all are rejected.
std::optional<Sample> cheapest(const VelocityWindow& window, const Scene& scene, const Tuning& tuning,
                               FootprintCheck& footprint);

}  // namespace dmrp::controllers::dwa
