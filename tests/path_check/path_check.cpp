// SPDX-License-Identifier: MIT
#include "tests/path_check/path_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace dmrp::test {

namespace {

using Place = std::pair<int, int>;  // x, y from the upper left
using Path = std::vector<Place>;

std::string text_of(Place place) {
  return "(" + std::to_string(place.first) + ", " + std::to_string(place.second) + ")";
}

class Rows {
 public:
  explicit Rows(const std::string& file) {
    std::ifstream in(file);
    if (!in) throw std::runtime_error(file + " cannot be opened");
    std::string line;
    while (std::getline(in, line) && line.rfind("map", 0) != 0) {
    }
    while (std::getline(in, line))
      if (!line.empty()) rows_.push_back(line);
  }
  bool free(Place place) const {
    const auto [x, y] = place;
    if (x < 0 || y < 0 || y >= static_cast<int>(rows_.size())) return false;
    const std::string& row = rows_[static_cast<std::size_t>(y)];
    if (x >= static_cast<int>(row.size())) return false;
    const char letter = row[static_cast<std::size_t>(x)];
    return letter == '.' || letter == 'G' || letter == 'S';
  }

 private:
  std::vector<std::string> rows_;
};

std::vector<std::pair<Place, Place>> read_tasks(const std::string& file, int agents) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);  // version
  std::vector<std::pair<Place, Place>> tasks;
  while (static_cast<int>(tasks.size()) < agents && std::getline(in, line)) {
    std::istringstream fields(line);
    std::string bucket, map, width, height;
    std::pair<Place, Place> task;
    if (fields >> bucket >> map >> width >> height >> task.first.first >> task.first.second >> task.second.first >>
        task.second.second)
      tasks.push_back(task);
  }
  if (static_cast<int>(tasks.size()) < agents) throw std::runtime_error(file + " has too few tasks");
  return tasks;
}

// Agents in ascending order, each with times from 0 without a gap.
std::vector<Path> read_paths(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line) || line != "agent,t,x,y")
    throw std::runtime_error(file + " does not begin with agent,t,x,y");
  std::vector<Path> paths;
  while (std::getline(in, line)) {
    int agent = 0, t = 0, x = 0, y = 0, used = 0;
    if (std::sscanf(line.c_str(), "%d,%d,%d,%d%n", &agent, &t, &x, &y, &used) != 4 ||
        used != static_cast<int>(line.size()))
      throw std::runtime_error("not four whole numbers: " + line);
    if (agent == static_cast<int>(paths.size()) && t == 0) paths.emplace_back();
    if (agent + 1 != static_cast<int>(paths.size()) || t != static_cast<int>(paths.back().size()))
      throw std::runtime_error("out of order: " + line);
    paths.back().push_back({x, y});
  }
  return paths;
}

bool is_diagonal(Place from, Place to) {
  return from.first != to.first && from.second != to.second;
}

std::string check_move(const Rows& map, Place from, Place to, int connectivity) {
  if (!map.free(to)) return "enters the blocked cell " + text_of(to);
  if (std::abs(to.first - from.first) > 1 || std::abs(to.second - from.second) > 1)
    return "jumps from " + text_of(from) + " to " + text_of(to);
  if (!is_diagonal(from, to)) return "";
  if (connectivity == 4) return "moves diagonally to " + text_of(to);
  if (!map.free({from.first, to.second}) || !map.free({to.first, from.second}))
    return "cuts a corner on its way to " + text_of(to);
  return "";
}

std::string check_path(const Rows& map, const std::pair<Place, Place>& task, const Path& path, int connectivity) {
  if (path.front() != task.first) return "begins at " + text_of(path.front()) + ", not at " + text_of(task.first);
  if (path.back() != task.second) return "ends at " + text_of(path.back()) + ", not at " + text_of(task.second);
  if (!map.free(path.front())) return "begins on a blocked cell";
  for (std::size_t t = 1; t < path.size(); ++t)
    if (const std::string error = check_move(map, path[t - 1], path[t], connectivity); !error.empty())
      return "at step " + std::to_string(t) + " " + error;
  if (path.size() > 1 && path[path.size() - 2] == path.back()) return "goes on after it has come to rest";
  return "";
}

// The agent at each place at one time. Of two agents at one place, which conflict, it keeps the first.
using Standing = std::map<Place, std::size_t>;

class ConflictCount {
 public:
  ConflictCount(const std::vector<Path>& paths, PathVerdict& verdict) : paths_(paths), verdict_(verdict) {}

  void run() {
    for (std::size_t a = 0; a < paths_.size(); ++a) stand(now_, a, 0);
    for (long t = 0; t < verdict_.makespan; ++t) step(static_cast<std::size_t>(t));
  }

 private:
  Place place(std::size_t agent, std::size_t t) const {
    const Path& path = paths_[agent];
    return path[std::min(t, path.size() - 1)];
  }

  void note(const char* kind, std::size_t a, std::size_t b, std::size_t t) {
    if (verdict_.conflicts++ == 0)
      verdict_.first_conflict = std::string(kind) + " conflict of agents " + std::to_string(std::min(a, b)) + " and " +
                                std::to_string(std::max(a, b)) + " at step " + std::to_string(t);
  }

  void stand(Standing& standing, std::size_t agent, std::size_t t) {
    const auto [other, is_new] = standing.emplace(place(agent, t), agent);
    if (!is_new) note("vertex", other->second, agent, t);
  }

  void step(std::size_t t) {
    Standing next;
    for (std::size_t a = 0; a < paths_.size(); ++a) stand(next, a, t + 1);
    for (std::size_t a = 0; a < paths_.size(); ++a) {
      const Place from = place(a, t);
      const Place to = place(a, t + 1);
      const auto there = now_.find(to);
      if (there != now_.end() && there->second > a && place(there->second, t + 1) == from)
        note("swap", a, there->second, t + 1);
      if (is_diagonal(from, to)) check_sides(a, from, to, t, next);
    }
    now_ = std::move(next);
  }

  void check_sides(std::size_t a, Place from, Place to, std::size_t t, const Standing& next) {
    for (const Place& beside : {Place{from.first, to.second}, Place{to.first, from.second}})
      for (const Standing* standing : {static_cast<const Standing*>(&now_), &next}) {
        const auto other = standing->find(beside);
        if (other != standing->end() && other->second != a) note("passing", a, other->second, t + 1);
      }
  }

  const std::vector<Path>& paths_;
  PathVerdict& verdict_;
  Standing now_;
};

}  // namespace

double PathVerdict::cost() const {
  return static_cast<double>(straight) + std::sqrt(2.0) * static_cast<double>(diagonal);
}

PathVerdict check_paths(const std::string& map_file, const std::string& task_file, int agents, int connectivity,
                        const std::string& path_file) {
  PathVerdict verdict;
  try {
    const Rows map(map_file);
    const auto tasks = read_tasks(task_file, agents);
    const auto paths = read_paths(path_file);
    if (paths.size() != tasks.size())
      throw std::runtime_error(std::to_string(paths.size()) + " paths for " + std::to_string(agents) + " agents");
    for (std::size_t a = 0; a < paths.size(); ++a) {
      if (const std::string error = check_path(map, tasks[a], paths[a], connectivity); !error.empty())
        throw std::runtime_error("agent " + std::to_string(a) + " " + error);
      verdict.makespan = std::max(verdict.makespan, static_cast<long>(paths[a].size()) - 1);
      for (std::size_t t = 1; t < paths[a].size(); ++t)
        ++(is_diagonal(paths[a][t - 1], paths[a][t]) ? verdict.diagonal : verdict.straight);
    }
    ConflictCount(paths, verdict).run();
  } catch (const std::runtime_error& error) {
    verdict.error = error.what();
  }
  return verdict;
}

}  // namespace dmrp::test
