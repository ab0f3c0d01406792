// SPDX-License-Identifier: MIT
#include "host/plans/plan_conflicts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace dmrp::host {

namespace {

constexpr double tolerance_m = 1e-6;
constexpr double points_meet_m = 1e-3;  // points, which have no extent, meet within this

using Robot = std::uint32_t;
using Pair = std::pair<Robot, Robot>;  // the lower number first

void make_unique(std::vector<Pair>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

// ---- paths on the grid ----

PlanCell at(const std::vector<PlanCell>& cells, std::size_t step) {
  return cells[std::min(step, cells.size() - 1)];
}

bool is_diagonal(PlanCell from, PlanCell to) {
  return from.column != to.column && from.row != to.row;
}

// The two cells beside a diagonal move.
std::pair<PlanCell, PlanCell> beside(PlanCell from, PlanCell to) {
  return {{from.column, to.row}, {to.column, from.row}};
}

// The kind of conflict of two moves in the same step, or nullptr.
const char* conflict(PlanCell a0, PlanCell a1, PlanCell b0, PlanCell b1) {
  if (a1 == b1) return "vertex";
  if (a0 == b1 && a1 == b0) return "swap";
  const auto passes = [&](PlanCell from, PlanCell to, PlanCell other) {
    if (!is_diagonal(from, to)) return false;
    const auto [one, two] = beside(from, to);
    return other == one || other == two;
  };
  const bool crossing = is_diagonal(a0, a1) && is_diagonal(b0, b1) && a0.column + a1.column == b0.column + b1.column &&
                        a0.row + a1.row == b0.row + b1.row;
  if (crossing) return "crossing";
  if (passes(a0, a1, b0) || passes(a0, a1, b1) || passes(b0, b1, a0) || passes(b0, b1, a1)) return "passing";
  return nullptr;
}

// The robots in each cell at one step: for each cell a linked list.
class Positions {
 public:
  Positions(const std::vector<std::vector<PlanCell>>& cells, PlanCell lower, PlanCell upper)
      : cells_(cells),
        lower_(lower),
        width_(static_cast<std::size_t>(upper.column - lower.column) + 1),
        height_(static_cast<std::size_t>(upper.row - lower.row) + 1),
        first_(width_ * height_, nobody),
        next_(cells.size(), nobody) {}

  void fill(std::size_t step) {
    for (const std::size_t cell : used_) first_[cell] = nobody;
    used_.clear();
    for (auto robot = static_cast<Robot>(cells_.size()); robot-- > 0;) {
      const std::size_t cell = index(at(cells_[robot], step));
      next_[robot] = first_[cell];
      first_[cell] = robot;
      used_.push_back(cell);
    }
  }

  template <class Visit>
  void visit(PlanCell cell, Visit visit) const {
    if (cell.column < lower_.column || cell.row < lower_.row) return;
    if (static_cast<std::size_t>(cell.column - lower_.column) >= width_) return;
    if (static_cast<std::size_t>(cell.row - lower_.row) >= height_) return;
    for (Robot robot = first_[index(cell)]; robot != nobody; robot = next_[robot]) visit(robot);
  }

 private:
  static constexpr Robot nobody = std::numeric_limits<Robot>::max();
  std::size_t index(PlanCell cell) const {
    return static_cast<std::size_t>(cell.row - lower_.row) * width_ +
           static_cast<std::size_t>(cell.column - lower_.column);
  }

  const std::vector<std::vector<PlanCell>>& cells_;
  PlanCell lower_;
  std::size_t width_;
  std::size_t height_;
  std::vector<Robot> first_;
  std::vector<Robot> next_;
  std::vector<std::size_t> used_;
};

// The pairs that may conflict between two steps, by their cells. Each conflict shows in the cells around at least one of its moves:
// a robot that arrives in the same cell, one that leaves the cell where this one goes, one beside a diagonal.
void list_neighbours(const std::vector<std::vector<PlanCell>>& cells, std::size_t step, const Positions& now,
                     const Positions& next, std::vector<Pair>& pairs) {
  pairs.clear();
  for (Robot robot = 0; robot < cells.size(); ++robot) {
    const auto add = [&pairs, robot](Robot other) {
      if (other != robot) pairs.emplace_back(std::min(robot, other), std::max(robot, other));
    };
    const PlanCell from = at(cells[robot], step);
    const PlanCell to = at(cells[robot], step + 1);
    next.visit(to, [&](Robot other) {
      if (other > robot) add(other);
    });
    if (from == to) continue;
    now.visit(to, add);
    if (!is_diagonal(from, to)) continue;
    const std::pair<PlanCell, PlanCell> sides = beside(from, to);
    for (const PlanCell side : {sides.first, sides.second}) {
      now.visit(side, add);
      next.visit(side, add);
    }
  }
  make_unique(pairs);
}

// Adds the pairs whose footprints may overlap between two steps.
void list_near(const std::vector<std::vector<PlanCell>>& cells, std::size_t step, std::int32_t reach,
               const Positions& now, std::vector<Pair>& pairs) {
  for (Robot robot = 0; robot < cells.size(); ++robot) {
    const PlanCell from = at(cells[robot], step);
    for (std::int32_t row = from.row - reach; row <= from.row + reach; ++row)
      for (std::int32_t column = from.column - reach; column <= from.column + reach; ++column)
        now.visit({column, row}, [&](Robot other) {
          if (other > robot) pairs.emplace_back(robot, other);
        });
  }
  make_unique(pairs);
}

// ---- moving discs ----

// A robot's position at a time: linear between waypoints, at the last one afterwards.
dmrp_vec2 position(const std::vector<dmrp_waypoint>& path, std::int64_t t_ns) {
  if (t_ns >= path.back().t_ns) return {path.back().x, path.back().y};
  const auto next = std::upper_bound(path.begin(), path.end(), t_ns,
                                     [](std::int64_t t, const dmrp_waypoint& w) { return t < w.t_ns; });
  if (next == path.begin()) return {next->x, next->y};
  const dmrp_waypoint& from = *(next - 1);
  const double share = static_cast<double>(t_ns - from.t_ns) / static_cast<double>(next->t_ns - from.t_ns);
  return {from.x + share * (next->x - from.x), from.y + share * (next->y - from.y)};
}

std::size_t waypoints_until(const std::vector<dmrp_waypoint>& path, std::int64_t t_ns) {
  const auto behind = std::upper_bound(path.begin(), path.end(), t_ns,
                                       [](std::int64_t t, const dmrp_waypoint& w) { return t < w.t_ns; });
  return static_cast<std::size_t>(behind - path.begin());
}

// The least distance of two points that move linearly over one interval.
double least_distance(dmrp_vec2 a0, dmrp_vec2 a1, dmrp_vec2 b0, dmrp_vec2 b1) {
  const dmrp_vec2 offset{a0.x - b0.x, a0.y - b0.y};
  const dmrp_vec2 change{a1.x - a0.x - b1.x + b0.x, a1.y - a0.y - b1.y + b0.y};
  const double square = change.x * change.x + change.y * change.y;
  const double share = square > 0 ? std::clamp(-(offset.x * change.x + offset.y * change.y) / square, 0.0, 1.0) : 0.0;
  return std::hypot(offset.x + share * change.x, offset.y + share * change.y);
}

// What a disc covers in a window of time.
struct Box {
  dmrp_vec2 lower{};
  dmrp_vec2 upper{};
  Robot robot = 0;
};

Box box_of(const std::vector<dmrp_waypoint>& path, Robot robot, double radius_m, std::int64_t from_ns,
           std::int64_t to_ns) {
  const dmrp_vec2 begin = position(path, from_ns);
  Box box{begin, begin, robot};
  const auto widen = [&box](dmrp_vec2 p) {
    box.lower = {std::min(box.lower.x, p.x), std::min(box.lower.y, p.y)};
    box.upper = {std::max(box.upper.x, p.x), std::max(box.upper.y, p.y)};
  };
  widen(position(path, to_ns));
  auto inside = std::lower_bound(path.begin(), path.end(), from_ns,
                                 [](const dmrp_waypoint& w, std::int64_t t) { return w.t_ns < t; });
  for (; inside != path.end() && inside->t_ns <= to_ns; ++inside) widen({inside->x, inside->y});
  const double margin_m = std::max(radius_m, points_meet_m) + tolerance_m;
  box.lower = {box.lower.x - margin_m, box.lower.y - margin_m};
  box.upper = {box.upper.x + margin_m, box.upper.y + margin_m};
  return box;
}

bool overlap(const Box& a, const Box& b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y;
}

// The pairs whose boxes overlap, by strips along x.
void list_overlaps(std::vector<Box>& boxes, double strip_m, std::vector<Pair>& pairs) {
  constexpr double most_strips = 64;  // a box over more of them is compared with all others
  struct Entry {
    double row;
    double x;
    std::size_t box;
  };
  pairs.clear();
  std::vector<Entry> entries;
  std::vector<std::size_t> tall;
  const auto add = [&](const Box& a, const Box& b) {
    if (a.robot != b.robot && overlap(a, b)) pairs.emplace_back(std::min(a.robot, b.robot), std::max(a.robot, b.robot));
  };
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const double first = std::floor(boxes[i].lower.y / strip_m);
    const double last = std::floor(boxes[i].upper.y / strip_m);
    if (last - first > most_strips) tall.push_back(i);
    for (double offset = 0; offset <= last - first && last - first <= most_strips; ++offset)
      entries.push_back({first + offset, boxes[i].lower.x, i});
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return std::tie(a.row, a.x, a.box) < std::tie(b.row, b.x, b.box); });
  for (std::size_t i = 0; i < entries.size(); ++i)
    for (std::size_t j = i + 1;
         j < entries.size() && entries[j].row == entries[i].row && entries[j].x <= boxes[entries[i].box].upper.x; ++j)
      add(boxes[entries[i].box], boxes[entries[j].box]);
  for (const std::size_t i : tall)
    for (const Box& other : boxes) add(boxes[i], other);
  make_unique(pairs);
}

// The windows of time in which boxes are compared.
struct Windows {
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
  std::int64_t length_ns = 1;
  std::int64_t count = 1;

  explicit Windows(const PlannedPaths& paths) {
    constexpr std::int64_t most = 4096;
    from_ns = paths[0].front().t_ns;
    to_ns = from_ns;
    std::size_t waypoints = 0;
    for (const auto& path : paths) {
      from_ns = std::min(from_ns, path.front().t_ns);
      to_ns = std::max(to_ns, path.back().t_ns);
      waypoints = std::max(waypoints, path.size());
    }
    count = std::min(most, static_cast<std::int64_t>(waypoints));
    length_ns = (to_ns - from_ns) / count + 1;
  }
  std::int64_t begin(std::int64_t i) const { return from_ns + std::min(i * length_ns, to_ns - from_ns); }
  std::int64_t end(std::int64_t i) const { return i + 1 == count ? to_ns : begin(i + 1); }
};

// A pair of robots that may come near each other in a window.
struct Meeting {
  Pair robots;
  std::int64_t window;
  bool operator<(const Meeting& other) const { return std::tie(robots, window) < std::tie(other.robots, other.window); }
};

std::vector<Meeting> find_meetings(const PlannedPaths& paths, const std::vector<double>& radii_m,
                                   const Windows& windows) {
  const double largest_m = *std::max_element(radii_m.begin(), radii_m.end());
  std::vector<Meeting> meetings;
  std::vector<Box> boxes(paths.size());
  std::vector<Pair> pairs;
  for (std::int64_t i = 0; i < windows.count; ++i) {
    for (Robot robot = 0; robot < paths.size(); ++robot)
      boxes[robot] = box_of(paths[robot], robot, radii_m[robot], windows.begin(i), windows.end(i));
    list_overlaps(boxes, std::max(4.0 * largest_m, 0.5), pairs);
    for (const Pair& pair : pairs)
      if (std::max(paths[pair.first].back().t_ns, paths[pair.second].back().t_ns) >= windows.begin(i))
        meetings.push_back({pair, i});
  }
  std::sort(meetings.begin(), meetings.end());
  return meetings;
}

// Visits the intervals between waypoints of two robots, taken together in order of time, where a common time counts
// twice; the last interval has no length.
class Intervals {
 public:
  Intervals(const std::vector<dmrp_waypoint>& a, const std::vector<dmrp_waypoint>& b) : a_(a), b_(b) {}

  // Calls visit(from, to) for those that have not been visited and overlap the window.
  template <class Visit>
  void visit(std::int64_t window_from, std::int64_t window_to, Visit visit) {
    std::size_t i = waypoints_before(a_, window_from);
    std::size_t j = waypoints_before(b_, window_from);
    if (i + j > 0) (j == 0 || (i > 0 && a_[i - 1].t_ns >= b_[j - 1].t_ns) ? i : j) -= 1;
    while (i + j < a_.size() + b_.size()) {
      const std::int64_t from = take(i, j);
      if (from > window_to) return;
      std::size_t next_i = i;
      std::size_t next_j = j;
      const std::int64_t to = i + j < a_.size() + b_.size() ? take(next_i, next_j) : from;
      if (i + j <= visited_) continue;
      visited_ = i + j;
      visit(from, to);
    }
  }

 private:
  static std::size_t waypoints_before(const std::vector<dmrp_waypoint>& path, std::int64_t t_ns) {
    const auto first = std::lower_bound(path.begin(), path.end(), t_ns,
                                        [](const dmrp_waypoint& w, std::int64_t t) { return w.t_ns < t; });
    return static_cast<std::size_t>(first - path.begin());
  }
  // The earlier one of a_[i] and b_[j]; moves on behind it.
  std::int64_t take(std::size_t& i, std::size_t& j) const {
    if (j == b_.size() || (i < a_.size() && a_[i].t_ns <= b_[j].t_ns)) return a_[i++].t_ns;
    return b_[j++].t_ns;
  }

  const std::vector<dmrp_waypoint>& a_;
  const std::vector<dmrp_waypoint>& b_;
  std::size_t visited_ = 0;
};

}  // namespace

PlanConflicts find_step_conflicts(const std::vector<std::vector<PlanCell>>& cells, core::StepOverlaps& overlaps) {
  PlanConflicts found;
  if (cells.empty()) return found;
  std::size_t makespan = 0;
  PlanCell lower = cells[0][0];
  PlanCell upper = lower;
  for (const auto& path : cells) {
    makespan = std::max(makespan, path.size());
    for (const PlanCell cell : path) {
      lower = {std::min(lower.column, cell.column), std::min(lower.row, cell.row)};
      upper = {std::max(upper.column, cell.column), std::max(upper.row, cell.row)};
    }
  }
  Positions even(cells, lower, upper);
  Positions odd(cells, lower, upper);
  std::vector<Pair> pairs;
  Pair first_pair{std::numeric_limits<Robot>::max(), 0};
  const auto note = [&](Pair pair, std::size_t step, const auto& describe) {
    ++found.count;
    if (pair >= first_pair) return;
    first_pair = pair;
    found = {found.count, describe(), pair.first, std::min(step, cells[pair.first].size() - 1)};
  };

  even.fill(0);
  for (Robot robot = 0; robot < cells.size(); ++robot)
    even.visit(cells[robot][0], [&](Robot other) {
      if (other > robot)
        note({robot, other}, 0, [&] { return fmt::format("robots {} and {} share a start", robot, other); });
    });
  for (std::size_t step = 0; step + 1 < makespan; ++step) {
    const Positions& now = step % 2 == 0 ? even : odd;
    Positions& next = step % 2 == 0 ? odd : even;
    next.fill(step + 1);
    list_neighbours(cells, step, now, next, pairs);
    if (overlaps.are_possible()) list_near(cells, step, overlaps.reach_cells(), now, pairs);
    for (const Pair& pair : pairs) {
      const auto& a = cells[pair.first];
      const auto& b = cells[pair.second];
      const char* kind = conflict(at(a, step), at(a, step + 1), at(b, step), at(b, step + 1));
      if (!kind && overlaps.are_possible() &&
          overlaps.overlap(pair.first, at(a, step), at(a, step + 1), pair.second, at(b, step), at(b, step + 1)))
        kind = "footprint";
      if (kind)
        note(pair, step + 1, [&] {
          return fmt::format("{} conflict of robots {} and {} at step {}", kind, pair.first, pair.second, step + 1);
        });
    }
  }
  return found;
}

PlanConflicts find_disc_conflicts(const PlannedPaths& paths, const std::vector<double>& radii_m) {
  PlanConflicts found;
  if (paths.empty()) return found;
  const Windows windows(paths);
  const std::vector<Meeting> meetings = find_meetings(paths, radii_m, windows);
  for (std::size_t i = 0; i < meetings.size();) {
    const Pair robots = meetings[i].robots;
    const auto& a = paths[robots.first];
    const auto& b = paths[robots.second];
    const double clear_m = std::max(radii_m[robots.first] + radii_m[robots.second], points_meet_m) - tolerance_m;
    Intervals intervals(a, b);
    for (; i < meetings.size() && meetings[i].robots == robots; ++i)
      intervals.visit(
          windows.begin(meetings[i].window), windows.end(meetings[i].window), [&](std::int64_t from, std::int64_t to) {
            const double distance_m =
                least_distance(position(a, from), position(a, to), position(b, from), position(b, to));
            if (!(distance_m < clear_m) || found.count++ > 0) return;
            found.first = fmt::format("robots {} and {} come within {:.3f} m of each other at {:.2f} s", robots.first,
                                      robots.second, distance_m, static_cast<double>(from) * 1e-9);
            found.robot = robots.first;
            found.waypoint = std::min(waypoints_until(a, from), a.size() - 1);
          });
  }
  return found;
}

}  // namespace dmrp::host
