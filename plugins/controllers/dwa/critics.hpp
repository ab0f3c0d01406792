// SPDX-License-Identifier: MIT
// critics.hpp: what an arc costs, and the search for the cheapest one.
#ifndef DMRP_CONTROLLERS_DWA_CRITICS_HPP
#define DMRP_CONTROLLERS_DWA_CRITICS_HPP

#include <optional>
#include <vector>

#include "controllers/dwa/oscillation.hpp"
#include "controllers/dwa/velocity_window.hpp"
#include "controllers/dwa/wave_front.hpp"
#include "controllers/motion/footprint_check.hpp"

namespace dmrp::controllers::dwa {

// One constant velocity, kept over the time simulated.
struct Sample {
  double v = 0.0;
  double omega = 0.0;
};

// The robot's velocity now and its accelerations: where samples lie beyond one control period (use_dwa off), arcs begin
// with the change to them.
struct Ramp {
  Sample now;
  double a_max = 0.0;      // m/s^2
  double alpha_max = 0.0;  // rad/s^2
};

// Named and defaulted as upstream; dwa.hpp documents them.
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

// What the critics of one control period look at. The referenced objects outlive it.
struct Scene {
  Pose pose;
  double v_max = 0.0;
  const CostmapView& map;
  const Terrain& terrain;
  const WaveFront& path;        // from the path in the window
  const WaveFront& goal;        // from the last point of it
  const WaveFront& goal_front;  // from a point in front of that ...
  double front_length_m = 0.0;  // ... by this: the nose's length, or less where that is not free
  bool follow = true;           // whether the path critics count
  bool align = true;            // whether the nose shall be on the path
  const OscillationGuard& oscillation;
  const Ramp* ramp = nullptr;  // NULL: velocities are constant along arcs
};

// The same scene with the robot turned to another heading, and another memory of turning back and forth.
Scene seen_along(const Scene& scene, double heading, const OscillationGuard& oscillation);

inline constexpr double rejected = -1.0;

// How far from the free cells a robot may be that gets away from something that came too near.
inline constexpr std::int32_t escape_reach_cells = 8;

// Equal steps along the arc of a sample.
class Rollout {
 public:
  Rollout(const Sample& sample, const Scene& scene, double duration_s, int steps)
      : ramp_(scene.ramp),
        sample_(sample),
        now_(scene.ramp ? scene.ramp->now : sample),
        dt_s_(duration_s / steps),
        constant_(sample.v, sample.omega, dt_s_) {}

  void step(ArcState& at) {
    if (!ramp_) return constant_.step(at);
    now_.v = toward(now_.v, sample_.v, ramp_->a_max * dt_s_);
    now_.omega = toward(now_.omega, sample_.omega, ramp_->alpha_max * dt_s_);
    ArcStepper(now_.v, now_.omega, dt_s_).step(at);
  }

 private:
  const Ramp* ramp_;
  Sample sample_;
  Sample now_;
  double dt_s_;
  ArcStepper constant_;
};

// The steps in which an arc is checked.
int simulation_steps(const Sample& sample, const Tuning& tuning);

// The sum of all critics, or `rejected`. Gives up, with a sum so far, once that is above `best`.
double score(const Sample& sample, const Scene& scene, const Tuning& tuning, FootprintCheck& footprint, double best);

// The cheapest sample of the window, the first of several; nothing where all are rejected.
std::optional<Sample> cheapest(const VelocityWindow& window, const Scene& scene, const Tuning& tuning,
                               FootprintCheck& footprint);

}  // namespace dmrp::controllers::dwa

#endif
