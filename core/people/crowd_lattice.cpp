// SPDX-License-Identifier: MIT
#include "core/people/crowd_lattice.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>
#include <numbers>
#include <numeric>
#include <utility>

namespace dmrp::core {
namespace {

constexpr double narrowing = 0.98;  // factor on the lattice spacing between two tries
constexpr int tries_to_move = 8;
constexpr double longest_link = 1.5;  // between members, in lattice spacings

// The points of the lattice in the rectangle that have room; `phase` in [0, 1) shifts the first row and column.
std::vector<dmrp_vec2> lattice_points(const toolkit::Rectangle& where, double spacing_m, dmrp_vec2 phase,
                                      const std::function<bool(dmrp_vec2)>& has_room) {
  const double row_m = 0.5 * std::sqrt(3.0) * spacing_m;
  std::vector<dmrp_vec2> points;
  bool shifted = false;
  for (double y = where.lower.y + phase.y * row_m; y <= where.upper.y; y += row_m, shifted = !shifted) {
    double x = where.lower.x + phase.x * spacing_m - (shifted ? 0.5 * spacing_m : 0.0);
    if (x < where.lower.x) x += spacing_m;
    for (; x <= where.upper.x; x += spacing_m)
      if (has_room({x, y})) points.push_back({x, y});
  }
  return points;
}

void shuffle(std::vector<dmrp_vec2>& points, toolkit::Stream& stream) {
  for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[stream.below(i)]);
}

// A random free point at most `reach_m` away; the point itself if none was found.
dmrp_vec2 jittered(dmrp_vec2 point, double reach_m, const toolkit::Rectangle& where, toolkit::Stream& stream,
                   const std::function<bool(dmrp_vec2)>& has_room) {
  for (int tries = 0; tries < tries_to_move; ++tries) {
    const double radius_m = reach_m * std::sqrt(stream.uniform());
    const dmrp_vec2 there = point + radius_m * toolkit::from_angle(stream.uniform(0.0, 2.0 * std::numbers::pi));
    if (toolkit::contains(where, there) && has_room(there)) return there;
  }
  return point;
}

// A sequence of neighbouring points.
using Chain = std::vector<dmrp_vec2>;
using Places = std::vector<std::vector<dmrp_vec2>>;

// The points row by row in alternating directions, split where successive points are too far apart or not in sight.
std::vector<Chain> chains_of(std::vector<dmrp_vec2> points, double spacing_m, const GroupSpread& spread) {
  bool backward = false;
  for (auto row = points.begin(); row != points.end(); backward = !backward) {
    const auto end = std::find_if(row, points.end(), [&](dmrp_vec2 point) { return point.y != row->y; });
    if (backward) std::reverse(row, end);
    row = end;
  }
  std::vector<Chain> chains;
  for (const dmrp_vec2 point : points) {
    if (chains.empty() || toolkit::distance(chains.back().back(), point) > longest_link * spacing_m ||
        !spread.in_sight(chains.back().back(), point))
      chains.emplace_back();
    chains.back().push_back(point);
  }
  return chains;
}

// Places each group, in this order, at random in its share of the points. Returns nothing if the points run out, which
// the ends of chains can cause.
Places place_evenly(const std::vector<Chain>& chains, const std::vector<std::uint32_t>& sizes,
                    const std::vector<std::size_t>& order, toolkit::Stream& stream) {
  const auto sum = [](std::size_t all, const auto& one) { return all + one; };
  const std::size_t people = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0}, sum);
  std::size_t spare = 0;
  for (const Chain& chain : chains) spare += chain.size();
  if (spare < people) return {};
  spare -= people;
  Places places(sizes.size());
  std::size_t placed = 0;
  std::size_t skipped = 0;
  std::size_t chain = 0;
  std::size_t next = 0;  // point of the chain
  for (const std::size_t group : order) {
    placed += sizes[group];
    const std::size_t share = spare * placed / people;
    std::size_t skip = share > skipped ? stream.below(share - skipped + 1) : 0;
    skipped += skip;
    while (chain < chains.size() && next + skip + sizes[group] > chains[chain].size()) {
      const std::size_t rest = chains[chain].size() - next;
      skipped += rest - std::min(rest, skip);
      skip -= std::min(rest, skip);
      next = 0;
      ++chain;
    }
    if (chain == chains.size()) return {};
    const auto first = chains[chain].begin() + static_cast<std::ptrdiff_t>(next + skip);
    places[group].assign(first, first + static_cast<std::ptrdiff_t>(sizes[group]));
    next += skip + sizes[group];
  }
  return places;
}

// First fit in order of decreasing size. Groups without room stay empty.
Places pack(const std::vector<Chain>& chains, const std::vector<std::uint32_t>& sizes, std::vector<std::size_t> order) {
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
  std::vector<std::size_t> used(chains.size(), 0);
  Places places(sizes.size());
  for (const std::size_t group : order)
    for (std::size_t chain = 0; chain < chains.size() && places[group].empty(); ++chain) {
      if (used[chain] + sizes[group] > chains[chain].size()) continue;
      const auto first = chains[chain].begin() + static_cast<std::ptrdiff_t>(used[chain]);
      places[group].assign(first, first + static_cast<std::ptrdiff_t>(sizes[group]));
      used[chain] += sizes[group];
    }
  return places;
}

dmrp_vec2 transposed(dmrp_vec2 point) {
  return {point.y, point.x};
}

}  // namespace

std::vector<dmrp_vec2> spread_on_lattice(const toolkit::Rectangle& where, std::size_t count, double apart_m,
                                         toolkit::Stream& stream, const std::function<bool(dmrp_vec2)>& has_room) {
  assert(toolkit::is_ordered(where) && apart_m > 0.0);
  if (count == 0) return {};
  const double x_phase = stream.uniform();
  const dmrp_vec2 phase = {x_phase, stream.uniform()};
  const dmrp_vec2 extent = where.upper - where.lower;
  // the spacing at which an empty region has as many points as people
  double spacing_m =
      std::max(apart_m, std::sqrt(2.0 * extent.x * extent.y / (std::sqrt(3.0) * static_cast<double>(count))));
  std::vector<dmrp_vec2> points = lattice_points(where, spacing_m, phase, has_room);
  while (points.size() < count && spacing_m > apart_m) {
    spacing_m = std::max(apart_m, narrowing * spacing_m);
    points = lattice_points(where, spacing_m, phase, has_room);
  }
  shuffle(points, stream);
  points.resize(std::min(points.size(), count));
  for (dmrp_vec2& point : points) point = jittered(point, 0.5 * (spacing_m - apart_m), where, stream, has_room);
  return points;
}

std::vector<std::vector<dmrp_vec2>> spread_groups_on_lattice(const toolkit::Rectangle& where,
                                                             const std::vector<std::uint32_t>& sizes,
                                                             toolkit::Stream& stream, const GroupSpread& spread) {
  assert(toolkit::is_ordered(where) && spread.apart_m > 0.0 && spread.apart_in_group_m >= spread.apart_m);
  if (!spread.rows_along_x) {
    GroupSpread turned = spread;
    turned.rows_along_x = true;
    turned.has_room = [&](dmrp_vec2 point) { return spread.has_room(transposed(point)); };
    turned.in_sight = [&](dmrp_vec2 a, dmrp_vec2 b) { return spread.in_sight(transposed(a), transposed(b)); };
    Places places = spread_groups_on_lattice({transposed(where.lower), transposed(where.upper)}, sizes, stream, turned);
    for (auto& group : places) std::transform(group.begin(), group.end(), group.begin(), transposed);
    return places;
  }
  const double x_phase = stream.uniform();
  const dmrp_vec2 phase = {x_phase, stream.uniform()};
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  stream.shuffle(order);
  const auto is_empty = [](const std::vector<dmrp_vec2>& group) { return group.empty(); };
  double spacing_m = spread.apart_in_group_m;
  Places places;
  for (;;) {
    const auto chains = chains_of(lattice_points(where, spacing_m, phase, spread.has_room), spacing_m, spread);
    places = place_evenly(chains, sizes, order, stream);
    if (!places.empty()) break;
    places = pack(chains, sizes, order);
    if (spacing_m <= spread.apart_m || std::none_of(places.begin(), places.end(), is_empty)) break;
    spacing_m = std::max(spread.apart_m, narrowing * spacing_m);
  }
  for (auto& group : places)
    for (dmrp_vec2& point : group)
      point = jittered(point, 0.5 * (spacing_m - spread.apart_m), where, stream, spread.has_room);
  return places;
}

}  // namespace dmrp::core
