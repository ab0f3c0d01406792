// SPDX-License-Identifier: MIT
// stop_and_wait.hpp: straight along the path, and brakes for anything ahead: the lower bound of local controllers.
//
// The robot drives the straight legs of its path, turns in place where they meet, never leaves them, and waits before
// whatever stands on the leg ahead until that has left. It predicts nothing. Up to another robot it creeps nearer, so that
// robots which change places in a cycle can all begin.
#pragma once

#include <vector>

#include "controllers/motion/footprint_check.hpp"
#include "controllers/motion/path_controller.hpp"

namespace dmrp::controllers {

class StopAndWait final : public PathController {
 public:
  static Descriptor describe();

  Param<double> stop_distance =
      param("stop_distance", 0.3).unit("m").range(0.0, 5.0).doc("kept free before what stands on the path");
  Param<double> footprint_padding =
      param("footprint_padding", 0.05).unit("m").range(0.0, 0.5).doc("kept free around the footprint");

  Status start(const Start& start) override;
  void set_path(Path path, std::uint64_t revision) override;

 private:
  Status control(const Observation& now, Command& command) override;
  // The straight piece of the path that the robot drives now.
  struct Leg {
    Vec2 ahead;       // the point on it that the robot steers to
    double end_m;     // arc length of its end
    double length_m;  // from the robot to its end
  };

  // How far the robot can go on its leg before its footprint meets something, and where its centre is then.
  struct Way {
    double free_m;
    Vec2 end;
  };

  Leg current_leg();
  Command drive(const Observation& now, const Leg& leg, const FootprintCheck& check) const;
  Way look_ahead(const Observation& now, const Leg& leg, const FootprintCheck& check, double needed_m) const;

  const dmrp_local_costmap* costmap_ = nullptr;
  std::vector<double> corners_m_;  // arc lengths at which the path turns
  std::size_t next_corner_ = 0;
  bool turning_ = false;
};

}  // namespace dmrp::controllers
