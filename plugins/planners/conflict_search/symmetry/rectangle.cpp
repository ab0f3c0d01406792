// SPDX-License-Identifier: MIT
#include "planners/conflict_search/symmetry/rectangle.hpp"

#include <algorithm>
#include <limits>

namespace dmrp::planners {

namespace {

struct Step {
  std::int32_t columns;
  std::int32_t rows;
};

struct Coordinates {
  std::int32_t u;
  std::int32_t w;
};

// The coordinates of one agent: u along its own step into the conflict, w along the other agent's.
struct Frame {
  const GridGraph* graph;
  Location origin;
  std::int32_t t;  // of the conflict
  Step along_u;
  Step along_w;

  Coordinates at(Location location) const {
    const std::int32_t columns = graph->column(location) - graph->column(origin);
    const std::int32_t rows = graph->row(location) - graph->row(origin);
    return {columns * along_u.columns + rows * along_u.rows, columns * along_w.columns + rows * along_w.rows};
  }
  Location location(Coordinates c) const {
    return graph->at(graph->column(origin) + c.u * along_u.columns + c.w * along_w.columns,
                     graph->row(origin) + c.u * along_u.rows + c.w * along_w.rows);
  }
  std::int32_t time(Coordinates c) const { return t + c.u + c.w; }
  bool in_phase(Coordinates c, std::int32_t time_there) const { return time(c) == time_there; }

  // The frame of the other agent, whose step into the conflict is perpendicular to this agent's.
  Frame of_the_other() const { return {graph, origin, t, along_w, along_u}; }
};

constexpr std::int32_t none = std::numeric_limits<std::int32_t>::min() / 2;

// The nodes of an MDD at one time.
struct FrontNode {
  Location location;
  bool pure;                  // in phase, like all its ancestors since the separation
  bool is_entry;              // has a parent in the column before
  std::int32_t least_column;  // the least, over all ways here, of the highest column reached while pure; or none
  bool operator<(const FrontNode& other) const { return location < other.location; }
};
using Front = std::vector<FrontNode>;

const FrontNode* find(const Front& front, Location location) {
  const auto at = std::lower_bound(front.begin(), front.end(), FrontNode{location, false, false, none});
  return at != front.end() && at->location == location ? &*at : nullptr;
}

// A candidate for a barrier of an agent: the pure nodes with one u, by ascending w.
struct Column {
  std::vector<std::int32_t> rows;
  std::int32_t highest_entry = none;  // row of the last entry from the column before, over all MDD paths
  std::int32_t entry_of_path = 0;     // row in which the current path enters

  std::int32_t count_up_to(std::int32_t row) const {
    return static_cast<std::int32_t>(std::upper_bound(rows.begin(), rows.end(), row) - rows.begin());
  }
};

// The way of one agent through the rectangle: columns from 0 on, as far as the current path is pure.
struct Crossing {
  std::vector<Column> columns;
  std::int32_t crossed_by_all = none;  // all MDD paths cross the columns up to this one while pure

  // Whether all MDD paths meet the barrier at this column and up to this row.
  bool is_closed_by(std::int32_t column, std::int32_t row) const {
    return column <= crossed_by_all && columns[static_cast<std::size_t>(column)].highest_entry <= row;
  }
};

bool has_one_leg(const Mdd& mdd) {
  return mdd.level(mdd.cost()).front().leg == 0;
}

bool holds(std::span<const Mdd::Node> level, Location location) {
  return std::any_of(level.begin(), level.end(), [&](const Mdd::Node& node) { return node.location == location; });
}

Step last_step(const GridGraph& graph, PathView path, std::int32_t t) {
  const Location from = path[static_cast<std::size_t>(t - 1)];
  const Location to = path[static_cast<std::size_t>(t)];
  return {graph.column(to) - graph.column(from), graph.row(to) - graph.row(from)};
}

// The frame of conflict.a, if both agents step into the conflict at a right angle.
std::optional<Frame> frame_of(const GridGraph& graph, const Conflict& conflict, PathView path_a, PathView path_b) {
  const Step a = last_step(graph, path_a, conflict.t);
  const Step b = last_step(graph, path_b, conflict.t);
  const bool moved = (a.columns != 0 || a.rows != 0) && (b.columns != 0 || b.rows != 0);
  if (!moved || a.columns * b.columns + a.rows * b.rows != 0) return std::nullopt;
  return Frame{&graph, conflict.location, conflict.t, a, b};
}

// The highest u of the nodes in phase.
std::int32_t highest_u(const Frame& frame, std::span<const Mdd::Node> level, std::int32_t t) {
  std::int32_t highest = none;
  for (const Mdd::Node& node : level)
    if (const Coordinates c = frame.at(node.location); frame.in_phase(c, t)) highest = std::max(highest, c.u);
  return highest;
}

// The last time up to the conflict at which all nodes of a that are in phase are to the left of all such nodes of b.
// Nothing if the current paths are not in phase from then on.
std::optional<std::int32_t> find_separation(const Frame& frame, const Mdd& mdd_a, const Mdd& mdd_b, PathView path_a,
                                            PathView path_b) {
  const Frame frame_b = frame.of_the_other();
  for (std::int32_t t = frame.t; t >= 0; --t) {
    const auto at = static_cast<std::size_t>(t);
    if (!frame.in_phase(frame.at(path_a[at]), t) || !frame.in_phase(frame.at(path_b[at]), t)) return std::nullopt;
    // b's u is the rest of t after its w.
    const std::int32_t lowest_u_of_b = t - frame.t - highest_u(frame_b, mdd_b.level(t), t);
    if (highest_u(frame, mdd_a.level(t), t) <= lowest_u_of_b) return t;
  }
  return std::nullopt;
}

// The front at the time of the separation.
Front first_front(const Frame& frame, const Mdd& mdd, std::int32_t t) {
  Front front;
  for (const Mdd::Node& node : mdd.level(t)) {
    const Coordinates c = frame.at(node.location);
    const bool pure = frame.in_phase(c, t);
    front.push_back({node.location, pure, true, pure ? c.u : none});
  }
  return front;
}

// The front after `before`. Ignores that constraints forbid some steps: this can only make fewer nodes pure.
Front next_front(const GridGraph& graph, const Frame& frame, const Mdd& mdd, std::int32_t t, const Front& before) {
  Front front;
  const bool all_ways_are_known = t < mdd.cost() || !mdd.may_wait_at_end();
  for (const Mdd::Node& node : mdd.level(t)) {
    const Coordinates c = frame.at(node.location);
    FrontNode next{node.location, all_ways_are_known && frame.in_phase(c, t), false,
                   std::numeric_limits<std::int32_t>::max()};
    for (Direction d = 0; d <= GridGraph::direction_count; ++d) {
      const Location from = d == GridGraph::direction_count ? node.location : graph.predecessor(node.location, d);
      const FrontNode* parent = from == nowhere ? nullptr : find(before, from);
      if (parent == nullptr) continue;
      next.pure = next.pure && parent->pure;
      next.is_entry = next.is_entry || frame.at(from).u < c.u;
      next.least_column = std::min(next.least_column, parent->least_column);
    }
    if (next.pure) next.least_column = std::max(next.least_column, c.u);
    front.push_back(next);
  }
  return front;
}

// Adds the pure nodes of a front to their columns.
void add_front(const Frame& frame, const Front& front, Crossing& crossing) {
  for (const FrontNode& node : front) {
    const Coordinates c = frame.at(node.location);
    if (!node.pure || c.u < 0) continue;
    const auto at = static_cast<std::size_t>(c.u);
    if (at >= crossing.columns.size()) crossing.columns.resize(at + 1);
    Column& column = crossing.columns[at];
    column.rows.push_back(c.w);
    if (node.is_entry) column.highest_entry = c.w;
  }
}

Crossing make_crossing(const GridGraph& graph, const Frame& frame, const Mdd& mdd, PathView path, std::int32_t from) {
  Crossing crossing;
  Front before;
  std::size_t columns_of_path = 0;
  bool path_is_pure = true;
  for (std::int32_t t = from; t <= mdd.cost(); ++t) {
    Front front = t == from ? first_front(frame, mdd, t) : next_front(graph, frame, mdd, t, before);
    std::sort(front.begin(), front.end());
    add_front(frame, front, crossing);

    const auto at = std::min(static_cast<std::size_t>(t), path.size() - 1);
    const FrontNode* here = path_is_pure ? find(front, path[at]) : nullptr;
    path_is_pure = here != nullptr && here->pure;
    if (path_is_pure) {
      const Coordinates c = frame.at(path[at]);
      if (c.u == static_cast<std::int32_t>(columns_of_path)) crossing.columns[columns_of_path++].entry_of_path = c.w;
    }
    before = std::move(front);
    if (std::none_of(before.begin(), before.end(), [](const FrontNode& node) { return node.pure; })) break;
  }
  crossing.columns.resize(columns_of_path);
  crossing.crossed_by_all = std::min_element(before.begin(), before.end(), [](const FrontNode& a, const FrontNode& b) {
                              return a.least_column < b.least_column;
                            })->least_column;
  return crossing;
}

// The corner of the two barriers.
struct Corner {
  std::int32_t u = 0;
  std::int32_t w = 0;
  std::int32_t closed = -1;         // agents of which all MDD paths meet their barrier
  std::int32_t pairs_of_nodes = 0;  // one of each barrier
};

// The corner whose barriers raise the cost of most agents and, of these, the one that rules out most pairs of nodes.
// Both current paths meet their barriers.
Corner choose_corner(const Crossing& a, const Crossing& b) {
  Corner best;
  for (std::int32_t u = 0; u < static_cast<std::int32_t>(a.columns.size()); ++u)
    for (std::int32_t w = 0; w < static_cast<std::int32_t>(b.columns.size()); ++w) {
      const Column& column = a.columns[static_cast<std::size_t>(u)];
      const Column& row = b.columns[static_cast<std::size_t>(w)];
      if (column.entry_of_path > w || row.entry_of_path > u) continue;
      const Corner corner{u, w, (a.is_closed_by(u, w) ? 1 : 0) + (b.is_closed_by(w, u) ? 1 : 0),
                          column.count_up_to(w) * row.count_up_to(u)};
      if (corner.closed > best.closed || (corner.closed == best.closed && corner.pairs_of_nodes > best.pairs_of_nodes))
        best = corner;
    }
  return best;
}

std::vector<Constraint> barrier(const Frame& frame, std::int32_t agent, const Crossing& crossing, std::int32_t u,
                                std::int32_t up_to) {
  std::vector<Constraint> constraints;
  for (const std::int32_t w : crossing.columns[static_cast<std::size_t>(u)].rows)
    if (w <= up_to) constraints.push_back(avoid_vertex(agent, frame.location({u, w}), frame.time({u, w})));
  return constraints;
}

}  // namespace

std::optional<SymmetrySplit> find_rectangle(const GridGraph& graph, const Conflict& conflict, const Mdd& mdd_a,
                                            const Mdd& mdd_b, PathView path_a, PathView path_b) {
  const std::int32_t t = conflict.t;
  if (conflict.from != nowhere || t == 0 || t > cost_of(path_a) || t > cost_of(path_b) || t > mdd_a.cost() ||
      t > mdd_b.cost())
    return std::nullopt;
  const std::optional<Frame> frame = frame_of(graph, conflict, path_a, path_b);
  if (!frame || !has_one_leg(mdd_a) || !has_one_leg(mdd_b)) return std::nullopt;
  if (!holds(mdd_a.level(t), conflict.location) || !holds(mdd_b.level(t), conflict.location)) return std::nullopt;
  const std::optional<std::int32_t> separation = find_separation(*frame, mdd_a, mdd_b, path_a, path_b);
  if (!separation) return std::nullopt;

  const Frame frame_b = frame->of_the_other();
  const Crossing a = make_crossing(graph, *frame, mdd_a, path_a, *separation);
  const Crossing b = make_crossing(graph, frame_b, mdd_b, path_b, *separation);
  if (a.columns.empty() || b.columns.empty()) return std::nullopt;
  const Corner corner = choose_corner(a, b);
  if (corner.pairs_of_nodes <= 1) return std::nullopt;
  return SymmetrySplit{
      {barrier(*frame, conflict.a, a, corner.u, corner.w), barrier(frame_b, conflict.b, b, corner.w, corner.u)},
      {a.is_closed_by(corner.u, corner.w), b.is_closed_by(corner.w, corner.u)}};
}

}  // namespace dmrp::planners
