// SPDX-License-Identifier: MIT
// A plugin of each kind by the C++ layer, without the toolkit. Each reads all that it is handed, and lets it decide its
// outputs.
#include <mixed_fields.h>

#include <dmrp/plugin.hpp>

namespace {

void mix_way(mixed& all, const dmrp::Path& path) {
  mix(&all, path.is_partial()), mix(&all, path.continues());
  for (const dmrp::Waypoint& waypoint : path) mix_waypoint(&all, &waypoint);
}
void begin(mixed& all, const dmrp::Start& start) {
  all = {0.0};
  mix(&all, start.robot), mix(&all, static_cast<double>(start.seed)), mix_world(&all, start.world.operator->());
}

// Straight to the right, a cell a step, as the stage allows.
class Planner final : public dmrp::GlobalPlanner {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("org.example.mixing_planner", "Mixing", "1.0.0").connectivity(DMRP_CONNECTIVITY_4);
  }
  dmrp::Param<std::int64_t> number = param("number", std::int64_t{7}).range(0, 9).doc("mixed in");
  dmrp::Param<std::string> text = param("text", "text").doc("mixed in");

  dmrp::Status start(const dmrp::Start& start) override { return begin(all_, start), dmrp::Status::ok; }

  dmrp::Status plan(const dmrp::PlanningProblem& problem, dmrp::PlanSink& sink) override {
    mix(&all_, static_cast<double>(*number)), mix_text(&all_, text->c_str());
    mix(&all_, static_cast<double>(problem.revision)), mix_time(&all_, problem.now_ns);
    mix_time(&all_, problem.effective_from_ns), mix_time(&all_, problem.step_duration_ns);
    mix(&all_, problem.window_steps), mix_grid(&all_, &problem.grid);
    for (const dmrp::Path& path : problem.in_force) {
      mix(&all_, static_cast<double>(path.size())), mix(&all_, path.is_partial());
      for (const dmrp::Waypoint& waypoint : path) mix_waypoint(&all_, &waypoint);
    }
    std::uint32_t index = 0;
    for (const dmrp::PlanningRobot& robot : problem.robots) {
      mix_planning_robot(&all_, &robot);
      sink.path(index++, way_of(robot, problem));
    }
    sink.statistic("mixed", mixed_value(&all_));
    return dmrp::Status::ok;
  }

 private:
  // Waits as many steps as the inputs say, then drives.
  std::vector<dmrp::Waypoint> way_of(const dmrp::PlanningRobot& robot, const dmrp::PlanningProblem& problem) const {
    const double cell_m = problem.grid.resolution_m;
    const dmrp::Pose goal = robot.goals()[0].pose;
    std::vector<dmrp::Waypoint> way;
    const auto go = [&](double x) {
      const auto steps = static_cast<std::int64_t>(way.size());
      way.push_back(dmrp::waypoint(x, robot.start.y, problem.effective_from_ns + steps * problem.step_duration_ns,
                                   robot.first_goal_index));
    };
    const auto waits = static_cast<int>(4.0 * (1.0 + mixed_value(&all_)));
    for (int i = 0; i < waits; ++i) go(robot.start.x);
    for (double x = robot.start.x; x < goal.x + 0.5 * cell_m; x += cell_m) go(x);
    return way;
  }

  mixed all_ = {0.0};
};

void mix_now(mixed& all, const dmrp::Observation& now) {
  mix(&all, now.robot), mix_time(&all, now.t_ns), mix_time(&all, now.dt_ns), mix_pose(&all, &now.pose);
  mix_twist(&all, &now.velocity), mix_twist(&all, &now.applied), mix_goal(&all, &now.goal), mix(&all, now.goal_index);
  mix(&all, now.goal_count), mix(&all, now.progress_m), mix(&all, now.progress_waypoint);
  mix_limits(&all, &now.limits), mix_footprint(&all, &now.footprint), mix(&all, now.steering_angle);
  for (const dmrp::Agent& agent : now.agents) mix_agent(&all, &agent);
}
dmrp::Command command_of(const mixed& all) {
  dmrp::Command command;
  command.v_x = 0.2 + 0.1 * mixed_value(&all);
  command.omega = 0.5 * mixed_value(&all);
  return command;
}

class Controller final : public dmrp::LocalController {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("org.example.mixing_controller", "Mixing", "1.0.0").uses({DMRP_EXT_LOCAL_COSTMAP});
  }
  dmrp::Status start(const dmrp::Start& start) override {
    begin(all_, start);
    costmap_ = find_extension<dmrp_local_costmap>();
    return dmrp::Status::ok;
  }
  void set_path(dmrp::Path path, std::uint64_t revision) override {
    mix(&all_, static_cast<double>(revision)), mix_way(all_, path);
  }
  dmrp::Status step(const dmrp::Observation& now, dmrp::Command& command) override {
    mix_now(all_, now);
    if (costmap_) mix_costmap(&all_, costmap_->costmap(costmap_, now.robot));
    command = command_of(all_);
    return dmrp::Status::ok;
  }

 private:
  const dmrp_local_costmap* costmap_ = nullptr;
  mixed all_ = {0.0};
};

class Central final : public dmrp::CentralController {
 public:
  static dmrp::Descriptor describe() { return dmrp::Descriptor("org.example.mixing_central", "Mixing", "1.0.0"); }
  dmrp::Status start(const dmrp::Start& start) override { return begin(all_, start), dmrp::Status::ok; }
  void set_path(std::uint32_t robot, dmrp::Path path, std::uint64_t revision) override {
    mix(&all_, robot), mix(&all_, static_cast<double>(revision)), mix_way(all_, path);
  }
  dmrp::Status step(dmrp::Fleet& fleet) override {
    for (std::size_t i = 0; i < fleet.size(); ++i) {
      mix_now(all_, fleet[i]);
      if (mixed_value(&all_) > 0.9)
        fleet.brake(i);
      else
        fleet.command(i, command_of(all_));
    }
    return dmrp::Status::ok;
  }

 private:
  mixed all_ = {0.0};
};

class Pedestrians final : public dmrp::PedestrianModel {
 public:
  static dmrp::Descriptor describe() { return dmrp::Descriptor("org.example.mixing_people", "Mixing", "1.0.0"); }
  dmrp::Status start(const dmrp::Start& start) override { return begin(all_, start), dmrp::Status::ok; }
  dmrp::Status step(const dmrp::Crowd& crowd, dmrp::Motions& motions) override {
    mix_time(&all_, crowd.t_ns), mix_time(&all_, crowd.dt_ns);
    for (const dmrp::Agent& robot : crowd.robots) mix_agent(&all_, &robot);
    for (std::size_t i = 0; i < motions.size(); ++i) {
      mix_person(&all_, &crowd.people[i]);
      motions[i].velocity = {mixed_value(&all_), 0.5 * mixed_value(&all_)};
    }
    return dmrp::Status::ok;
  }

 private:
  mixed all_ = {0.0};
};

class Metric final : public dmrp::Metric {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("org.example.mixing_metric", "Mixing", "1.0.0")
        .value("mixed", "1", dmrp::Direction::none, dmrp::Subjects::system_and_robots, "all that it was shown")
        .channels(DMRP_CHANNEL_PEOPLE | DMRP_CHANNEL_CALLS | DMRP_CHANNEL_RECOVERIES | DMRP_CHANNEL_ROUTES);
  }
  void begin(const dmrp::MetricTrial& trial) override {
    all_ = {0.0};
    mix_world(&all_, world().operator->());
    if (trial.plan) mix_plan(&all_, trial.plan.operator->());
  }
  void observe(const dmrp::Sample& sample) override {
    mix_time(&all_, sample.t_ns), mix_time(&all_, sample.dt_ns), mix(&all_, sample.control_tick);
    if (sample.plan) mix_plan(&all_, sample.plan.operator->());
    for (const dmrp::RobotSample& robot : sample.robots) mix_robot_sample(&all_, &robot);
    for (const dmrp::Person& person : sample.people) mix_person(&all_, &person);
    for (const dmrp::Contact& contact : sample.contacts) mix_contact(&all_, &contact);
    for (const dmrp::Call& call : sample.calls) mix_call(&all_, &call);
    for (const dmrp::RobotEvent& event : sample.events) mix_robot_event(&all_, &event);
    for (const dmrp::Route& route : sample.routes) mix_route(&all_, &route);
  }
  void finish(const dmrp::TrialEnd& end, dmrp::MetricSink& sink) override {
    mix(&all_, end.ending), mix_time(&all_, end.t_ns);
    for (std::size_t i = 0; i < end.robots.size(); ++i) {
      mix_robot_end(&all_, &end.robots[i]);
      sink.robot("mixed", i, mixed_value(&all_));
    }
    sink.system("mixed", mixed_value(&all_));
  }

 private:
  mixed all_ = {0.0};
};

}  // namespace

DMRP_PLUGINS(Planner, Controller, Central, Pedestrians, Metric)
