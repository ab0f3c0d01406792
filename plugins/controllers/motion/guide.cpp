// SPDX-License-Identifier: MIT
#include "controllers/motion/guide.hpp"

#include <algorithm>
#include <cassert>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers {

namespace {

constexpr std::uint8_t easy_effort = 1;
constexpr std::uint8_t close_effort = 2;
constexpr std::uint8_t escape_effort = 6;

// Within this distance of the robot, cells too close to an obstacle are passable.
constexpr double escape_m = 0.4;

constexpr std::int32_t straight_cost = 5;
constexpr std::int32_t diagonal_cost = 7;

struct Step {
  std::int32_t columns;
  std::int32_t rows;
  std::int32_t cost;
};
constexpr std::array<Step, 8> steps = {{{1, 0, straight_cost},
                                        {0, 1, straight_cost},
                                        {-1, 0, straight_cost},
                                        {0, -1, straight_cost},
                                        {1, 1, diagonal_cost},
                                        {-1, 1, diagonal_cost},
                                        {-1, -1, diagonal_cost},
                                        {1, -1, diagonal_cost}}};

// The path keeps one point per this many cells.
constexpr std::size_t cells_per_point = 4;

}  // namespace

void Guide::read(const CostmapView& map, Vec2 robot, double needed_m, double easy_m, Efforts& efforts) {
  const std::uint8_t highest = map.highest_cost_at(needed_m);
  const std::uint8_t highest_easy = map.highest_cost_at(easy_m);
  const auto cells = static_cast<std::size_t>(map.width()) * static_cast<std::size_t>(map.height());
  efforts.resize(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    const std::uint8_t cost = map.costs()[i];
    efforts[i] = cost > highest ? 0 : cost > highest_easy ? close_effort : easy_effort;
  }
  const std::int32_t reach = static_cast<std::int32_t>(escape_m / map.resolution_m());
  const std::int32_t column = map.column_of(robot.x);
  const std::int32_t row = map.row_of(robot.y);
  for (std::int32_t r = row - reach; r <= row + reach; ++r) {
    for (std::int32_t c = column - reach; c <= column + reach; ++c) {
      if (!map.contains(c, r)) continue;
      const auto i = static_cast<std::size_t>(r * map.width() + c);
      if (efforts[i] == 0 && map.costs()[i] < DMRP_COST_LETHAL) efforts[i] = escape_effort;
    }
  }
}

void Guide::spread(const CostmapView& map, Vec2 robot, double needed_m, double easy_m) {
  read(map, robot, needed_m, easy_m, efforts_);
  costs_.assign(efforts_.size(), unreached);
  from_.assign(efforts_.size(), -1);
  for (std::vector<std::int32_t>& bucket : buckets_) bucket.clear();
  const std::int32_t start = map.index_of(robot);
  if (start < 0) return;
  costs_[static_cast<std::size_t>(start)] = 0;
  buckets_[0].push_back(start);
  std::size_t queued = 1;
  for (std::int32_t now = 0; queued > 0; ++now) {
    std::vector<std::int32_t>& bucket = buckets_[static_cast<std::size_t>(now) % bucket_count];
    for (const std::int32_t cell : bucket) {
      if (costs_[static_cast<std::size_t>(cell)] != now) continue;  // reached at a lower cost since
      const std::int32_t column = cell % map.width();
      const std::int32_t row = cell / map.width();
      for (const Step& step : steps) {
        if (!map.contains(column + step.columns, row + step.rows)) continue;
        const std::int32_t next = cell + step.rows * map.width() + step.columns;
        const auto to = static_cast<std::size_t>(next);
        if (efforts_[to] == 0) continue;
        const std::int32_t cost = now + step.cost * efforts_[to];
        if (cost >= costs_[to]) continue;
        costs_[to] = cost;
        from_[to] = cell;
        buckets_[static_cast<std::size_t>(cost) % bucket_count].push_back(next);
        ++queued;
      }
    }
    queued -= bucket.size();
    bucket.clear();
  }
}

bool Guide::connects(const CostmapView& map, Vec2 robot, Vec2 point, double needed_m) {
  read(map, robot, needed_m, needed_m, unfilled_);
  const std::int32_t start = map.index_of(robot);
  const std::int32_t end = map.index_of(point);
  if (start < 0 || end < 0 || unfilled_[static_cast<std::size_t>(end)] == escape_effort) return false;
  if (start == end) return true;
  if (unfilled_[static_cast<std::size_t>(end)] == 0) return false;
  // fills from the robot; a cell that has been filled counts as blocked
  filled_.reserve(unfilled_.size());
  filled_.assign(1, start);
  unfilled_[static_cast<std::size_t>(start)] = 0;
  while (!filled_.empty()) {
    const std::int32_t cell = filled_.back();
    filled_.pop_back();
    const std::int32_t column = cell % map.width();
    const std::int32_t row = cell / map.width();
    for (const Step& step : steps) {
      if (!map.contains(column + step.columns, row + step.rows)) continue;
      const std::int32_t next = cell + step.rows * map.width() + step.columns;
      if (next == end) return true;
      std::uint8_t& effort = unfilled_[static_cast<std::size_t>(next)];
      if (effort == 0) continue;
      effort = 0;
      filled_.push_back(next);
    }
  }
  return false;
}

bool Guide::reaches(const CostmapView& map, Vec2 point) const {
  assert(costs_.size() == static_cast<std::size_t>(map.width()) * static_cast<std::size_t>(map.height()));
  const std::int32_t index = map.index_of(point);
  return index >= 0 && costs_[static_cast<std::size_t>(index)] != unreached &&
         efforts_[static_cast<std::size_t>(index)] != escape_effort;
}

void Guide::path_to(const CostmapView& map, Vec2 point, std::vector<Vec2>& points) const {
  assert(reaches(map, point));
  points.clear();
  points.push_back(point);
  std::int32_t cell = from_[static_cast<std::size_t>(map.index_of(point))];
  for (std::size_t i = 1; cell >= 0; ++i) {
    if (i % cells_per_point == 0) points.push_back(map.center(cell % map.width(), cell / map.width()));
    cell = from_[static_cast<std::size_t>(cell)];
  }
  std::reverse(points.begin(), points.end());
  // smooths the grid's eight directions
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
      points[i] = 0.25 * points[i - 1] + 0.5 * points[i] + 0.25 * points[i + 1];
}

}  // namespace dmrp::controllers
