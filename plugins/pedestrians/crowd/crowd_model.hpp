// SPDX-License-Identifier: MIT
// The common part of the models: people who find their ways and respond to robots.
#pragma once

#include <dmrp/plugin.hpp>

#include "pedestrians/crowd/walkers.hpp"
#include "pedestrians/crowd/way_finding.hpp"

namespace dmrp::pedestrians {

class CrowdModel : public PedestrianModel {
 protected:
  static Descriptor describe_model(const char* id, const char* name) {
    return Descriptor(id, name, "1.0.0").vendor("dmrp").license("MIT").needs(DMRP_EXT_WALKING_GRID);
  }

  struct RobotResponse {
    Param<double> awareness;
    Param<double> surprised;
    Param<double> curious;
    Param<double> scared;
    Param<double> threatening;
    Param<std::string> reactions;
  };

  RobotResponse robot_response() {
    return {param("robot_awareness", 1.0)
                .range(0.0, 1.0)
                .doc("how much people react to robots: 1 as to people, 0 not at all"),
            share("surprised_share", "share of people who stop and look at a robot when they see it"),
            share("curious_share", "share of people who walk up to a robot when they see it"),
            share("scared_share", "share of people who walk away from a robot when they see it"),
            share("threatening_share", "share of people who get in a robot's way when they see it"),
            param("reactions", "on")
                .choices({"on", "off"})
                .doc("off: as published, without right of way, ways past robots and answers to them")};
  }

  // `cell_m`: of the grid of neighbours.
  void start_people(const Start& start, const RobotResponse& to_robots, double cell_m) {
    ways_.start(walking_grid(extension<dmrp_walking_grid>(), start.world));
    walkers_.grid.start(start.world->lower, start.world->upper, cell_m);
    walkers_.reactions.start(start.seed, ways_.grid(), to_robots.reactions == "on", to_robots.awareness,
                             {to_robots.surprised, to_robots.curious, to_robots.scared, to_robots.threatening});
  }

  // Gathers the walkers, and says it if the people of a flow do not react as the scenario has it: no model can refuse a
  // crowd.
  template <class WayOf>
  void gather(const Crowd& crowd, const WayOf& way_of) {
    const bool is_said = walkers_.reactions.leaves_out_own();
    walkers_.gather(crowd, way_of);
    if (!is_said && walkers_.reactions.leaves_out_own())
      log(LogLevel::warning, "reactions = \"off\" leaves out the reaction of a flow");
  }

  WayFinder ways_;
  Walkers walkers_;

 private:
  ParamBuilder<double> share(const char* key, const char* doc) { return param(key, 0.0).range(0.0, 1.0).doc(doc); }
};

}  // namespace dmrp::pedestrians
