// SPDX-License-Identifier: MIT
// A planner for replanning and a controller for many paths; both check their inputs.
#include <dmrp/ext/annotate.h>

#include <algorithm>
#include <cmath>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/polyline.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace toolkit = dmrp::toolkit;

void expect(bool holds, const char* what) {
  if (!holds) throw std::logic_error(std::string("broken: ") + what);
}

constexpr double any_heading = std::numeric_limits<double>::quiet_NaN();

// Along x, one cell per step; each robot waits two steps in its first cell.
class AgainPlanner final : public dmrp::GlobalPlanner {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("test.planner.again", "Again", "1.0.0").connectivity(DMRP_CONNECTIVITY_4);
  }
  dmrp::Param<bool> once = param("once", false).doc("finds no plan but the first");

  dmrp::Status start(const dmrp::Start&) override {
    plans_ = 0;
    return dmrp::Status::ok;
  }

  dmrp::Status plan(const dmrp::PlanningProblem& problem, dmrp::PlanSink& sink) override {
    expect(problem.revision == plans_ + 1, "a revision is the next of the plan in force");
    expect(problem.now_ns <= problem.effective_from_ns && (problem.now_ns > 0) == (plans_ > 0), "now");
    expect(problem.in_force.size() == (plans_ == 0 ? 0 : problem.robots.size()), "the plan in force");
    for (std::uint32_t i = 0; i < problem.in_force.size(); ++i)
      expect(problem.in_force[i][0].t_ns < problem.now_ns, "the plan in force is older");
    if (once && plans_ > 0) return dmrp::Status::no_solution;
    for (std::uint32_t i = 0; i < problem.robots.size(); ++i) sink.path(i, path_of(problem, problem.robots[i]));
    ++plans_;
    return dmrp::Status::ok;
  }

 private:
  static std::vector<dmrp::Waypoint> path_of(const dmrp::PlanningProblem& problem, const dmrp::PlanningRobot& robot) {
    std::int64_t t_ns = problem.effective_from_ns;
    std::vector<dmrp::Waypoint> path = {{robot.start.x, robot.start.y, any_heading, t_ns, robot.first_goal_index, 0}};
    if (robot.state != DMRP_ROBOT_ACTIVE) return path;
    const auto add = [&](double x) {
      t_ns += problem.step_duration_ns;
      path.push_back({x, robot.start.y, any_heading, t_ns, robot.first_goal_index, 0});
    };
    for (int wait = 0; wait < 2; ++wait) add(robot.start.x);
    for (double x = robot.start.x + 1.0; x <= robot.goals()[0].pose.x + 1e-6; x += 1.0) add(x);
    return path;
  }

  std::uint64_t plans_ = 0;
};

// The command of a robot that follows a way: a turn to the carrot, and a speed at which it stops in time.
void drive_to(dmrp::Vec2 carrot, double remaining_m, double speed, const dmrp::Pose& pose, dmrp::Command& command) {
  const dmrp::Vec2 way = carrot - toolkit::position(pose);
  const double error = toolkit::difference(pose.theta, std::atan2(way.y, way.x));
  command.omega = std::copysign(std::min(1.0, std::sqrt(1.2 * std::abs(error))), error);
  if (std::abs(error) < 0.6) command.v_x = std::min(speed, std::sqrt(remaining_m)) * std::cos(error);
}

// Drives to the end of its path, and writes a note for each path.
class Follower final : public dmrp::LocalController {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("test.controller.follower", "Follower", "1.0.0").uses(DMRP_EXT_ANNOTATE);
  }
  dmrp::Param<bool> by_waypoint = param("by_waypoint", false).doc("expects a waypoint at a time");
  dmrp::Param<bool> dawdles = param("dawdles", false).doc("has a speed of its own, and stops now and then");
  dmrp::Param<bool> gives_up = param("gives_up", false).doc("has no command in the second lane from x = 3.2 m on");
  dmrp::Param<bool> strays = param("strays", false).doc("turns left from 3 s on for two seconds");

  dmrp::Status start(const dmrp::Start& now) override {
    annotate_ = &extension<dmrp_annotate>();
    random_.emplace(now.seed, "dawdling");
    speed_ = dawdles ? random_->uniform(0.3, 0.8) : 0.6;
    rest_until_ns_ = 0;
    revision_ = 0;
    robot_ = static_cast<std::uint32_t>(now.robot);
    return dmrp::Status::ok;
  }

  void set_path(dmrp::Path path, std::uint64_t revision) override {
    expect(revision == ++revision_, "the revision grows by one");
    expect(!path.empty() && (!by_waypoint || path.size() == 1), "a path as it is dispatched");
    if (path.continues()) expect_continued(path);
    path_.assign(path.begin(), path.end());
    is_partial_ = path.is_partial();
    toolkit::arc_lengths(path_, arcs_);
    const std::string text = std::to_string(path.size()) + " to " + std::to_string(path_.back().x);
    const dmrp_note note = {sizeof(note), robot_, text.c_str()};
    annotate_->note(annotate_, &note);
  }

  dmrp::Status step(const dmrp::Observation& now, dmrp::Command& command) override {
    check(now);
    if (gives_up && now.pose.y > 2.0 && now.pose.x > 3.2) return dmrp::Status::no_solution;
    const double end_m = arcs_.back();
    const dmrp::Vec2 carrot = toolkit::point_at(path_, arcs_, std::min(now.progress_m + 0.35, end_m));
    const dmrp::Vec2 end = toolkit::position(path_.back());
    const double remaining_m = std::max(end_m - now.progress_m, toolkit::distance(toolkit::position(now.pose), end));
    if (remaining_m < 0.05) return dmrp::Status::ok;

    drive_to(carrot, remaining_m, speed_, now.pose, command);
    if (rests(now.t_ns)) command = {};
    if (strays && now.t_ns >= 3'000'000'000 && now.t_ns < 5'000'000'000) {
      command.v_x = 0.6;
      command.omega = 0.8;
    }
    return dmrp::Status::ok;
  }

 private:
  // It begins as the path before and ends elsewhere.
  void expect_continued(const dmrp::Path& path) const {
    expect(path.size() != path_.size(), "a path that continues ends elsewhere");
    for (std::size_t i = 0; i < std::min(path.size(), path_.size()); ++i)
      expect(path[i].x == path_[i].x && path[i].y == path_[i].y && path[i].t_ns == path_[i].t_ns &&
                 path[i].goal_index == path_[i].goal_index,
             "a path that continues begins as the one before");
  }

  void check(const dmrp::Observation& now) const {
    expect(now.progress_waypoint < path_.size(), "a waypoint of the path");
    expect(path_.back().goal_index <= now.goal_index, "the path ends at the current goal, or before");
    const double to_goal_m = toolkit::distance(toolkit::position(now.goal.pose), toolkit::position(path_.back()));
    expect(is_partial_ || to_goal_m < 1e-9, "a path that is not partial ends at the current goal");
    if (!by_waypoint) return;
    expect(now.progress_m == 0.0, "no progress on a single waypoint");
    expect(!is_partial_, "the waypoint is the goal");
    expect(now.goal.tolerance_m == 0.2, "with the current goal's tolerances");
  }

  bool rests(std::int64_t t_ns) {
    if (!dawdles) return false;
    if (t_ns >= rest_until_ns_ && random_->uniform(0.0, 1.0) < 0.01)
      rest_until_ns_ = t_ns + static_cast<std::int64_t>(random_->uniform(1e9, 4e9));
    return t_ns < rest_until_ns_;
  }

  const dmrp_annotate* annotate_ = nullptr;
  std::uint32_t robot_ = 0;
  std::optional<toolkit::Stream> random_;
  double speed_ = 0.6;
  std::int64_t rest_until_ns_ = 0;
  std::uint64_t revision_ = 0;
  std::vector<dmrp::Waypoint> path_;
  std::vector<double> arcs_;
  bool is_partial_ = false;
};

// Follows its path to the end and stops there. It knows of nothing but its path and its pose.
class Naive final : public dmrp::LocalController {
 public:
  static dmrp::Descriptor describe() { return dmrp::Descriptor("test.controller.naive", "Naive", "1.0.0"); }

  void set_path(dmrp::Path path, std::uint64_t) override {
    if (!path.continues()) arc_m_ = 0.0;
    path_.assign(path.begin(), path.end());
    toolkit::arc_lengths(path_, arcs_);
  }

  dmrp::Status step(const dmrp::Observation& now, dmrp::Command& command) override {
    const dmrp::Vec2 here = toolkit::position(now.pose);
    arc_m_ = toolkit::project(path_, arcs_, here, arc_m_, arc_m_ + 0.5).arc_m;
    const double remaining_m =
        std::max(arcs_.back() - arc_m_, toolkit::distance(here, toolkit::position(path_.back())));
    if (remaining_m < 0.05) return dmrp::Status::ok;
    drive_to(toolkit::point_at(path_, arcs_, arc_m_ + 0.35), remaining_m, 0.6, now.pose, command);
    return dmrp::Status::ok;
  }

 private:
  std::vector<dmrp::Waypoint> path_;
  std::vector<double> arcs_;
  double arc_m_ = 0.0;  // of the position reached
};

}  // namespace

DMRP_PLUGINS(AgainPlanner, Follower, Naive)
