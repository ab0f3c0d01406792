// SPDX-License-Identifier: MIT
#include "core/execution/action_dependencies.hpp"

#include <algorithm>
#include <cassert>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>
#include <tuple>

namespace dmrp::core {
namespace {

using toolkit::Cell;
using toolkit::GridView;

constexpr std::int64_t before_the_plan = std::numeric_limits<std::int64_t>::min();

}  // namespace

void ActionDependencies::set_plan(const dmrp_grid& grid, std::span<const std::vector<dmrp_waypoint>> paths,
                                  std::span<const dmrp_vec2> positions) {
  assert(paths.size() == positions.size());
  assert(std::none_of(paths.begin(), paths.end(), [](const auto& path) { return path.empty(); }));
  const GridView view(grid);
  robots_.assign(paths.size(), {});
  for (std::size_t i = 0; i < paths.size(); ++i)
    for (const dmrp_waypoint& waypoint : paths[i]) {
      const std::uint32_t cell = view.index_of(toolkit::position(waypoint));
      std::vector<Stage>& stages = robots_[i].stages;
      if (stages.empty() || stages.back().cell != cell) stages.push_back({cell, waypoint.t_ns, {}});
    }

  // Cell by cell in the plan's order: a claim depends on the visit before it and on all passes since.
  const std::vector<Claim> claims = find_claims(grid, positions);
  std::size_t since = 0;
  for (std::size_t i = 0; i < claims.size(); ++i) {
    if (claims[since].cell != claims[i].cell) since = i;
    for (std::size_t k = since; k < i; ++k) add_dependency(claims[i], claims[k]);
    if (claims[i].visits) since = i;
  }
  merge_rotations();
}

std::vector<ActionDependencies::Claim> ActionDependencies::find_claims(const dmrp_grid& grid,
                                                                       std::span<const dmrp_vec2> positions) const {
  const GridView view(grid);
  std::vector<Claim> claims;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const std::vector<Stage>& stages = robots_[i].stages;
    const std::uint32_t here = view.index_of(positions[i]);
    if (here != stages.front().cell) claims.push_back({here, before_the_plan, i, 0, 0, false});
    for (std::size_t k = 0; k < stages.size(); ++k) {
      claims.push_back({stages[k].cell, stages[k].arrival_ns, i, k, k + 1, true});
      if (k == 0) continue;
      const Cell from = view.cell(stages[k - 1].cell);
      const Cell to = view.cell(stages[k].cell);
      if (from.column == to.column || from.row == to.row) continue;
      for (const Cell beside : {Cell{from.column, to.row}, Cell{to.column, from.row}})
        claims.push_back({view.index(beside), stages[k].arrival_ns, i, k, k, false});
    }
  }
  std::sort(claims.begin(), claims.end(), [](const Claim& a, const Claim& b) {
    return std::tie(a.cell, a.arrival_ns, a.robot, a.from) < std::tie(b.cell, b.arrival_ns, b.robot, b.from);
  });
  return claims;
}

void ActionDependencies::add_dependency(const Claim& claim, const Claim& before) {
  // First positions depend on nothing. Two robots may pass the corners of a cell at the same time.
  if (claim.robot == before.robot || claim.from == 0 || claim.arrival_ns == before.arrival_ns) return;
  robots_[claim.robot].stages[claim.from].dependencies.push_back(
      {before.robot, static_cast<std::int64_t>(before.until)});
}

// The dependency on another robot's move at the same time, out of the way of this one.
const ActionDependencies::Dependency* ActionDependencies::simultaneous_dependency(Move move) const {
  const Stage& stage = robots_[move.robot].stages[move.stage];
  const auto found =
      std::find_if(stage.dependencies.begin(), stage.dependencies.end(), [&](const Dependency& dependency) {
        const std::vector<Stage>& others = robots_[dependency.robot].stages;
        const auto other = static_cast<std::size_t>(dependency.stage);
        return other < others.size() && others[other].arrival_ns == stage.arrival_ns;
      });
  return found == stage.dependencies.end() ? nullptr : &*found;
}

// All moves of the rotation that contains this move; empty if there is none.
std::vector<ActionDependencies::Move> ActionDependencies::rotation_through(Move move) const {
  std::vector<Move> rotation = {move};
  while (rotation.size() <= robots_.size()) {
    const Dependency* dependency = simultaneous_dependency(rotation.back());
    if (!dependency) return {};
    if (dependency->robot == move.robot) return rotation;
    rotation.push_back({dependency->robot, static_cast<std::size_t>(dependency->stage)});
  }
  return {};  // the move leads into a rotation but is not part of it
}

void ActionDependencies::release_together(const std::vector<Move>& rotation) {
  std::vector<Dependency> dependencies;
  for (const Move& move : rotation) {
    const Dependency* simultaneous = simultaneous_dependency(move);
    for (const Dependency& dependency : robots_[move.robot].stages[move.stage].dependencies)
      if (&dependency != simultaneous) dependencies.push_back(dependency);
    dependencies.push_back({move.robot, static_cast<std::int64_t>(move.stage) - 1});
  }
  for (const Move& move : rotation) robots_[move.robot].stages[move.stage].dependencies = dependencies;
}

void ActionDependencies::merge_rotations() {
  for (std::size_t i = 0; i < robots_.size(); ++i)
    for (std::size_t k = 1; k < robots_[i].stages.size(); ++k)
      if (const std::vector<Move> rotation = rotation_through({i, k}); !rotation.empty()) release_together(rotation);
}

void ActionDependencies::reached(std::size_t robot, std::uint32_t stage) {
  assert(robot < robots_.size() && stage < robots_[robot].stages.size());
  robots_[robot].reached = std::max<std::int64_t>(robots_[robot].reached, stage);
}

std::uint32_t ActionDependencies::released(std::size_t robot) {
  assert(robot < robots_.size());
  Robot& it = robots_[robot];
  while (it.released + 1 < it.stages.size()) {
    const std::vector<Dependency>& dependencies = it.stages[it.released + 1].dependencies;
    if (!std::all_of(dependencies.begin(), dependencies.end(), [this](const auto& d) { return is_met(d); })) break;
    ++it.released;
  }
  return it.released;
}

std::optional<std::uint32_t> ActionDependencies::holder(std::size_t robot) const {
  const Robot& it = robots_[robot];
  if (it.released + 1 == it.stages.size()) return std::nullopt;
  for (const Dependency& dependency : it.stages[it.released + 1].dependencies)
    if (!is_met(dependency)) return static_cast<std::uint32_t>(dependency.robot);
  return std::nullopt;
}

}  // namespace dmrp::core
