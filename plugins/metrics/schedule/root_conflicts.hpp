// SPDX-License-Identifier: MIT
// root_conflicts.hpp: which conflicts of the robots' own shortest paths a plan resolves by waiting, and which by a detour.
#pragma once

#include <dmrp/toolkit/individual_path.hpp>
#include <limits>
#include <numeric>
#include <optional>
#include <unordered_set>
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

  struct Stays {
    std::vector<Stay> in_time;
    std::vector<std::uint32_t> by_cell;  // indices of in_time, sorted by cell
  };

  // Nothing if the path does not lead from cell to neighbouring cell.
  static std::optional<Stays> stays_of(const GridView& grid, const Path& path) {
    constexpr std::int64_t for_ever = std::numeric_limits<std::int64_t>::max();
    Stays result;
    std::vector<Stay>& stays = result.in_time;
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
    result.by_cell.resize(stays.size());
    std::iota(result.by_cell.begin(), result.by_cell.end(), 0u);
    std::sort(result.by_cell.begin(), result.by_cell.end(),
              [&](std::uint32_t a, std::uint32_t b) { return stays[a].cell < stays[b].cell; });
    return result;
  }

  static bool overlap(std::int64_t from_a, std::int64_t to_a, std::int64_t from_b, std::int64_t to_b) {
    return from_a < to_b && from_b < to_a;
  }

  // Whether two stays on one cell, or the moves from the one and to the other, conflict.
  static bool conflict_at(const std::vector<Stay>& a, std::size_t i, const std::vector<Stay>& b, std::size_t j) {
    if (overlap(a[i].arrives_ns, a[i].gone_ns, b[j].arrives_ns, b[j].gone_ns)) return true;
    const bool exchange = i + 1 < a.size() && j > 0 && a[i + 1].cell == b[j - 1].cell;
    return exchange && overlap(a[i].leaves_ns, a[i].gone_ns, b[j - 1].leaves_ns, b[j - 1].gone_ns);
  }

  static bool conflict(const Stays& a, const Stays& b) {
    auto from = b.by_cell.begin();
    for (const std::uint32_t i : a.by_cell) {
      const std::uint32_t cell = a.in_time[i].cell;
      while (from != b.by_cell.end() && b.in_time[*from].cell < cell) ++from;
      for (auto j = from; j != b.by_cell.end() && b.in_time[*j].cell == cell; ++j)
        if (conflict_at(a.in_time, i, b.in_time, *j)) return true;
    }
    return false;
  }

  // Whether the plan leads over the cell, or from it to the neighbour `to`.
  static bool passes(const std::vector<Stay>& stays, std::uint32_t cell, std::uint32_t to) {
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

  // Which robots are on a cell at a step of their own shortest paths.
  class Occupants {
   public:
    Occupants(std::uint32_t cells, std::size_t robots) : first_(cells, nobody), next_(robots, nobody) {}

    void place(const std::vector<CellPath>& paths, std::size_t step) {
      for (const std::uint32_t cell : used_) first_[cell] = nobody;
      used_.clear();
      for (std::size_t robot = 0; robot < paths.size(); ++robot) {
        const std::uint32_t cell = toolkit::at_step(paths[robot], step);
        next_[robot] = first_[cell];
        first_[cell] = static_cast<std::uint32_t>(robot);
        used_.push_back(cell);
      }
    }

    template <class Visit>
    void visit(std::uint32_t cell, Visit&& visit) const {
      for (std::uint32_t robot = first_[cell]; robot != nobody; robot = next_[robot]) visit(robot);
    }

   private:
    static constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

    std::vector<std::uint32_t> first_;  // by cell
    std::vector<std::uint32_t> next_;   // by robot, on the same cell
    std::vector<std::uint32_t> used_;   // cells
  };

  // Calls visit(a, b, a's cell, b's cell), a < b, for each pair at its first conflict.
  template <class Visit>
  static void for_each_pair(std::uint32_t cells, const std::vector<CellPath>& paths, Visit&& visit) {
    std::size_t longest = 0;
    for (const CellPath& path : paths) longest = std::max(longest, path.size());
    Occupants occupants(cells, paths.size());
    std::unordered_set<std::uint64_t> seen;
    for (std::size_t step = 0; step < longest; ++step) {
      occupants.place(paths, step);
      for (std::uint32_t b = 0; b < paths.size(); ++b) {
        const std::uint32_t here = toolkit::at_step(paths[b], step);
        const std::uint32_t next = toolkit::at_step(paths[b], step + 1);
        const auto add = [&](std::uint32_t a, std::uint32_t cell) {
          if (seen.insert(std::uint64_t{a} << 32 | b).second) visit(a, b, cell, here);
        };
        occupants.visit(here, [&](std::uint32_t a) {
          if (a < b) add(a, here);
        });
        if (next == here) continue;
        occupants.visit(next, [&](std::uint32_t a) {
          if (a < b && toolkit::at_step(paths[a], step + 1) == here) add(a, next);
        });
      }
    }
  }

  // Nothing for plans that are not from cell to cell.
  static std::optional<Counts> count(const GridView& grid, const Plan& plan) {
    std::vector<Stays> planned;
    std::vector<CellPath> own;
    const std::vector<bool> nothing_closed(grid.size());
    for (std::size_t robot = 0; robot < plan.size(); ++robot) {
      const auto stays = stays_of(grid, plan.path(robot));
      if (!stays || stays->in_time.empty()) return std::nullopt;
      planned.push_back(*stays);
      const std::uint32_t start = stays->in_time.front().cell;
      const std::uint32_t goal = stays->in_time.back().cell;
      own.push_back(
          toolkit::individual_path(grid, start, toolkit::straight_steps_to(grid, goal, nothing_closed, start)));
    }
    Counts counts;
    for_each_pair(grid.size(), own, [&](std::uint32_t a, std::uint32_t b, std::uint32_t cell_a, std::uint32_t cell_b) {
      counts.root += 1.0;
      if (conflict(planned[a], planned[b]))
        counts.left += 1.0;
      else if (passes(planned[a].in_time, cell_a, cell_b) && passes(planned[b].in_time, cell_b, cell_a))
        counts.waited += 1.0;
      else
        counts.detoured += 1.0;
    });
    return counts;
  }
};

}  // namespace dmrp::metrics
