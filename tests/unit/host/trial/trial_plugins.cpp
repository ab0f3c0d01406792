// SPDX-License-Identifier: MIT
// Plugins that check the inputs from the host, and return an error if they break the contract.
#include <dmrp/ext/annotate.h>
#include <dmrp/ext/lidar.h>
#include <dmrp/ext/local_costmap.h>
#include <dmrp/ext/obstacle_clusters.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <dmrp/plugin.hpp>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

void expect(bool holds, const char* what) {
  if (!holds) throw std::logic_error(std::string("broken: ") + what);
}

constexpr double any_heading = std::numeric_limits<double>::quiet_NaN();

// Straight along x, one cell per step.
class StraightPlanner final : public dmrp::GlobalPlanner {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("test.planner.straight", "Straight", "1.0.0")
        .connectivity(DMRP_CONNECTIVITY_8)
        .uses(DMRP_EXT_ANNOTATE)
        .uses(DMRP_EXT_LIDAR);
  }
  dmrp::Param<std::string> does =
      param("does", "plan").doc("plan, half, nothing, unsupported, timeout, late, wait, sleep or fatal");

  dmrp::Status plan(const dmrp::PlanningProblem& problem, dmrp::PlanSink& sink) override {
    expect(problem.revision == 1 && problem.in_force.empty(), "the first plan");
    const auto* annotate = find_extension<dmrp_annotate>();
    expect(annotate && !find_extension<dmrp_lidar>(), "planners may annotate, and have no sensors");
    const dmrp_note note = {sizeof(note), 7, "straight"};  // the robot is ignored
    annotate->note(annotate, &note);
    if (*does == "fatal") return set_error("the library is lost"), dmrp::Status::fatal;
    if (*does == "nothing") return dmrp::Status::no_solution;
    if (*does == "unsupported") return set_error("robots that cannot turn"), dmrp::Status::unsupported;
    if (*does == "timeout") return dmrp::Status::timeout;
    while (*does == "wait" && !should_stop()) {
    }
    if (*does == "sleep") std::this_thread::sleep_for(std::chrono::milliseconds(50));
    for (std::uint32_t i = 0; i < problem.robots.size(); ++i) {
      if (*does == "half" && i > 0) break;
      const dmrp::PlanningRobot& robot = problem.robots[i];
      expect(robot.goal_count == 1 && robot.state == DMRP_ROBOT_ACTIVE, "a robot with one goal");
      std::vector<dmrp::Waypoint> path;
      std::int64_t t_ns = problem.effective_from_ns;
      for (double x = robot.start.x; x <= robot.goals()[0].pose.x + 1e-6; x += problem.grid.resolution_m) {
        path.push_back({x, robot.start.y, any_heading, t_ns, 0, 0});
        t_ns += problem.step_duration_ns;
      }
      sink.path(i, path);
    }
    sink.statistic("cost", 12.5);
    return *does == "late" ? dmrp::Status::timeout : dmrp::Status::ok;
  }
};

// Drives ahead to the end of its path, which lies at the same y.
class CarefulController final : public dmrp::LocalController {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("test.controller.careful", "Careful", "1.0.0")
        .uses(DMRP_EXT_ANNOTATE)
        .uses(DMRP_EXT_LIDAR)
        .uses(DMRP_EXT_LOCAL_COSTMAP)
        .uses(DMRP_EXT_OBSTACLE_CLUSTERS)
        .uses("draft/unknown");
  }
  dmrp::Param<std::string> does = param("does", "drive").doc("drive, nothing or nan");

  dmrp::Status start(const dmrp::Start& now) override {
    expect(now.robot >= 0 && now.robot < static_cast<std::int32_t>(now.world->robot_count), "start.robot");
    robot_ = static_cast<std::uint32_t>(now.robot);
    expect(now.seed != 0, "a seed");
    annotate_ = find_extension<dmrp_annotate>();
    expect(host().c()->get_extension(host().c(), "draft/unknown") == nullptr, "unknown extensions are NULL");
    lidar_ = find_extension<dmrp_lidar>();
    costmap_ = find_extension<dmrp_local_costmap>();
    clusters_ = find_extension<dmrp_obstacle_clusters>();
    expect(annotate_ && lidar_ && costmap_ && clusters_, "extensions are offered");
    path_.clear();
    last_t_ns_ = -1;
    progress_m_ = 0.0;
    return dmrp::Status::ok;
  }

  void set_path(dmrp::Path path, std::uint64_t revision) override {
    expect(revision == 1 && !path.empty() && last_t_ns_ < 0, "one path, before the first step");
    expect(!path.is_partial() && !path.continues(), "the whole way, and the first of it");
    path_.assign(path.begin(), path.end());
    const dmrp::Robot& robot = world().robots()[robot_];
    expect(path_.back().x == robot.goals()[0].pose.x && path_.back().y == robot.goals()[0].pose.y,
           "the path ends at the goal");
    expect(lidar_->scan(lidar_, robot_) != nullptr, "a scan before the first step");
  }

  dmrp::Status step(const dmrp::Observation& now, dmrp::Command& command) override {
    expect(now.robot == robot_, "observation.robot");
    expect(now.t_ns == (last_t_ns_ < 0 ? 0 : last_t_ns_ + now.dt_ns), "one call a control period");
    last_t_ns_ = now.t_ns;
    expect(now.dt_ns == world()->control_period_ns, "dt");
    expect(now.progress_m >= progress_m_, "progress never falls");
    progress_m_ = now.progress_m;
    expect(now.progress_waypoint < path_.size(), "progress on the path");
    for (const dmrp::Agent& agent : now.agents)
      expect(agent.kind != DMRP_AGENT_ROBOT || agent.id != now.robot, "nobody sees itself");
    const dmrp_scan& scan = *lidar_->scan(lidar_, robot_);
    expect(scan.t_ns == now.t_ns && scan.count > 0, "a scan of now");
    expect(costmap_->costmap(costmap_, robot_)->t_ns == now.t_ns, "a costmap of now");
    const dmrp_obstacle_cluster_list* clusters = clusters_->clusters(clusters_, robot_);
    expect(clusters->t_ns == now.t_ns && clusters == clusters_->clusters(clusters_, robot_), "clusters of now");
    expect(scan.t_ns == now.t_ns && &scan == lidar_->scan(lidar_, robot_), "a scan that stays until the call returns");
    for (const std::uint32_t other : {1 - robot_, 2u, ~0u})
      expect(
          !lidar_->scan(lidar_, other) && !costmap_->costmap(costmap_, other) && !clusters_->clusters(clusters_, other),
          "no readings of a robot that it does not drive");
    if (annotate_->wanted(annotate_)) annotate(now);

    if (*does == "nothing") return dmrp::Status::no_solution;
    command.v_x = std::min(0.6, path_.back().x - now.pose.x);
    if (*does == "nan" && now.t_ns > 0) command.omega = any_heading;
    return dmrp::Status::ok;
  }

 private:
  // Valid and invalid annotations.
  void annotate(const dmrp::Observation& now) const {
    const dmrp_pose nowhere = {any_heading, 0.0, 0.0};
    const dmrp_pose poses[] = {now.pose, {now.pose.x + 1.0, now.pose.y, 0.0}, nowhere};
    draw(DMRP_ANNOTATE_PREDICTED, robot_, poses, 3);
    draw(DMRP_ANNOTATE_PREDICTED, robot_, &nowhere, 1);
    draw(DMRP_ANNOTATE_CANDIDATE, robot_, nullptr, 7);
    draw(77, robot_, poses, 2);
    draw(DMRP_ANNOTATE_CANDIDATE, robot_, poses, 2, -1);
    draw(DMRP_ANNOTATE_PREDICTED, 1 - robot_, poses, 2);  // another's robot
    annotate_->trajectory(annotate_, nullptr);
    write(robot_, nullptr);
    write(1 - robot_, "about another's robot");
    annotate_->note(annotate_, nullptr);
    if (now.t_ns > 0) return;
    const std::vector<dmrp_pose> many(1500, now.pose);
    draw(DMRP_ANNOTATE_CANDIDATE, robot_, many.data(), 1500, 0);
    write(robot_, (std::string(999, 'n') + "\u00e9 and so on").c_str());
  }

  void draw(std::uint32_t role, std::uint32_t robot, const dmrp_pose* poses, std::uint32_t count,
            std::int64_t step_ns = 100'000'000) const {
    const dmrp_trajectory trajectory = {sizeof(trajectory), role, robot, count, poses, step_ns};
    annotate_->trajectory(annotate_, &trajectory);
  }

  void write(std::uint32_t robot, const char* text) const {
    const dmrp_note note = {sizeof(note), robot, text};
    annotate_->note(annotate_, &note);
  }

  const dmrp_annotate* annotate_ = nullptr;
  const dmrp_lidar* lidar_ = nullptr;
  const dmrp_local_costmap* costmap_ = nullptr;
  const dmrp_obstacle_clusters* clusters_ = nullptr;
  std::uint32_t robot_ = 0;
  std::vector<dmrp::Waypoint> path_;
  std::int64_t last_t_ns_ = -1;
  double progress_m_ = 0.0;
};

// Tests what the sink of a metric accepts and refuses. Uses the C interface: the C++ layer would throw.
class SinkMetric final : public dmrp::Metric {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("test.metric.sink", "Sink", "1.0.0")
        .value("samples", "1", dmrp::Direction::none, dmrp::Subjects::system_and_robots, "how many")
        .value("refused", "1", dmrp::Direction::none, dmrp::Subjects::system,
               "how many values, of those that should be")
        .value("curve", "1", dmrp::Direction::none, dmrp::Subjects::system, "squares")
        .curve()
        .value("undefined", "1", dmrp::Direction::none, dmrp::Subjects::system, "never there")
        .value("of_channels", "1", dmrp::Direction::none, dmrp::Subjects::system, "what channels gave, in all samples");
  }
  dmrp::Param<bool> silent = param("silent", false).doc("says nothing of `undefined`");

  void begin(const dmrp::MetricTrial& trial) override {
    samples_ = 0;
    of_channels_ = 0;
    planned_ = static_cast<bool>(trial.plan);
  }
  void observe(const dmrp::Sample& sample) override {
    expect(static_cast<bool>(sample.plan) == planned_, "samples have the plan that there is");
    expect(sample.dt_ns == (samples_ == 0 ? 0 : world()->step_ns), "dt");
    expect(sample.t_ns == samples_ * world()->step_ns, "a sample a step");
    of_channels_ += sample.people.size() + sample.calls.size() + sample.routes.size();
    ++samples_;
  }
  void finish(const dmrp::TrialEnd&, dmrp::MetricSink& sink) override {
    sink.system("samples", static_cast<double>(samples_));
    sink.system("of_channels", static_cast<double>(of_channels_));
    sink.robot("samples", 1, 1.0);
    sink.curve("curve", 1.0, 1.0);
    sink.curve("curve", 2.0, 4.0);
    if (!silent) sink.system("undefined", dmrp::undefined);
    sink.event({"samples",
                5,
                5,
                {dmrp::robot_subject(0), dmrp::person_subject(9), dmrp::robot_subject(1)},
                "both",
                {1.5, 2.5},
                dmrp::Severity::serious});

    constexpr double infinity = std::numeric_limits<double>::infinity();
    int refused = 0;
    const auto refuses = [&](auto&& give) {
      try {
        give();
      } catch (const std::logic_error&) {
        ++refused;
      }
    };
    refuses([&] { sink.system("samples", 3.0); });                                  // twice
    refuses([&] { sink.robot("samples", 1, 2.0); });                                // twice
    refuses([&] { sink.curve("curve", 2.0, 5.0); });                                // twice
    refuses([&] { sink.system("undeclared", 1.0); });                               //
    refuses([&] { sink.robot("refused", 0, 1.0); });                                // no such subject
    refuses([&] { sink.robot("samples", 2, 1.0); });                                // no such robot
    refuses([&] { sink.pedestrian("samples", 0, 1.0); });                           // no such subject
    refuses([&] { sink.curve("samples", 1.0, 1.0); });                              // no curve
    refuses([&] { sink.curve("curve", 3.0, infinity); });                           //
    refuses([&] { sink.curve("curve", infinity, 3.0); });                           //
    refuses([&] { sink.event({"samples", 6, 5, {}, ""}); });                        // ends before it begins
    refuses([&] { sink.event({"samples", 5, 6, {dmrp::robot_subject(2)}, ""}); });  // no such robot
    sink.system("refused", refused);
  }

 private:
  std::int64_t samples_ = 0;
  std::size_t of_channels_ = 0;
  bool planned_ = false;
};

}  // namespace

DMRP_PLUGINS(StraightPlanner, CarefulController, SinkMetric)
