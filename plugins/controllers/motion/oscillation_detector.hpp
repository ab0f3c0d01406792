// SPDX-License-Identifier: MIT
// oscillation_detector.hpp: detects a robot that turns back and forth without making progress, as teb_local_planner's
// FailureDetector does.
#pragma once

#include <dmrp/cpp/local_controller.hpp>
#include <vector>

namespace dmrp::controllers {

// A robot oscillates if over its last commands the mean speed and the mean turning rate, each relative to its limit,
// are small and the turning rate changed its sign more than once.
class OscillationDetector {
 public:
  // `length`: the number of control periods considered; nothing is detected before half of them are recorded.
  void reset(std::size_t length);

  // Once per control period, with the command given.
  void record(const Command& command, const Limits& limits);

  // The thresholds are fractions of the limits.
  bool is_oscillating(double v_fraction, double omega_fraction) const;

 private:
  struct Fraction {  // of the limits
    double v;
    double omega;
  };
  std::vector<Fraction> ring_;  // command k at index k modulo the size
  std::size_t recorded_ = 0;
};

}  // namespace dmrp::controllers
