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
      expect(dmrp::Path(problem.in_force[i])[0].t_ns < problem.now_ns, "the plan in force is older");
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
    for (double x = robot.start.x + 1.0; x <= robot.goals->pose.x + 1e-6; x += 1.0) add(x);
    return path;
  }

  std::uint64_t plans_ = 0;
};

// Drives along its path as far as it is released, and writes a note for each path.
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
    path_.assign(path.begin(), path.end());
    toolkit::arc_lengths(path_, arcs_);
    const std::string text = std::to_string(path.size()) + " to " + std::to_string(path_.back().x);
    const dmrp_note note = {sizeof(note), robot_, text.c_str()};
    annotate_->note(annotate_, &note);
  }

  dmrp::Status step(const dmrp::Observation& now, dmrp::Command& command) override {
    check(now);
    if (gives_up && now.pose.y > 2.0 && now.pose.x > 3.2) return dmrp::Status::no_solution;
    const dmrp::Vec2 position = toolkit::position(now.pose);
    const double end_m = arcs_[now.released_waypoint];
    const dmrp::Vec2 carrot = toolkit::point_at(path_, arcs_, std::min(now.progress_m + 0.35, end_m));
    const dmrp::Vec2 end = toolkit::position(path_[now.released_waypoint]);
    const double remaining_m = std::max(end_m - now.progress_m, toolkit::distance(position, end));
    if (remaining_m < 0.05) return dmrp::Status::ok;

    const dmrp::Vec2 way = carrot - position;
    const double error = toolkit::difference(now.pose.theta, std::atan2(way.y, way.x));
    command.omega = std::copysign(std::min(1.0, std::sqrt(1.2 * std::abs(error))), error);
    if (std::abs(error) < 0.6) command.v_x = std::min(speed_, std::sqrt(remaining_m)) * std::cos(error);
    if (rests(now.t_ns)) command = {};
    if (strays && now.t_ns >= 3'000'000'000 && now.t_ns < 5'000'000'000) {
      command.v_x = 0.6;
      command.omega = 0.8;
    }
    return dmrp::Status::ok;
  }

 private:
  void check(const dmrp::Observation& now) const {
    expect(now.released_waypoint < path_.size() && now.progress_waypoint <= now.released_waypoint, "waypoints");
    if (!by_waypoint) return;
    expect(now.progress_m == 0.0, "no progress on a single waypoint");
    expect(toolkit::distance(toolkit::position(now.goal.pose), toolkit::position(path_[0])) < 1e-9,
           "the waypoint is the goal");
    expect(now.goal.tolerance_m == 0.2 && path_[0].goal_index <= now.goal_index, "with the current goal's tolerances");
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
};

}  // namespace

DMRP_PLUGINS(AgainPlanner, Follower)
