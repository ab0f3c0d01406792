// SPDX-License-Identifier: MIT
#include "host/maps/drawn_tasks.hpp"

#include <fmt/format.h>

#include <dmrp/toolkit/random.hpp>

#include "host/errors/input_error.hpp"

namespace dmrp::host {

namespace {

// By cell: the number of its connected part; -1 for a blocked cell.
std::vector<std::int32_t> connected_parts(const core::CellMap& map) {
  std::vector<std::int32_t> part_of(map.free.size(), -1);
  std::vector<std::uint32_t> queue;
  std::int32_t parts = 0;
  for (std::uint32_t first = 0; first < map.free.size(); ++first) {
    if (!map.free[first] || part_of[first] >= 0) continue;
    queue.assign(1, first);
    part_of[first] = parts;
    for (std::size_t next = 0; next < queue.size(); ++next) {
      const auto enter = [&](std::uint32_t cell) {
        if (!map.free[cell] || part_of[cell] >= 0) return;
        part_of[cell] = parts;
        queue.push_back(cell);
      };
      const std::uint32_t cell = queue[next];
      if (cell % map.width > 0) enter(cell - 1);
      if (cell % map.width + 1 < map.width) enter(cell + 1);
      if (cell >= map.width) enter(cell - map.width);
      if (cell + map.width < map.free.size()) enter(cell + map.width);
    }
    ++parts;
  }
  return part_of;
}

}  // namespace

std::vector<MovingAiTask> draw_tasks(const core::CellMap& map, const std::string& shown_path, std::uint32_t count,
                                     std::uint64_t seed) {
  std::vector<std::uint32_t> starts;
  for (std::uint32_t cell = 0; cell < map.free.size(); ++cell)
    if (map.free[cell]) starts.push_back(cell);
  if (count > starts.size())
    throw InputError(fmt::format("--draw {}: {} has {} free cells", count, shown_path, starts.size()));
  std::vector<std::uint32_t> goals = starts;
  toolkit::Stream random(seed, "plan.tasks");
  random.shuffle(starts);
  random.shuffle(goals);

  // each start takes the first goal left in its part, and a part has as many goals as starts
  const std::vector<std::int32_t> part_of = connected_parts(map);
  std::vector<std::vector<std::uint32_t>> goals_of(starts.size());
  for (auto goal = goals.rbegin(); goal != goals.rend(); ++goal)
    goals_of[static_cast<std::size_t>(part_of[*goal])].push_back(*goal);
  const auto in_file = [&map](std::uint32_t cell) {
    return MovingAiCell{cell % map.width, map.height - 1 - cell / map.width};
  };
  std::vector<MovingAiTask> tasks;
  for (std::uint32_t i = 0; i < count; ++i) {
    std::vector<std::uint32_t>& left = goals_of[static_cast<std::size_t>(part_of[starts[i]])];
    tasks.push_back({in_file(starts[i]), in_file(left.back()), 0});
    left.pop_back();
  }
  return tasks;
}

}  // namespace dmrp::host
