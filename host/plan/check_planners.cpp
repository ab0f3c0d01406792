// SPDX-License-Identifier: MIT
#include "host/plan/check_planners.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "core/scene/step_overlaps.hpp"
#include "host/experiment/read_plugin_uses.hpp"
#include "host/plan/planner_process.hpp"
#include "host/toml/toml_document.hpp"

namespace dmrp::host {

namespace {

// Whether robots of the variant have several types, or can touch on different cells.
bool has_unequal_robots(const Experiment& experiment, const ScenarioVariant& variant) {
  if (robot_count(variant) < 2) return false;
  const std::vector<std::string> types = types_in_use(variant);
  if (types.size() > 1) return true;
  const double radius_m = variant.types.find(types.front())->radius_m;
  const core::StepOverlaps::Robot robot{radius_m, {}, nullptr, true};
  return core::StepOverlaps(experiment.simulation.grid_resolution_m, {robot, robot}).are_possible();
}

// Why the planner refuses; "" if it does not.
std::string refusal_of(const Experiment& experiment, const ScenarioVariant& variant, const PluginUse& planner) {
  Experiment asked = experiment;
  asked.scenarios = {variant};
  asked.global_planners = {planner};
  asked.limits.planner_time_s = 0.0;
  const PlannerRun run = run_planner(asked, *scenario_task(asked));
  return run.answer && run.answer->status == DMRP_NO_SOLUTION ? run.answer->text : "";
}

}  // namespace

void check_planners(const Experiment& experiment, const std::filesystem::path& shown_file) {
  const TomlDocument document(shown_file.string(), experiment.text);
  for (const ScenarioVariant& variant : experiment.scenarios) {
    if (!has_unequal_robots(experiment, variant)) continue;
    for (const PluginUse& planner : experiment.global_planners) {
      if (planner.plans.is_given()) continue;
      const std::string refusal = refusal_of(experiment, variant, planner);
      if (refusal.empty()) continue;
      for (const TomlTable& table : document.root().tables(kind_name(DMRP_KIND_GLOBAL_PLANNER)))
        if (const auto use = naming(table, planner))
          use->fail(fmt::format("{} cannot plan for scenario '{}': {}", planner.info.id, variant.label, refusal));
    }
  }
}

std::vector<std::string> cut_off_warnings(const Experiment& experiment) {
  double cells_m = 0.0;
  std::vector<std::string> warnings;
  for (const auto& look : experiment.cut_off) {
    const CutOff found = look();
    if (found.lines.empty()) continue;
    cells_m = warnings.empty() ? found.advised_cells_m : std::min(cells_m, found.advised_cells_m);
    for (const std::string& line : found.lines)
      if (std::find(warnings.begin(), warnings.end(), line) == warnings.end()) warnings.push_back(line);
  }
  std::string advice = "; none of the usual smaller cells reach all";
  if (cells_m > 0.0 && !warnings.empty()) {
    Experiment finer = experiment;
    finer.simulation.grid_resolution_m = cells_m;
    std::set<std::string> refusing;
    for (ScenarioVariant& variant : finer.scenarios) {
      variant.simulation.reset();
      if (!has_unequal_robots(finer, variant)) continue;
      for (const PluginUse& planner : finer.global_planners)
        if (!planner.plans.is_given() && !refusal_of(finer, variant, planner).empty()) refusing.insert(planner.info.id);
    }
    advice = fmt::format("; grid_resolution_m = {} reaches all", cells_m);
    if (!refusing.empty()) advice += fmt::format(", but {} cannot plan with it", fmt::join(refusing, ", "));
  }
  for (std::string& warning : warnings) warning += advice;
  return warnings;
}

}  // namespace dmrp::host
