// SPDX-License-Identifier: MIT
#include "core/tasks/task_generator.hpp"

#include <dmrp/toolkit/random.hpp>
#include <string>

namespace dmrp::core {
namespace {

bool fulfils(const TaskDifficulty& difficulty, const TaskWishes& wishes) {
  const std::uint32_t conflicts =
      wishes.crossing == Crossing::corridor ? difficulty.corridor_conflicts : difficulty.conflicts;
  return difficulty.well_formed && conflicts >= wishes.conflicts_min && conflicts <= wishes.conflicts_max;
}

}  // namespace

DrawnTasks draw_tasks(const PlanningGrids& grids, const TaskRequest& request, std::uint64_t seed) {
  DrawnTasks out;
  out.tasks = grids.draw(request.types, request.count, seed, request.inside, &out.lack);
  if (request.wishes.drawn == 0) return out;
  std::vector<std::string> types;
  for (const TypeShare& share : request.types) types.push_back(share.type);
  const PlanningGrid grid = grids.common(types);
  for (int attempt = 0;; ++attempt) {
    out.difficulty = difficulty_of(grid, out.tasks);
    out.as_wished = out.tasks.size() == request.count && fulfils(out.difficulty, request.wishes);
    if (out.as_wished || attempt + 1 == task_attempts) return out;
    const std::uint64_t next = toolkit::Stream(seed, "robots.tasks", static_cast<std::uint64_t>(attempt)).next_u64();
    out.tasks = grids.draw(request.types, request.count, next, request.inside, &out.lack);
  }
}

}  // namespace dmrp::core
