// SPDX-License-Identifier: MIT
#include "host/plans/plan_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "host/errors/input_error.hpp"
#include "host/files/read_file.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view cells_header = "agent,t,x,y";
constexpr std::string_view task_column = "task,";
constexpr std::uintmax_t most_csv_bytes = std::uintmax_t{1} << 34;
constexpr double latest_ns = 9e18;
constexpr double same_place_m = 1e-6;

// The goals of a robot that gives none: it heads for each in turn, from the waypoint behind that at the one before.
void head_for_goals(const dmrp_planning_robot& robot, std::vector<dmrp_waypoint>& path) {
  std::uint32_t reached = 0;
  for (dmrp_waypoint& w : path) {
    w.goal_index = robot.first_goal_index + reached;
    const dmrp_pose& goal = DMRP_AT(dmrp_goal, robot.goals, robot.goal_stride, reached)->pose;
    const bool is_at_goal = std::hypot(w.x - goal.x, w.y - goal.y) <= same_place_m;
    if (is_at_goal && reached + 1 < robot.goal_count) ++reached;
  }
}

}  // namespace

class PlanFile::RowReader {
 public:
  RowReader(const PlanFile& file, std::size_t number)
      : lines_(file.lines_), number_(number), rest_(file.lines_.line(number)) {
    if (file.has_tasks_) task_ = take();
  }

  std::string_view task() const { return task_; }

  template <class Number>
  Number next(const char* column) {
    Number value{};
    const std::string_view text = take();
    const char* const end = text.data() + text.size();
    if (const auto read = std::from_chars(text.data(), end, value); read.ec != std::errc() || read.ptr != end)
      fail(fmt::format("{} must be a {}, not '{}'", column, std::is_integral_v<Number> ? "whole number" : "number",
                       text));
    return value;
  }

  double heading() {
    if (rest_.starts_with(',')) return take(), core::free_heading;
    return next<double>("theta");
  }

  void end() {
    const std::string_view header = lines_.line(1);
    if (fields_ != std::count(header.begin(), header.end(), ',') + 1 || more_)
      fail(fmt::format("a row has the values {}", header));
  }

  [[noreturn]] void fail(const std::string& text) const { lines_.fail(number_, column_, text); }

 private:
  std::string_view take() {
    column_ = static_cast<std::size_t>(rest_.data() - lines_.line(number_).data()) + 1;
    const std::size_t end = std::min(rest_.find(','), rest_.size());
    const std::string_view text = rest_.substr(0, end);
    more_ = end < rest_.size();
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++fields_;
    return text;
  }

  const TextLines& lines_;
  std::size_t number_;
  std::string_view rest_;
  std::string_view task_;
  std::size_t column_ = 1;
  bool more_ = false;
  std::ptrdiff_t fields_ = 0;
};

PlanFile::PlanFile(const fs::path& file) : lines_(read_file(file, shown(file), most_csv_bytes), shown(file)) {
  std::string_view header = lines_.line(1);
  has_tasks_ = header.starts_with(task_column);
  if (has_tasks_) header.remove_prefix(task_column.size());
  in_cells_ = header == cells_header;
  if (!in_cells_ && header != stored_plan_header)
    lines_.fail(1, 1,
                fmt::format("the first line must be '{}' (metres) or '{}' (cells), with 'task,' before it where the "
                            "file has the plans of several tasks",
                            stored_plan_header, cells_header));
  find_tasks();
}

void PlanFile::find_tasks() {
  if (!has_tasks_) {
    tasks_[""] = {2, lines_.count() + 1};
    return;
  }
  std::string_view before;
  for (std::size_t number = 2; number <= lines_.count(); ++number) {
    const RowReader row(*this, number);
    const std::string_view task = row.task();
    if (task.size() != 16 || task.find_first_not_of("0123456789abcdef") != std::string_view::npos)
      row.fail(fmt::format("task must be 16 hexadecimal digits, as in trials.csv, not '{}'", task));
    const auto [known, is_new] = tasks_.try_emplace(std::string(task), Rows{number, number});
    if (!is_new && task != before) row.fail(fmt::format("the rows of task {} must be together", task));
    known->second.end = number + 1;
    before = task;
  }
}

PlannedPaths PlanFile::read(Rows rows, const std::function<dmrp_waypoint(RowReader& row)>& waypoint) const {
  const char* const column = in_cells_ ? "agent" : "robot";
  PlannedPaths paths;
  for (std::size_t number = rows.begin; number < rows.end; ++number) {
    RowReader row(*this, number);
    const auto robot = row.next<std::size_t>(column);
    if (robot != paths.size() && robot + 1 != paths.size())
      row.fail(
          fmt::format("{} must be {}, or the next one, not {}", column, paths.empty() ? 0 : paths.size() - 1, robot));
    if (robot == paths.size()) paths.emplace_back();
    paths.back().push_back(waypoint(row));
    row.end();
  }
  return paths;
}

PlannedPaths PlanFile::paths(const std::string& task, const dmrp_planning_problem& problem) const {
  const auto in_metres = [](RowReader& row) {
    dmrp_waypoint w{};
    w.t_ns = row.next<std::int64_t>("t_ns");
    w.x = row.next<double>("x");
    w.y = row.next<double>("y");
    w.theta = row.heading();
    w.goal_index = row.next<std::uint32_t>("goal_index");
    return w;
  };
  if (!in_cells_) return read(rows_of(task), in_metres);
  const auto in_cells = [&](RowReader& row) {
    const dmrp_grid& grid = *problem.grid;
    dmrp_waypoint w{};
    const double after_ns = row.next<double>("t") * static_cast<double>(problem.step_duration_ns);
    if (!(std::abs(after_ns) <= latest_ns - static_cast<double>(problem.effective_from_ns)))
      row.fail("t is beyond all trials");
    w.t_ns = problem.effective_from_ns + std::llround(after_ns);
    w.x = grid.origin.x + (row.next<double>("x") + 0.5) * grid.resolution_m;
    w.y = grid.origin.y + (grid.height - 1.0 - row.next<double>("y") + 0.5) * grid.resolution_m;
    w.theta = core::free_heading;
    return w;
  };
  PlannedPaths paths = read(rows_of(task), in_cells);
  for (std::size_t i = 0; i < std::min<std::size_t>(paths.size(), problem.robot_count); ++i)
    head_for_goals(*DMRP_AT(dmrp_planning_robot, problem.robots, problem.robot_stride, i), paths[i]);
  return paths;
}

PlannedPaths PlanFile::stored_paths() const {
  if (has_tasks_ || in_cells_) lines_.fail(1, 1, fmt::format("the first line must be '{}'", stored_plan_header));
  return paths("", {});
}

void PlanFile::fail(const std::string& task, std::size_t robot, std::size_t waypoint, const std::string& text) const {
  const Rows rows = rows_of(task);
  std::size_t at = std::max<std::size_t>(rows.end, 2) - 1;
  for (std::size_t number = rows.begin; number < rows.end; ++number)
    if (RowReader row(*this, number); row.next<std::size_t>("robot") == robot && waypoint-- == 0) {
      at = number;
      break;
    }
  lines_.fail(at, 1, text);
}

PlannerAnswer PlansOfFiles::answer(std::uint32_t repetition, const std::string& task,
                                   const dmrp_planning_problem& problem) {
  PlannerAnswer answer;
  answer.processor_ns = -1;  // nobody planned
  const fs::path path = files_.of(repetition);
  if (path.empty()) {
    answer.text = fmt::format("{}: there is no file of repetition {}", shown(files_.name), repetition);
    return answer;
  }
  if (path != path_) file_ = std::make_unique<PlanFile>(path);
  path_ = path;
  if (!file_->holds(task)) {
    answer.text = fmt::format("{}: holds no plan of task {}", shown(path), task);
    return answer;
  }
  answer.status = DMRP_OK;
  answer.paths = file_->paths(task, problem);
  return answer;
}

}  // namespace dmrp::host
