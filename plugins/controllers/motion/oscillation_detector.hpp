// SPDX-License-Identifier: MIT
// oscillation_detector.hpp: notices a robot that turns to and fro and gets nowhere, as teb_local_planner's failure
// detector does.
#ifndef DMRP_CONTROLLERS_MOTION_OSCILLATION_DETECTOR_HPP
#define DMRP_CONTROLLERS_MOTION_OSCILLATION_DETECTOR_HPP

#include <dmrp/cpp/local_controller.hpp>
#include <vector>

namespace dmrp::controllers {

// Over the last commands: their mean speed and mean turning rate, each as a share of the limit, are small, and the
// turning rate has changed its sign more than once.
class OscillationDetector {
 public:
  // `length`: how many control periods are looked at; half of them must be there.
  void reset(std::size_t length);

  // Once a control period: what has been commanded.
  void note(const Command& command, const Limits& limits);

  bool is_oscillating(double v_share, double omega_share) const;

 private:
  struct Share {
    double v;
    double omega;
  };
  std::vector<Share> ring_;  // by age modulo its size
  std::size_t noted_ = 0;
};

}  // namespace dmrp::controllers

#endif
