// SPDX-License-Identifier: MIT
// plan_task.hpp: the input of one call of plan(), and the validation of its answer.
#pragma once

#include <memory>

#include "core/scene/world_view.hpp"
#include "host/experiment/experiment.hpp"
#include "host/maps/movingai.hpp"
#include "host/plans/planning.hpp"
#include "host/world/variant_world.hpp"

namespace dmrp::host {

struct PlanTask {
  std::shared_ptr<const core::StaticGeometry> geometry;
  std::unique_ptr<const VariantWorld> variant;       // of a scenario
  std::unique_ptr<const core::WorldView> cell_view;  // of a map of cells
  StagedProblem problem;

  const dmrp_world& world() const {
    return variant ? variant->world_for(DMRP_KIND_GLOBAL_PLANNER) : cell_view->world();
  }

  PlanVerdict validate(const PlannedPaths& paths, std::uint32_t connectivity) const {
    return validate_plan(problem.c, paths, connectivity, [this](auto from, auto to, double r) {
      return variant ? variant->sweep_is_free(from, to, r) : geometry->sweep_is_free(from, to, r);
    });
  }
};

// The first planning problem of a trial in the experiment's first scenario; with drawn robots, of the first repetition.
// The experiment outlives the task. The robots stand on distinct cells (check_world()).
std::unique_ptr<PlanTask> scenario_task(const Experiment& experiment);

// Robots of radius 0 on the 1 m cells of a map, on which every free cell is open. Of the experiment's simulation settings
// only the step duration matters.
std::unique_ptr<PlanTask> cell_task(const core::CellMap& map, const std::vector<MovingAiTask>& tasks,
                                    const Experiment& experiment);

}  // namespace dmrp::host
