// SPDX-License-Identifier: MIT
// teb.hpp: the timed elastic band with homotopy classes, after ROS's teb_local_planner.
#pragma once

#include "controllers/motion/drive_ability.hpp"
#include "controllers/motion/footprint_check.hpp"
#include "controllers/motion/oscillation_detector.hpp"
#include "controllers/motion/path_ahead.hpp"
#include "controllers/motion/path_controller.hpp"
#include "controllers/teb/class_planner.hpp"
#include "controllers/teb/parameters.hpp"

namespace dmrp::controllers {

namespace teb {

// Declares the parameters to the host.
class DeclaredParameters : public PathController {
 protected:
  // The values that the host has set; complete from start() on.
  Parameters parameters() const {
    Parameters values;
#define NUMBER(name, value, unit, minimum, maximum, doc) values.name = name;
#define COUNT(name, value, minimum, maximum, doc) values.name = static_cast<std::size_t>(*name);
#define FLAG(name, value, doc) values.name = name;
#define WEIGHT(name, value, doc) values.name = name;
#include "controllers/teb/parameters.inc"
    return values;
  }

 private:
#define NUMBER(name, value, unit_of, minimum, maximum, doc_of) \
  Param<double> name = param(#name, value).unit(unit_of).range(minimum, maximum).doc(doc_of);
#define COUNT(name, value, minimum, maximum, doc_of) \
  Param<std::int64_t> name = param(#name, value).unit("1").range(minimum, maximum).doc(doc_of);
#define FLAG(name, value, doc_of) Param<bool> name = param(#name, value).doc(doc_of);
#define WEIGHT(name, value, doc_of) \
  Param<double> name = param(#name, value).unit("1").range(0.0, 1e5).doc("weight " doc_of);
#include "controllers/teb/parameters.inc"
};

}  // namespace teb

class Teb final : public teb::DeclaredParameters {
 public:
  static Descriptor describe();

  Status start(const Start& start) override;

 private:
  Status control(const Observation& now, Command& command) override;
  bool was_infeasible_lately(std::int64_t t_ns) const;
  double look_ahead_m(std::int64_t t_ns) const;
  void watch_for_oscillation(const Observation& now);
  Status drive(const Observation& now, const CostmapView& map, Command& command);
  teb::Task task(const Observation& now);
  Status wait(const Observation& now, FootprintCheck& footprint, Command& command);
  bool is_feasible(const teb::TimedElasticBand& band, const Observation& now, FootprintCheck& footprint) const;
  bool is_free(const Pose& pose, double ahead_s, const Observation& now, FootprintCheck& footprint) const;
  void annotate(const teb::TimedElasticBand& best) const;

  const dmrp_local_costmap* costmap_ = nullptr;
  const dmrp_obstacle_clusters* clusters_ = nullptr;
  PathAhead path_;
  SteeringEstimate steering_;
  ObstacleSet obstacles_;
  OscillationDetector oscillation_;
  teb::Parameters parameters_;
  teb::ClassPlanner planner_;
  std::vector<Vec2> via_points_;
  teb::Turn preferred_turn_ = teb::Turn::any;
  std::int64_t oscillated_ns_ = 0;  // the last time an oscillation was detected
  std::int64_t infeasible_ns_ = 0;  // the last time no band was feasible
  int infeasible_in_a_row_ = 0;
  bool was_infeasible_ = false;  // infeasible_ns_ is set
};

}  // namespace dmrp::controllers
