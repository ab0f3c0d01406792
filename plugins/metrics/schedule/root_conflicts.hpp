// SPDX-License-Identifier: MIT
// root_conflicts.hpp: which conflicts of the robots' own shortest paths a plan resolves by waiting, and which by a detour.
#pragma once

#include <dmrp/toolkit/individual_path.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "metrics/measure/bases.hpp"

namespace dmrp::metrics {

class RootConflicts final : public FirstPlanMetric {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.root_conflicts", "Conflicts at the root")
        .summary("which conflicts of the robots' own shortest paths the plan resolves by waiting, which by a detour")
        .source("own: after the root of CBS (Sharon, Stern, Felner, Sturtevant, Artificial Intelligence 219, 2015)")
        .value("root_conflicts", "1", Direction::none, Subjects::system,
               "pairs of robots on one cell at one step, or that exchange cells, if each takes its own shortest path "
               "by straight moves, turning as late as it can; undefined if planning failed, for tours, and for plans "
               "that are not from cell to cell",
               never_negative)
        .value("root_conflicts_waited", "1", Direction::none, Subjects::system,
               "of these pairs: the first plan leads both over the place of their first conflict, one after the other",
               never_negative)
        .value("root_conflicts_detoured", "1", Direction::none, Subjects::system,
               "of these pairs: the first plan leads at least one of them past that place, however long its way",
               never_negative)
        .value("root_conflicts_left", "1", lower_is_better, Subjects::system,
               "of these pairs: the two conflict in the first plan, too", never_negative);
  }

  void finish(const TrialEnd&, MetricSink& sink) override {
    std::optional<Counts> counts;
    const bool tours = std::any_of(world().robots().begin(), world().robots().end(),
                                   [](const Robot& one) { return one.goal_count > 1; });
    if (has_paths() && !tours) counts = count(GridView(*world()->planning_grid), first_plan_);
    sink.system("root_conflicts", counts ? counts->root : undefined);
    sink.system("root_conflicts_waited", counts ? counts->waited : undefined);
    sink.system("root_conflicts_detoured", counts ? counts->detoured : undefined);
    sink.system("root_conflicts_left", counts ? counts->left : undefined);
  }

 private:
  using CellPath = toolkit::CellPath;
  using GridView = toolkit::GridView;

  // A robot's stay on a cell by its plan: on it from `arrives_ns`, on the way to the next from `leaves_ns`, there at
  // `gone_ns`.
  struct Stay {
    std::uint32_t cell;
    std::int64_t arrives_ns;
    std::int64_t leaves_ns;
    std::int64_t gone_ns;
  };

  using Stays = std::vector<Stay>;

  // Nothing if the path does not lead from cell to neighbouring cell.
  static std::optional<Stays> stays_of(const GridView& grid, const Path& path) {
    constexpr std::int64_t for_ever = std::numeric_limits<std::int64_t>::max();
    Stays stays;
    for (const Waypoint& waypoint : path) {
      const std::uint32_t cell = grid.index_of(toolkit::position(waypoint));
      if (cell == toolkit::no_cell) return std::nullopt;
      if (!stays.empty() && cell == stays.back().cell) {
        stays.back().leaves_ns = waypoint.t_ns;
        continue;
      }
      if (!stays.empty()) {
        const toolkit::Cell from = grid.cell(stays.back().cell);
        const toolkit::Cell to = grid.cell(cell);
        if (toolkit::direction_of(to.column - from.column, to.row - from.row) < 0) return std::nullopt;
        stays.back().gone_ns = waypoint.t_ns;
      }
      stays.push_back({cell, waypoint.t_ns, waypoint.t_ns, for_ever});
    }
    return stays;
  }

  static bool overlap(std::int64_t from_a, std::int64_t to_a, std::int64_t from_b, std::int64_t to_b) {
    return from_a < to_b && from_b < to_a;
  }

  static bool conflict(const Stays& a, const Stays& b) {
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < b.size(); ++j) {
        if (a[i].cell == b[j].cell && overlap(a[i].arrives_ns, a[i].gone_ns, b[j].arrives_ns, b[j].gone_ns))
          return true;
        const bool exchange =
            i + 1 < a.size() && j + 1 < b.size() && a[i].cell == b[j + 1].cell && a[i + 1].cell == b[j].cell;
        if (exchange && overlap(a[i].leaves_ns, a[i].gone_ns, b[j].leaves_ns, b[j].gone_ns)) return true;
      }
    return false;
  }

  // Whether the plan leads over the cell, or from it to the neighbour `to`.
  static bool passes(const Stays& stays, std::uint32_t cell, std::uint32_t to) {
    for (std::size_t i = 0; i < stays.size(); ++i)
      if (stays[i].cell == cell && (cell == to || (i + 1 < stays.size() && stays[i + 1].cell == to))) return true;
    return false;
  }

  struct Counts {
    double root = 0.0;
    double waited = 0.0;
    double detoured = 0.0;
    double left = 0.0;
  };

  // A pair whose own shortest paths conflict, by the first of their conflicts.
  static void count_pair(const CellPath& own_a, const CellPath& own_b, const Stays& a, const Stays& b, Counts& counts) {
    std::optional<std::pair<std::uint32_t, std::uint32_t>> first;
    toolkit::for_each_conflict(own_a, own_b, [&](std::uint32_t cell_a, std::uint32_t cell_b) {
      if (!first) first = {cell_a, cell_b};
    });
    if (!first) return;
    counts.root += 1.0;
    if (conflict(a, b))
      counts.left += 1.0;
    else if (passes(a, first->first, first->second) && passes(b, first->second, first->first))
      counts.waited += 1.0;
    else
      counts.detoured += 1.0;
  }

  // Nothing for plans that are not from cell to cell.
  static std::optional<Counts> count(const GridView& grid, const Plan& plan) {
    std::vector<Stays> planned;
    std::vector<CellPath> own;
    const std::vector<bool> nothing_closed(grid.size());
    for (std::size_t robot = 0; robot < plan.size(); ++robot) {
      const auto stays = stays_of(grid, plan.path(robot));
      if (!stays || stays->empty()) return std::nullopt;
      planned.push_back(*stays);
      own.push_back(toolkit::individual_path(grid, stays->front().cell,
                                             toolkit::straight_steps_to(grid, stays->back().cell, nothing_closed)));
    }
    Counts counts;
    for (std::size_t a = 0; a < planned.size(); ++a)
      for (std::size_t b = a + 1; b < planned.size(); ++b) count_pair(own[a], own[b], planned[a], planned[b], counts);
    return counts;
  }
};

}  // namespace dmrp::metrics
