// SPDX-License-Identifier: MIT
#include "host/experiment/check_regions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <dmrp/toolkit/grid_view.hpp>
#include <memory>
#include <optional>

#include "core/scene/planning_grids.hpp"
#include "core/scene/robot_task.hpp"
#include "core/scene/static_geometry.hpp"
#include "core/tasks/free_regions.hpp"

namespace dmrp::host {

namespace {

// Whether a robot's start and goals lie on cells that hang together.
bool reaches_goals(const core::RobotTask& task, const core::PlanningGrid& planning) {
  const dmrp_grid view = planning.view();
  const toolkit::GridView grid(view);
  const dmrp_pose start = core::start_of(task);
  const std::uint32_t from = grid.index_of({start.x, start.y});
  if (from == toolkit::no_cell || !grid.free(from)) return false;
  const std::vector<bool> seen = core::reachable_cells(planning, from);
  return std::all_of(task.goals.begin(), task.goals.end(), [&](const dmrp_pose& goal) {
    const std::uint32_t cell = grid.index_of({goal.x, goal.y});
    return cell != toolkit::no_cell && seen[cell];
  });
}

class RegionCheck {
 public:
  explicit RegionCheck(const WorldUse& use)
      : use_(use), scenario_(use.file.scenario), geometry_(scenario_), drawn_{{}, scenario_.inside} {
    for (const core::TypeShare& share : use.drawn.types) drawn_.types.push_back(share.type);
  }

  // Finds the regions that cells of these settings may miss; none if they surely miss none.
  void find(const core::SimulationSettings& settings) {
    regions_.reset();
    if (use_.drawn.most == 0) return;
    const core::PlanningGrid grid = core::PlanningGrids(geometry_, use_.types, settings).common(drawn_.types);
    if (core::has_other_parts(grid, drawn_.inside))
      regions_.emplace(geometry_, use_.types, settings, drawn_, proposed_cells_m, most_cells_tried);
  }

  std::size_t regions() const { return regions_ ? regions_->count() : 0; }

  std::size_t missed(const core::SimulationSettings& settings) const {
    if (!regions_) return 0;
    return regions_->missed(core::PlanningGrids(geometry_, use_.types, settings).common(drawn_.types));
  }

  bool suits(const core::SimulationSettings& settings) const {
    const dmrp_vec2 size = {scenario_.upper.x - scenario_.lower.x, scenario_.upper.y - scenario_.lower.y};
    const double cell_m = settings.grid_resolution_m;
    if (size.x / cell_m * (size.y / cell_m) > most_cells_tried) return false;
    const core::PlanningGrids grids(geometry_, use_.types, settings);
    if (regions_ && regions_->missed(grids.common(drawn_.types)) > 0) return false;
    if (use_.drawn.most > 0 && core::part_for_tasks(grids.common(drawn_.types), drawn_.inside).empty()) return false;
    return std::all_of(scenario_.robots.begin(), scenario_.robots.end(),
                       [&](const core::RobotTask& task) { return reaches_goals(task, grids.of(task.type)); });
  }

  const ScenarioFile& file() const { return use_.file; }

 private:
  const WorldUse& use_;
  const core::Scenario& scenario_;
  core::StaticGeometry geometry_;
  core::DrawnFor drawn_;
  std::optional<core::FreeRegions> regions_;
};

using Checks = std::vector<std::unique_ptr<RegionCheck>>;

Checks checks_of(const std::vector<WorldUse>& worlds, const core::SimulationSettings& settings) {
  Checks checks;
  for (const WorldUse& use : worlds) {
    checks.push_back(std::make_unique<RegionCheck>(use));
    checks.back()->find(settings);
  }
  return checks;
}

double cells_for_all(const Checks& checks, core::SimulationSettings settings) {
  const double most_m = settings.grid_resolution_m;
  for (const double cell_m : proposed_cells_m) {
    settings.grid_resolution_m = cell_m;
    if (cell_m <= most_m &&
        std::all_of(checks.begin(), checks.end(), [&](const auto& check) { return check->suits(settings); }))
      return cell_m;
  }
  return 0.0;
}

}  // namespace

CutOff find_cut_off(const std::vector<WorldUse>& worlds, const core::SimulationSettings& settings) {
  const Checks checks = checks_of(worlds, settings);
  CutOff found;
  for (const auto& check : checks) {
    const std::size_t missed = check->missed(settings);
    if (missed == 0) continue;
    const ScenarioFile& file = check->file();
    found.lines.push_back(fmt::format("{}: {} of {} regions cannot be reached with cells of {} m",
                                      file.document->place(file.size), missed, check->regions(),
                                      settings.grid_resolution_m));
  }
  if (!found.lines.empty()) found.advised_cells_m = cells_for_all(checks, settings);
  return found;
}

double cells_for_all(const std::vector<WorldUse>& worlds, const core::SimulationSettings& settings) {
  return cells_for_all(checks_of(worlds, settings), settings);
}

}  // namespace dmrp::host
