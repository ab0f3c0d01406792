// SPDX-License-Identifier: MIT
#include "core/people/narrow_ways.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace dmrp::core {
namespace {

using toolkit::GridView;
using toolkit::no_cell;

constexpr double accuracy_m = 1e-4;  // of the width of a gap
constexpr int quarters = 4;          // the directions E, N, W, S, which are 0, 2, 4, 6

// Which of some things hang together.
template <std::size_t count>
class Parts {
 public:
  Parts() { std::iota(part_.begin(), part_.end(), 0); }
  void join(std::size_t a, std::size_t b) { std::replace(part_.begin(), part_.end(), part_[a], int{part_[b]}); }
  bool joined(std::size_t a, std::size_t b) const { return part_[a] == part_[b]; }

 private:
  std::array<int, count> part_{};
};

struct Place {
  dmrp_vec2 at{};
  double clearance_m = 0.0;
};

// Some places on the line between two cells; the last one has the largest clearance.
constexpr std::size_t places = 6;
using Side = std::array<Place, places>;

// Looks for the largest clearance by branch and bound: it grows by at most a metre a metre.
void search(const StaticGeometry& geometry, const Place& from, const Place& to, double worth_m, Place& best) {
  const double length_m = toolkit::distance(from.at, to.at);
  const double at_most_m = 0.5 * (from.clearance_m + to.clearance_m + length_m);
  const double enough_m = best.clearance_m + (best.clearance_m < worth_m ? 0.5 * accuracy_m : 0.01);
  if (at_most_m < worth_m || at_most_m < enough_m) return;
  Place middle = {0.5 * (from.at + to.at)};
  middle.clearance_m = geometry.clearance(middle.at);
  if (middle.clearance_m > best.clearance_m) best = middle;
  search(geometry, from, middle, worth_m, best);
  search(geometry, middle, to, worth_m, best);
}

// Moves a place along a line to where the clearance is largest nearby: the middle of a gap.
void settle(const StaticGeometry& geometry, dmrp_vec2 from, dmrp_vec2 to, Place& best) {
  while (toolkit::distance(from, to) > 0.1 * accuracy_m) {
    const dmrp_vec2 third = (to - from) / 3.0;
    const Place low = {from + third, geometry.clearance(from + third)};
    const Place high = {to - third, geometry.clearance(to - third)};
    (low.clearance_m < high.clearance_m ? from : to) = (low.clearance_m < high.clearance_m ? low : high).at;
    for (const Place& place : {low, high})
      if (place.clearance_m > best.clearance_m) best = place;
  }
}

class NarrowWays {
 public:
  NarrowWays(const StaticGeometry& geometry, double radius_m, PlanningGrid& grid)
      : geometry_(geometry),
        least_m_(radius_m - accuracy_m),
        grid_(grid),
        c_grid_(grid.view()),
        view_(c_grid_),
        edges_(grid.edges) {
    const double corner_m = std::sqrt(0.5) * view_.resolution_m();
    for (std::uint32_t cell = 0; cell < view_.size(); ++cell)
      if (!view_.free(cell) && static_cast<double>(view_.clearance(cell)) + corner_m >= least_m_)
        between_.push_back(cell);
    for (std::uint32_t cell = 0; cell < view_.size(); ++cell)
      for (std::size_t q = 0; q < 2; ++q)
        if (const std::uint32_t other = view_.neighbour(cell, direction_of(q));
            other != no_cell && view_.free(cell) && view_.free(other) && !edge(cell, q))
          shut_.emplace_back(cell, q);
  }

  void open() {
    assume_open();
    keep_joining();
    // what joins nothing even where there is room everywhere: in most worlds, all
    std::erase_if(between_, [&](std::uint32_t cell) { return edges_[cell] == 0; });
    std::erase_if(shut_, [&](const auto& side) { return !edge(side.first, side.second); });
    if (between_.empty() && shut_.empty()) return;
    edges_ = grid_.edges;
    for (const std::uint32_t cell : between_)
      for (std::size_t q = 0; q < quarters; ++q) open_side(cell, q);
    for (const auto& [cell, q] : shut_) open_side(cell, q);
    thin();
    keep_joining();
    for (const std::uint32_t cell : between_) grid_.free[cell] = edges_[cell] != 0;
    grid_.edges = edges_;
  }

 private:
  static constexpr int direction_of(std::size_t quarter) { return static_cast<int>(2 * quarter); }

  bool edge(std::uint32_t cell, std::size_t quarter) const { return (edges_[cell] >> direction_of(quarter) & 1) != 0; }

  void set_edge(std::uint32_t cell, std::size_t quarter, bool is_open) {
    const std::uint32_t other = view_.neighbour(cell, direction_of(quarter));
    const auto change = [&](std::uint32_t at, int direction) {
      const unsigned bit = 1u << direction;
      edges_[at] = static_cast<std::uint8_t>(is_open ? edges_[at] | bit : edges_[at] & ~bit);
    };
    change(cell, direction_of(quarter));
    change(other, toolkit::opposite_direction(direction_of(quarter)));
  }

  // Opens a way to each side of every cell in which there may be room.
  void assume_open() {
    std::vector<bool> may_pass(view_.size());
    for (std::uint32_t cell = 0; cell < view_.size(); ++cell) may_pass[cell] = view_.free(cell);
    for (const std::uint32_t cell : between_) may_pass[cell] = true;
    for (const std::uint32_t cell : between_)
      for (std::size_t q = 0; q < quarters; ++q)
        if (const std::uint32_t other = view_.neighbour(cell, direction_of(q)); other != no_cell && may_pass[other])
          set_edge(cell, q, true);
    for (const auto& [cell, q] : shut_) set_edge(cell, q, true);
  }

  // Whether the ways from a cell to two neighbouring sides hang together around their corner.
  bool leads_around(std::uint32_t cell, std::size_t q) const {
    const std::size_t next = (q + 1) % quarters;
    const std::uint32_t one = view_.neighbour(cell, direction_of(q));
    const std::uint32_t two = view_.neighbour(cell, direction_of(next));
    return one != no_cell && two != no_cell && edge(one, next) && edge(two, q);
  }

  // Whether the cell joins neighbours that do not hang together around it.
  bool is_needed(std::uint32_t cell) const {
    Parts<quarters> around;
    for (std::size_t q = 0; q < quarters; ++q)
      if (leads_around(cell, q)) around.join(q, (q + 1) % quarters);
    for (std::size_t a = 0; a < quarters; ++a)
      for (std::size_t b = a + 1; b < quarters; ++b)
        if (edge(cell, a) && edge(cell, b) && !around.joined(a, b)) return true;
    return false;
  }

  // Closes what leads only to where there was a way before, so that grids change where they joined nothing, and only there.
  void keep_joining() {
    const std::vector<std::uint32_t> before = parts_of(grid_.edges);
    std::vector<bool> known(view_.size());
    for (const std::uint32_t first : between_) {
      if (known[first] || edges_[first] == 0) continue;
      std::vector<std::uint32_t> group = {first};
      std::set<std::uint32_t> joined;
      known[first] = true;
      for (std::size_t i = 0; i < group.size(); ++i)
        for (std::size_t q = 0; q < quarters; ++q) {
          if (!edge(group[i], q)) continue;
          const std::uint32_t other = view_.neighbour(group[i], direction_of(q));
          if (view_.free(other)) joined.insert(before[other]);
          if (view_.free(other) || known[other]) continue;
          known[other] = true;
          group.push_back(other);
        }
      if (joined.size() > 1) continue;
      for (const std::uint32_t cell : group)
        for (std::size_t q = 0; q < quarters; ++q)
          if (edge(cell, q)) set_edge(cell, q, false);
    }
    for (const auto& [cell, q] : shut_)
      if (before[cell] == before[view_.neighbour(cell, direction_of(q))]) set_edge(cell, q, false);
  }

  // Says of each cell which part of the grid it lies in.
  std::vector<std::uint32_t> parts_of(const std::vector<std::uint8_t>& edges) const {
    const std::uint32_t cells = view_.size();
    std::vector<std::uint32_t> label(cells, no_cell);
    for (std::uint32_t first = 0; first < cells; ++first) {
      if (label[first] != no_cell) continue;
      std::vector<std::uint32_t> open = {first};
      label[first] = first;
      while (!open.empty()) {
        const std::uint32_t cell = open.back();
        open.pop_back();
        for (std::size_t q = 0; q < quarters; ++q) {
          if ((edges[cell] >> direction_of(q) & 1) == 0) continue;
          const std::uint32_t next = view_.neighbour(cell, direction_of(q));
          if (label[next] == no_cell) open.push_back(next);
          label[next] = first;
        }
      }
    }
    return label;
  }

  // Whether there is no other way to the neighbour over the cells beside both.
  bool is_needed(std::uint32_t cell, std::size_t q) const {
    const std::size_t before = (q + 3) % quarters;
    const std::size_t after = (q + 1) % quarters;
    return !(edge(cell, after) && leads_around(cell, q)) && !(edge(cell, before) && leads_around(cell, before));
  }

  // Closes cells in between, and edges, until all that are left are needed.
  void thin() {
    std::vector<std::uint32_t> cells = between_;
    std::vector<std::pair<std::uint32_t, std::size_t>> edges = shut_;
    const auto close_cell = [&](std::uint32_t cell) {
      if (is_needed(cell)) return false;
      for (std::size_t q = 0; q < quarters; ++q)
        if (edge(cell, q)) set_edge(cell, q, false);
      return true;
    };
    const auto close_edge = [&](const auto& side) {
      if (edge(side.first, side.second) && is_needed(side.first, side.second)) return false;
      set_edge(side.first, side.second, false);
      return true;
    };
    while (std::erase_if(cells, close_cell) + std::erase_if(edges, close_edge) > 0) {
    }
  }

  void find_sides(std::uint32_t cell) {
    for (std::size_t q = 0; q < quarters; ++q) {
      const std::uint32_t other = view_.neighbour(cell, direction_of(q));
      if (other == no_cell) continue;
      const auto [side, is_new] = sides_.try_emplace(side_index(cell, q));
      if (is_new) find_places(view_.center(cell), view_.center(other), side->second);
    }
  }

  void find_places(dmrp_vec2 cell, dmrp_vec2 other, Side& side) const {
    const dmrp_vec2 middle = 0.5 * (cell + other);
    const dmrp_vec2 along = {middle.y - cell.y, cell.x - middle.x};
    for (std::size_t i = 0; i + 1 < places; ++i) {
      side[i].at = middle + (0.5 * static_cast<double>(i) - 1.0) * along;
      side[i].clearance_m = geometry_.clearance(side[i].at);
      if (side[i].clearance_m > side[places - 1].clearance_m) side[places - 1] = side[i];
    }
    Place& best = side[places - 1];
    for (std::size_t i = 0; i + 2 < places; ++i) search(geometry_, side[i], side[i + 1], least_m_, best);
    if (best.clearance_m < least_m_) return;
    const auto within = [&](double offset) {
      const double at = toolkit::dot(best.at - middle, along) / toolkit::dot(along, along);
      return middle + std::clamp(at + offset, -1.0, 1.0) * along;
    };
    settle(geometry_, within(-0.1), within(0.1), best);
  }

  // Each side stands with the cell to its left or below.
  std::size_t side_index(std::uint32_t cell, std::size_t quarter) const {
    const std::uint32_t first = quarter < 2 ? cell : view_.neighbour(cell, direction_of(quarter));
    return std::size_t{2} * first + quarter % 2;
  }

  // The places on the sides of a cell between which the disc can move straight on, or by way of others: those that its
  // centre hangs together with or, if it is not free, the largest such set.
  using Hub = std::array<std::array<bool, places>, quarters>;
  Hub hub(std::uint32_t cell) {
    find_sides(cell);
    constexpr std::size_t center = quarters * places;
    std::array<Place, center + 1> all{};
    all[center] = {view_.center(cell), view_.free(cell) ? least_m_ : 0.0};
    for (std::size_t q = 0; q < quarters; ++q)
      if (view_.neighbour(cell, direction_of(q)) != no_cell)
        std::copy_n(sides_.at(side_index(cell, q)).begin(), places, &all[q * places]);
    Parts<center + 1> parts;
    const auto is_wide = [&](std::size_t i) { return all[i].clearance_m >= least_m_; };
    for (std::size_t a = 0; a <= center; ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (is_wide(a) && is_wide(b) && !parts.joined(a, b) && geometry_.sweep_is_free(all[a].at, all[b].at, least_m_))
          parts.join(a, b);
    const auto sides_of = [&](std::size_t place) {
      Hub found{};
      for (std::size_t i = 0; i < center; ++i) found[i / places][i % places] = is_wide(i) && parts.joined(i, place);
      return found;
    };
    if (view_.free(cell)) return sides_of(center);
    Hub best{};
    for (std::size_t i = 0; i < center; ++i)
      if (const Hub found = sides_of(i); is_wide(i) && reach_of(found) > reach_of(best)) best = found;
    return best;
  }

  static std::ptrdiff_t reach_of(const Hub& hub) {
    return std::count_if(hub.begin(), hub.end(),
                         [](const auto& side) { return std::count(side.begin(), side.end(), true) > 0; });
  }

  // Opens the way to a neighbour if the disc can go on from a place between the two in both.
  void open_side(std::uint32_t cell, std::size_t q) {
    const std::uint32_t other = view_.neighbour(cell, direction_of(q));
    if (other == no_cell || edge(cell, q)) return;
    const auto& here = hub_of(cell)[q];
    const auto& there = hub_of(other)[(q + 2) % quarters];
    for (std::size_t i = 0; i < places; ++i)
      if (here[i] && there[i]) return set_edge(cell, q, true);
  }

  const Hub& hub_of(std::uint32_t cell) {
    const auto [found, is_new] = hubs_.try_emplace(cell);
    if (is_new) found->second = hub(cell);
    return found->second;
  }

  const StaticGeometry& geometry_;
  double least_m_;  // the clearance that a way needs
  PlanningGrid& grid_;
  dmrp_grid c_grid_;
  GridView view_;
  std::vector<std::uint8_t> edges_;     // as they become
  std::vector<std::uint32_t> between_;  // cells that are not free, in which there may be room, ascending
  std::vector<std::pair<std::uint32_t, std::size_t>> shut_;  // edges between free cells, not open
  std::map<std::size_t, Side> sides_;                        // by cell: to the right, and above
  std::map<std::uint32_t, Hub> hubs_;                        // by cell
};

}  // namespace

void open_narrow_ways(const StaticGeometry& geometry, double radius_m, PlanningGrid& grid) {
  if (2.0 * radius_m >= grid.resolution_m) NarrowWays(geometry, radius_m, grid).open();
}

PlanningGrid build_walking_grid(const StaticGeometry& geometry, double radius_m, double resolution_m) {
  PlanningGrid grid = build_planning_grid(geometry, resolution_m, radius_m, 0.0);
  open_narrow_ways(geometry, radius_m, grid);
  return grid;
}

}  // namespace dmrp::core
